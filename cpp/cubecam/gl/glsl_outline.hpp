#pragma once

#include "cubecam/gl/glsl_text.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cubecam::gl {

/// A declared name: `const float a[3]`.
struct GlslName {
    enum class Kind { variable, function, structure, block, member };

    Kind kind;
    std::string name;
    std::string type;                     ///< "float"; of a function, what it returns
    std::size_t dimensions = 0;           ///< how many pairs of square brackets
    std::vector<std::string> qualifiers;  ///< "const", "out", ... without those of a layout
    bool has_layout_location = false;     ///< `layout(location = ...)`
    bool initialised = false;
    std::size_t token;  ///< the index of the name among the tokens
    std::size_t line;

    bool is(std::string_view qualifier) const;
};

/// A function with its body.
struct GlslFunction {
    std::string name;
    std::string type;                  ///< what it returns
    std::size_t dimensions = 0;        ///< of what it returns
    std::vector<GlslName> parameters;  ///< without those that have no name
    std::size_t open;                  ///< the index of the token '{'
    std::size_t close;                 ///< of its '}', or the number of tokens
    bool returns = false;              ///< there is a `return` in the body
    std::size_t line;
};

struct GlslStructure {
    std::string name;
    std::vector<GlslName> members;
    std::size_t end;  ///< the index of the ';' that ends the declaration
};

/// What a source declares outside of functions, found by its brackets and semicolons. Macros are
/// not expanded, and all branches of conditions are read.
struct GlslOutline {
    std::vector<GlslName> names;
    std::vector<GlslFunction> functions;
    std::vector<GlslStructure> structures;
    /// The line of the first bracket that nothing closes.
    std::optional<std::size_t> open_bracket;
    char open_bracket_kind = '{';
    /// The brackets could not be followed, for example because branches of a condition or a macro
    /// contain different ones.
    bool uncertain = false;
};

GlslOutline outline(const GlslText& text);

/// The variables that a statement declares, the first token of which is `begin`; empty if the
/// statement is no declaration. It ends before the token `end`.
std::vector<GlslName> declared_variables(const std::vector<GlslText::Token>& tokens,
                                         std::size_t begin, std::size_t end);

}  // namespace cubecam::gl
