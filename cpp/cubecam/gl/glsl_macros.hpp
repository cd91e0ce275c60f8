#pragma once

#include "cubecam/gl/glsl_text.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cubecam::gl {

/// The macros of a GLSL source, and what their uses stand for. Which branches of conditions count
/// is not known, so a macro can have several definitions.
class GlslMacros {
public:
    using Tokens = std::vector<GlslText::Token>;

    /// Keeps references to the tokens of `text`.
    explicit GlslMacros(const GlslText& text);

    bool has(std::string_view name) const { return macros_.contains(name); }
    bool any_in(const Tokens& tokens, std::size_t begin, std::size_t end) const;

    /// The index after the use of a macro whose name is the token `at`: after its arguments if it
    /// has some. `at` itself if no use begins there.
    std::size_t after_use(const Tokens& tokens, std::size_t at, std::size_t end) const;

    /// The tokens [begin, end) with the macros replaced, as a preprocessor does, once for each
    /// definition of the macro that has most of them. Equal results are there once. Empty if the
    /// result would be long, or if too much was expanded before. The lines and positions of all
    /// tokens are those of the token `begin`.
    std::vector<Tokens> expanded(const Tokens& tokens, std::size_t begin, std::size_t end) const;

    /// The macros in which a word stands, or that use one of these.
    std::set<std::string, std::less<>> holding(std::string_view word) const;

private:
    struct Definition {
        bool call = false;  ///< it has parameters, perhaps none
        std::vector<std::string> parameters;
        Tokens body;
    };
    using Hidden = std::set<std::string, std::less<>>;

    static std::optional<Definition> read(const GlslText::Directive& directive);
    const Definition& choose(std::string_view name, std::size_t choice) const;
    bool expand(const Tokens& tokens, std::size_t begin, std::size_t end, std::size_t choice,
                const Hidden& hidden, Tokens& into) const;
    bool expand_use(const Tokens& tokens, std::size_t at, std::size_t end, std::size_t choice,
                    const Hidden& hidden, Tokens& into) const;

    std::map<std::string, std::vector<Definition>, std::less<>> macros_;
    mutable std::size_t left_;  ///< how many tokens may still be written
};

}  // namespace cubecam::gl
