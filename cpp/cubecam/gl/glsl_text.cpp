// Comments, lines and tokens of GLSL (GLSL 4.50, chapter 3). This file does not use OpenGL.
#include "cubecam/gl/glsl_text.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace cubecam::gl {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";

constexpr std::array<std::string_view, 21> long_operators = {
    "<<=", ">>=", "==", "!=", "<=", ">=", "&&", "||", "^^", "++", "--",
    "+=",  "-=",  "*=", "/=", "%=", "&=", "|=", "^=", "<<", ">>"};

bool is_word_char(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }
bool is_digit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }
bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }

/// The source without comments and continued lines; `origin` has the position of each character.
struct LogicalText {
    std::string text;
    std::vector<std::size_t> origin;
    std::optional<std::size_t> open_comment;

    void add(char c, std::size_t position) {
        text.push_back(c);
        origin.push_back(position);
    }
};

LogicalText join_lines(std::string_view source) {
    LogicalText joined;
    for (std::size_t i = 0; i < source.size(); ++i) {
        if (source.substr(i).starts_with("\\\n")) {
            ++i;
        } else {
            joined.add(source[i], i);
        }
    }
    return joined;
}

/// Replaces each comment by blanks, also its line ends, since a comment is one blank to a
/// preprocessor.
void blank_comments(LogicalText& logical) {
    std::string& text = logical.text;
    const auto blank = [&text](std::size_t begin, std::size_t end) {
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(begin),
                  text.begin() + static_cast<std::ptrdiff_t>(std::min(end, text.size())), ' ');
    };
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
        if (text[i] != '/') continue;
        if (text[i + 1] == '/') {
            const std::size_t end = std::min(text.find('\n', i), text.size());
            blank(i, end);
            i = end;
        } else if (text[i + 1] == '*') {
            const std::size_t end = text.find("*/", i + 2);
            if (end == std::string::npos) {
                logical.open_comment = logical.origin[i];
                blank(i, text.size());
                return;
            }
            blank(i, end + 2);
            i = end + 1;
        }
    }
}

/// Returns the end of the token that begins at `i`.
std::size_t token_end(std::string_view text, std::size_t i) {
    const bool number =
        is_digit(text[i]) || (text[i] == '.' && i + 1 < text.size() && is_digit(text[i + 1]));
    if (number) {
        std::size_t end = i + 1;
        while (end < text.size() &&
               (is_word_char(text[end]) || text[end] == '.' ||
                ((text[end] == '+' || text[end] == '-') &&
                 (text[end - 1] == 'e' || text[end - 1] == 'E') &&
                 !text.substr(i).starts_with("0x") && !text.substr(i).starts_with("0X")))) {
            ++end;
        }
        return end;
    }
    if (is_word_char(text[i])) {
        std::size_t end = i + 1;
        while (end < text.size() && is_word_char(text[end])) ++end;
        return end;
    }
    if (static_cast<unsigned char>(text[i]) >= 0x80) {  // one character of UTF-8
        std::size_t end = i + 1;
        while (end < text.size() && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) ++end;
        return end;
    }
    for (const std::string_view op : long_operators) {
        if (text.substr(i).starts_with(op)) return i + op.size();
    }
    return i + 1;
}

}  // namespace

std::string with_plain_lines(std::string_view text) {
    if (text.starts_with(byte_order_mark)) text.remove_prefix(byte_order_mark.size());
    std::string plain;
    plain.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '\r') {
            plain.push_back(text[i]);
        } else if (i + 1 == text.size() || text[i + 1] != '\n') {
            plain.push_back('\n');
        }
    }
    return plain;
}

bool GlslText::Token::is_word() const { return is_word_char(text[0]) && !is_digit(text[0]); }

bool GlslText::Directive::is_conditional() const {
    return word == "if" || word == "ifdef" || word == "ifndef" || word == "elif" ||
           word == "else" || word == "endif";
}

GlslText::GlslText(std::string_view source) {
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < source.size(); ++i) {
        if (source[i] == '\n') line_starts_.push_back(i + 1);
    }
    LogicalText logical = join_lines(source);
    blank_comments(logical);
    if (logical.open_comment) open_comment_ = line_of(*logical.open_comment);

    const std::string_view text = logical.text;
    std::vector<Token>* into = &tokens_;
    bool line_start = true;
    for (std::size_t i = 0; i < text.size();) {
        const char c = text[i];
        if (c == '\n') {
            if (into != &tokens_) directives_.back().last_line = line_of(logical.origin[i]);
            into = &tokens_;
            line_start = true;
            ++i;
        } else if (is_blank(c)) {
            ++i;
        } else if (c == '#' && line_start) {
            const std::size_t line = line_of(logical.origin[i]);
            Directive made{"", {}, line, line, tokens_.size()};
            for (++i; i < text.size() && is_blank(text[i]); ++i) {
            }
            const std::size_t end =
                i < text.size() && is_word_char(text[i]) ? token_end(text, i) : i;
            made.word = text.substr(i, end - i);
            directives_.push_back(std::move(made));
            into = &directives_.back().rest;
            line_start = false;
            i = end;
        } else {
            const std::size_t end = token_end(text, i);
            into->push_back({std::string(text.substr(i, end - i)), logical.origin[i],
                             logical.origin[end - 1] + 1, line_of(logical.origin[i])});
            line_start = false;
            i = end;
        }
    }
    if (into != &tokens_) directives_.back().last_line = line_of(source.size());
}

std::size_t GlslText::line_of(std::size_t position) const {
    const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), position);
    return static_cast<std::size_t>(next - line_starts_.begin());
}

std::size_t GlslText::last_line() const {
    const std::size_t of_tokens = tokens_.empty() ? 1 : tokens_.back().line;
    return std::max(of_tokens, directives_.empty() ? 1 : directives_.back().last_line);
}

}  // namespace cubecam::gl
