// What a user's GLSL may not contain.
#include "cubecam/render/passes/user_text.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/glsl_outline.hpp"
#include "cubecam/gl/program.hpp"
#include "cubecam/render/passes/output_declarations.hpp"
#include "cubecam/render/passes/shader_names.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <vector>

namespace cubecam {
namespace {

// Sources that are longer than these make drivers use much memory or end the process. Long sources
// of real programs have a tenth of it.
constexpr std::size_t most_bytes = std::size_t{1} << 20;
constexpr std::size_t most_tokens = 100'000;
constexpr std::size_t most_functions = 1'000;
constexpr std::size_t most_brackets = 200;     ///< inside each other
constexpr std::size_t most_operators = 2'000;  ///< in one expression
constexpr std::size_t most_elements = 65'536;  ///< of an array

/// Built-in variables that the own main() writes after a user's vertex().
constexpr std::array<std::string_view, 5> vertex_results = {
    "gl_Position", "gl_Layer", "gl_ViewportIndex", "gl_ClipDistance", "gl_CullDistance"};

class Checker {
public:
    Checker(const UserSource& source, UserStage stage)
        : source_(&source), stage_(stage), names_(&shader_names(stage)), text_(source.text),
          outline_(gl::outline(text_)) {}

    void run() const {
        check_size();
        check_characters();
        if (const auto line = text_.open_comment())
            refuse_line(*line, "expected a comment that ends, got one without */");
        check_number_signs();
        check_conditions();
        check_macros();
        check_amounts();
        if (outline_.open_bracket) {
            const std::string bracket(1, outline_.open_bracket_kind);
            refuse_line(*outline_.open_bracket,
                        "expected a bracket that closes this " + bracket + ", got none");
        }
        for (const gl::GlslName& name : outline_.names) check_name(name);
        check_structures();
        check_words();
        check_function();
    }

private:
    [[noreturn]] void refuse_line(std::size_t line, const std::string& message) const {
        throw gl::source_error(shown(), line, message);
    }

    gl::ShaderSource shown() const {
        return {.name = "", .text = source_->text, .title = title_of(*source_, stage_)};
    }

    void check_size() const {
        if (source_->text.size() <= most_bytes) return;
        throw ShaderError(std::string(title_of(*source_, stage_)) + ": expected at most " +
                          std::to_string(most_bytes) + " bytes of GLSL, got " +
                          std::to_string(source_->text.size()));
    }

    void check_characters() const {
        const std::string& text = source_->text;
        for (std::size_t i = 0; i < text.size(); ++i) {
            const auto c = static_cast<unsigned char>(text[i]);
            const bool blank = c >= '\t' && c <= '\f';
            if (c >= 32 || blank) continue;
            std::array<char, 8> hex{};
            std::snprintf(hex.data(), hex.size(), "%02X", static_cast<unsigned>(c));
            refuse_line(text_.line_of(i),
                        std::string("expected text, got the control character ") + hex.data());
        }
        for (const gl::GlslText::Token& token : text_.tokens()) check_ascii(token);
        for (const gl::GlslText::Directive& directive : text_.directives()) {
            if (directive.word == "error" || directive.word == "pragma") continue;
            for (const gl::GlslText::Token& token : directive.rest) check_ascii(token);
        }
    }

    void check_ascii(const gl::GlslText::Token& token) const {
        if (static_cast<unsigned char>(token.text[0]) < 128) return;
        refuse_line(token.line,
                    "expected ASCII characters outside of comments, got \"" + token.text + '"');
    }

    /// Mesa takes a '#' within a line for the beginning of a directive, too.
    void check_number_signs() const {
        const auto refuse_sign = [this](const gl::GlslText::Token& token) {
            refuse_line(token.line, "expected # at the beginning of a line, got one within a line");
        };
        for (const gl::GlslText::Token& token : text_.tokens()) {
            if (token.text == "#") refuse_sign(token);
        }
        for (const gl::GlslText::Directive& directive : text_.directives()) {
            if (directive.word == "error" || directive.word == "pragma") continue;
            const auto& rest = directive.rest;
            for (std::size_t i = 0; i < rest.size(); ++i) {
                if (rest[i].text != "#") continue;
                const bool pasting = directive.word == "define" && i + 1 < rest.size() &&
                                     rest[i + 1].text == "#" && rest[i].end == rest[i + 1].begin;
                if (!pasting) refuse_sign(rest[i]);
                ++i;
            }
        }
    }

