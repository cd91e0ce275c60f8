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
    std::vector<GlslName> parameters;  ///< without those that have no name; macros are expanded
    GlslName result;                   ///< what it returns, with macros expanded
    std::string result_text;           ///< the type of a variable for it, such as "float [ 3 ]"
    std::size_t open;                  ///< the index of the token '{'
    std::size_t close;                 ///< of its '}', or the number of tokens
    bool returns = false;              ///< there is a `return` in the body, perhaps of a macro
    std::size_t line;
};

struct GlslStructure {
    std::string name;
    std::vector<GlslName> members;
    std::size_t end;  ///< the index of the ';' that ends the declaration
};

/// What a source declares outside of functions, found by its brackets and semicolons. All branches
/// of conditions are read. Macros are expanded only in statements that cannot be read otherwise;
/// the token of a name from there is the first of its statement.
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

/// The index after the bracket that closes the one at `open`; `end` if nothing closes it.
std::size_t after_bracket(const std::vector<GlslText::Token>& tokens, std::size_t open,
                          std::size_t end);

/// The tokens as a text that reads the same.
std::string joined(const std::vector<GlslText::Token>& tokens);

/// The variables that a statement declares, the first token of which is `begin`; empty if the
/// statement is no declaration. It ends before the token `end`.
std::vector<GlslName> declared_variables(const std::vector<GlslText::Token>& tokens,
                                         std::size_t begin, std::size_t end);

}  // namespace cubecam::gl
