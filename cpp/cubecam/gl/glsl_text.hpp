#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cubecam::gl {

/// Returns a source without a byte order mark and with '\n' at the end of each line: "\r\n" and a
/// single '\r' also end lines.
std::string with_plain_lines(std::string_view text);

/// GLSL in the form in which a preprocessor sees it: without comments, and with lines joined where
/// a backslash continues them. Conditions are not evaluated: the tokens of all branches are there.
class GlslText {
public:
    /// A word, a number or an operator outside of preprocessor lines.
    struct Token {
        std::string text;
        std::size_t begin;  ///< in the source
        std::size_t end;
        std::size_t line;  ///< from 1

        bool is_word() const;
    };

    /// A preprocessor line.
    struct Directive {
        std::string word;          ///< such as "define"; empty for a single '#'
        std::vector<Token> rest;   ///< the tokens after the word
        std::size_t line;          ///< from 1
        std::size_t last_line;     ///< greater than `line` if backslashes continue the line
        std::size_t before_token;  ///< how many tokens of the source precede the directive

        /// Whether it begins, continues or ends a part that a condition includes.
        bool is_conditional() const;
    };

    /// `text` has the lines of with_plain_lines().
    explicit GlslText(std::string_view text);

    const std::vector<Token>& tokens() const { return tokens_; }
    const std::vector<Directive>& directives() const { return directives_; }
    /// The line where a comment begins that is never closed.
    std::optional<std::size_t> open_comment() const { return open_comment_; }
    /// The line of a position in the source, from 1.
    std::size_t line_of(std::size_t position) const;
    /// The line of the last token or directive; 1 without any.
    std::size_t last_line() const;

private:
    std::vector<std::size_t> line_starts_;
    std::vector<Token> tokens_;
    std::vector<Directive> directives_;
    std::optional<std::size_t> open_comment_;
};

}  // namespace cubecam::gl