    void check_conditions() const {
        std::vector<const gl::GlslText::Directive*> open;
        std::vector<bool> has_else;
        for (const gl::GlslText::Directive& directive : text_.directives()) {
            if (!directive.is_conditional()) continue;
            if (directive.word.starts_with("if")) {
                open.push_back(&directive);
                has_else.push_back(false);
                continue;
            }
            if (open.empty()) {
                refuse_line(directive.line,
                            "expected an #if before this #" + directive.word + ", got none");
            }
            if (directive.word == "endif") {
                open.pop_back();
                has_else.pop_back();
                continue;
            }
            if (has_else.back())
                refuse_line(directive.line, "expected #endif after #else, got #" + directive.word);
            has_else.back() = directive.word == "else";
        }
        if (!open.empty()) {
            refuse_line(open.back()->line,
                        "expected an #endif for this #" + open.back()->word + ", got none");
        }
    }

    void check_macros() const {
        for (const gl::GlslText::Directive& directive : text_.directives()) {
            const std::string& word = directive.word;
            if (word == "include") {
                refuse_line(directive.line, "expected GLSL in one piece, got an #include");
            }
            if ((word != "define" && word != "undef") || directive.rest.empty()) continue;
            const std::string& name = directive.rest[0].text;
            if (is_own(name) || name == "main" || name.starts_with("gl_")) {
                refuse_line(directive.line, "expected a macro with a name that cubecam's own "
                                            "shaders do not use, got " +
                                                name);
            }
            check_macro_arrays(directive);
        }
    }

    /// A declaration in a macro cannot be found where the macro is used, so its array would not get
    /// values.
    void check_macro_arrays(const gl::GlslText::Directive& directive) const {
        const auto& rest = directive.rest;
        for (std::size_t i = 1; i + 2 < rest.size(); ++i) {
            const std::size_t after = rest[i + 1].text == "[" && rest[i + 2].text == "]" ? 3 : 1;
            const bool declares = rest[i].is_word() && rest[i + 1].is_word() &&
                                  rest[i + 2].text == "[" && rest[i].text != "return";
            bool typed = false;
            if (rest[i].is_word() && rest[i + 1].text == "[") {
                std::size_t close = i + after;
                while (close < rest.size() && rest[close].text != "]") ++close;
                typed = close + 1 < rest.size() && rest[close + 1].is_word();
            }
            if (declares || typed) {
                refuse_line(directive.line,
                            "expected a macro that declares no array, got " + rest[0].text);
            }
        }
    }

    void check_amounts() const {
        const auto& tokens = text_.tokens();
        if (tokens.size() > most_tokens) {
            refuse_line(tokens[most_tokens].line,
                        "expected at most " + std::to_string(most_tokens) +
                            " words and operators, got " + std::to_string(tokens.size()));
        }
        if (outline_.functions.size() > most_functions) {
            refuse_line(outline_.functions[most_functions].line,
                        "expected at most " + std::to_string(most_functions) + " functions, got " +
                            std::to_string(outline_.functions.size()));
        }
        std::size_t depth = 0;
        std::size_t operators = 0;
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            const std::string& text = tokens[i].text;
            if (text == "(" || text == "[" || text == "{") {
                ++depth;
            } else if ((text == ")" || text == "]" || text == "}") && depth > 0) {
                --depth;
            }
            if (text == ";" || text == "," || text == "{" || text == "}") {
                operators = 0;
            } else if (!tokens[i].is_word() && text != "." && text != "(" && text != ")" &&
                       std::string_view("0123456789").find(text[0]) == std::string_view::npos) {
                ++operators;
            }
            if (depth > most_brackets) {
                refuse_line(tokens[i].line, "expected at most " + std::to_string(most_brackets) +
                                                " brackets inside each other, got more");
            }
            if (operators > most_operators) {
                refuse_line(tokens[i].line, "expected at most " + std::to_string(most_operators) +
                                                " operators in one expression, got more");
            }
            if (text == "[" && i + 2 < tokens.size() && tokens[i + 2].text == "]")
                check_length(tokens[i + 1]);
        }
        for (const gl::GlslText::Directive& directive : text_.directives()) {
            if (directive.rest.size() > most_tokens)
                refuse_line(directive.line, "expected a shorter macro");
        }
    }

    void check_length(const gl::GlslText::Token& token) const {
        const std::string& digits = token.text;
        if (digits[0] < '0' || digits[0] > '9') return;
        unsigned long long length = 0;
        try {
            length = std::stoull(digits, nullptr, 0);
        } catch (const std::out_of_range&) {
            length = most_elements + 1;
        }
        if (length > most_elements) {
            refuse_line(token.line, "expected arrays of at most " + std::to_string(most_elements) +
                                        " elements, got " + digits);
        }
    }

    void check_name(const gl::GlslName& name) const {
        using Kind = gl::GlslName::Kind;
        if (name.kind == Kind::function && name.name == "main") {
            refuse_line(name.line, "expected no main(), since cubecam's own calls " +
                                       std::string(function_name()) + "(), got one");
        }
        if (name.is("subroutine"))
            refuse_line(name.line, "expected functions, got the subroutine " + name.name);
        if (name.is("buffer"))
            refuse_line(name.line, "expected uniforms and textures, got the buffer " + name.name);
        if (name.is("shared"))
            refuse_line(name.line, "expected no shared variables, got " + name.name);
        if (name.kind == Kind::block) {
            refuse_line(name.line,
                        name.is("uniform")
                            ? "expected uniforms outside of blocks, got the block " + name.name
                            : "expected variables outside of blocks, got the block " + name.name);
        }
        if (name.kind == Kind::member) return;
        if (name.is("uniform")) check_opaque(name);
        if (name.kind == Kind::variable) check_stage(name);
        const bool documented_function =
            name.kind == Kind::function && is_documented(name.name) && !is_structure(name.name);
        if (documented_function) return;  // with other parameters it is another function
        if (is_own(name.name) || is_documented(name.name)) {
            refuse_line(name.line,
                        "expected a name that cubecam's own shaders do not use, got " + name.name);
        }
        if (name.name.starts_with("gl_") && name.kind == Kind::variable) {
            refuse_line(name.line,
                        "expected built-in variables as they are, got a declaration of " +
                            name.name);
        }
    }

    void check_structures() const {
        const auto& tokens = text_.tokens();
        for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
            if (tokens[i].text == "struct" && tokens[i + 1].text == "{")
                refuse_line(tokens[i].line, "expected a struct with a name, got one without");
        }
    }

    void check_opaque(const gl::GlslName& name) const {
        const std::string& type = name.type;
        for (const char* kind : {"image", "iimage", "uimage", "atomic_uint"}) {
            if (!type.starts_with(kind)) continue;
            refuse_line(name.line, "uniform " + name.name +
                                       ": expected numbers, a sampler2D or a samplerCube, got " +
                                       type);
        }
    }

    void check_stage(const gl::GlslName& name) const {
        if (name.is("in") && stage_ == UserStage::vertex) {
            refuse_line(
                name.line,
                "expected vertices with position, normal, uv and color, got the attribute " +
                    name.name);
        }
        if (stage_ != UserStage::effect || (!name.is("in") && !name.is("out"))) return;
        refuse_line(name.line, "expected an effect that returns a colour, got the " +
                                   std::string(name.is("in") ? "input " : "output ") + name.name);
    }

    bool is_structure(std::string_view name) const {
        return std::any_of(names_->structures.begin(), names_->structures.end(),
                           [name](const gl::GlslStructure& held) { return held.name == name; });
    }

    bool is_own(std::string_view name) const {
        if (name.starts_with("cubecam_")) return true;
        if (is_documented(name)) return false;
        return names_->macros.contains(name) || names_->variables.contains(name) ||
               names_->functions.contains(name) || names_->blocks.contains(name) ||
               is_structure(name);
    }

    /// Refuses words that have another meaning, or none, in some variants of the program.
    void check_words() const {
        const auto& tokens = text_.tokens();
        for (std::size_t i = 0; i < tokens.size(); ++i) {
            if (!tokens[i].is_word() || (i > 0 && tokens[i - 1].text == ".")) continue;
            const std::string& word = tokens[i].text;
            const bool prefixed = word.size() > 2 && word[1] == '_' &&
                                  std::string_view("uvao").find(word[0]) != std::string_view::npos;
            const bool called = i + 1 < tokens.size() && tokens[i + 1].text == "(";
            if ((prefixed && names_->variables.contains(word)) ||
                (!is_documented(word) && names_->macros.contains(word) &&
                 (!is_lower(word) || called || prefixed)) ||
                word.starts_with("cubecam_")) {
                refuse_line(tokens[i].line,
                            "expected a name that cubecam's own shaders do not use, got " + word);
            }
            const bool result = std::find(vertex_results.begin(), vertex_results.end(), word) !=
                                vertex_results.end();
            if (stage_ == UserStage::vertex && result) {
                refuse_line(tokens[i].line,
                            "expected a vertex that moves by vertex.position, got " + word);
            }
        }
    }

    static bool is_lower(std::string_view word) {
        return std::any_of(word.begin(), word.end(), [](char c) { return c >= 'a' && c <= 'z'; });
    }

    std::string_view function_name() const {
        return stage_ == UserStage::vertex   ? "vertex"
               : stage_ == UserStage::effect ? "effect"
                                             : "shade";
    }

    std::string expected_function() const {
        switch (stage_) {
            case UserStage::vertex: return "void vertex(inout Vertex vertex)";
            case UserStage::effect: return "vec4 effect(vec2 uv), or vec3 to keep the alpha";
            default: return "vec3 shade(Surface surface), or vec4 with an alpha";
        }
    }

    void check_function() const {
        const std::string_view wanted = function_name();
        const auto mentioned = [wanted](const gl::GlslText::Token& token) {
            return token.text == wanted;
        };
        for (const gl::GlslText::Directive& directive : text_.directives()) {
            if (std::any_of(directive.rest.begin(), directive.rest.end(), mentioned)) return;
        }
        if (outline_.uncertain) return;
        std::optional<std::string> other;
        std::size_t line = 0;
        for (const gl::GlslFunction& function : outline_.functions) {
            if (function.name != wanted) continue;
            if (fits(function)) return;
            if (!other) {
                other = described(function);
                line = function.line;
            }
        }
        if (!other) {
            const auto at = std::find_if(text_.tokens().begin(), text_.tokens().end(), mentioned);
            const bool found = at != text_.tokens().end();
            line = found ? at->line : line_of_word(wanted);
            const bool declared = std::any_of(
                outline_.names.begin(), outline_.names.end(), [wanted](const gl::GlslName& name) {
                    return name.kind == gl::GlslName::Kind::function && name.name == wanted;
                });
            other = declared ? "one without a body"
                    : found  ? "only the name"
                             : "it only in a comment";
        }
        refuse_line(line, "expected a function " + expected_function() + ", got " + *other);
    }

    /// Whether the own main() can call a function. A type that is a macro is left to the driver.
    bool fits(const gl::GlslFunction& function) const {
        const auto is_macro = [this](const std::string& type) {
            return std::any_of(text_.directives().begin(), text_.directives().end(),
                               [&type](const gl::GlslText::Directive& directive) {
                                   return directive.word == "define" && !directive.rest.empty() &&
                                          directive.rest[0].text == type;
                               });
        };
        const bool vertex = stage_ == UserStage::vertex;
        const bool right_type =
            vertex ? function.type == "void" : function.type == "vec3" || function.type == "vec4";
        if (!right_type && !is_macro(function.type)) return false;
        if (function.dimensions > 0) return false;
        const auto& tokens = text_.tokens();
        // The last token before the brace is ')': a parameter may have no name.
        std::size_t open = function.open;
        while (open > 0 && tokens[open].text != "(") --open;
        std::string type;
        std::size_t commas = 0;
        bool inout = false;
        for (std::size_t i = open + 1; i + 1 < function.open; ++i) {
            if (tokens[i].text == "inout") inout = true;
            if (tokens[i].text == ",") ++commas;
            if (type.empty() && tokens[i].is_word() && !is_qualifier(tokens[i].text))
                type = tokens[i].text;
        }
        const char* wanted = vertex ? "Vertex" : stage_ == UserStage::effect ? "vec2" : "Surface";
        return commas == 0 && (type == wanted || is_macro(type)) && (!vertex || inout);
    }

    static bool is_qualifier(std::string_view word) {
        return word == "in" || word == "inout" || word == "out" || word == "const" ||
               word == "highp" || word == "mediump" || word == "lowp" || word == "precise";
    }

    std::string described(const gl::GlslFunction& function) const {
        const auto& tokens = text_.tokens();
        std::size_t begin = function.open;
        while (begin > 0 && tokens[begin].text != function.name) --begin;
        std::string text = function.type + " ";
        for (std::size_t i = begin; i < function.open; ++i) {
            const bool space = i > begin && tokens[i].is_word() && tokens[i - 1].is_word();
            text += (space ? " " : "") + tokens[i].text;
        }
        return text;
    }

    std::size_t line_of_word(std::string_view word) const {
        for (std::size_t at = source_->text.find(word); at != std::string::npos;
             at = source_->text.find(word, at + 1)) {
            if (mentions(source_->text.substr(at == 0 ? 0 : at - 1, word.size() + 2), word))
                return text_.line_of(at);
        }
        return 1;
    }

    const UserSource* source_;
    UserStage stage_;
    const ShaderNames* names_;
    gl::GlslText text_;
    gl::GlslOutline outline_;
};

}  // namespace

std::string_view title_of(const UserSource& source, UserStage stage) {
    if (!source.path.empty()) return source.path;
    return stage == UserStage::vertex ? "vertex" : "fragment";
}

void check_user_text(const UserSource& source, UserStage stage) { Checker(source, stage).run(); }

}  // namespace cubecam
