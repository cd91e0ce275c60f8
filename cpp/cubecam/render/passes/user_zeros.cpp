// Values for the variables of a user's GLSL that have none.
#include "cubecam/core/error.hpp"
#include "cubecam/gl/glsl_outline.hpp"
#include "cubecam/render/passes/shader_names.hpp"
#include "cubecam/render/passes/user_text.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace cubecam {
namespace {

using gl::GlslFunction;
using gl::GlslName;
using gl::GlslStructure;
using gl::GlslText;

constexpr std::size_t most_added_bytes = std::size_t{1} << 20;
constexpr int most_depth = 32;  ///< of structures and macros inside each other
constexpr const char* zeros_function = "void cubecam_zeros()";

/// Whether `type(0)` is a value of a type: numbers, bools, vectors and matrices.
bool is_numeric(std::string_view type) {
    for (const std::string_view scalar : {"float", "int", "uint", "bool", "double"}) {
        if (type == scalar) return true;
    }
    for (const std::string_view stem : {"vec", "ivec", "uvec", "bvec", "dvec", "mat", "dmat"}) {
        if (!type.starts_with(stem)) continue;
        std::string_view size = type.substr(stem.size());
        const auto digit = [](char c) { return c >= '2' && c <= '4'; };
        const bool matrix = stem.ends_with("mat");
        if (size.size() == 1 && digit(size[0])) return true;
        if (matrix && size.size() == 3 && digit(size[0]) && size[1] == 'x' && digit(size[2]))
            return true;
    }
    return false;
}

class Zeros {
public:
    Zeros(const UserSource& source, UserStage stage)
        : source_(&source), stage_(stage), text_(source.text), outline_(gl::outline(text_)) {
        for (const GlslStructure& structure : shader_names(stage).structures)
            structures_[structure.name] = &structure;
        for (const GlslStructure& structure : outline_.structures) {
            const bool again = declared_.insert(structure.name).second == false;
            if (again) ambiguous_.insert(structure.name);
            structures_[structure.name] = &structure;
        }
        for (const GlslText::Directive& directive : text_.directives()) {
            if (directive.word != "define" || directive.rest.empty()) continue;
            macros_.insert(directive.rest[0].text);
            if (const auto alias = alias_of(directive)) {
                aliases_[directive.rest[0].text].insert(*alias);
            }
        }
    }

    PreparedText run() {
        for (const GlslStructure& structure : outline_.structures) add_function(structure);
        for (const GlslFunction& function : outline_.functions) fill(function);
        fill_macros();
        PreparedText prepared{edited(), after()};
        if (prepared.text.size() + prepared.after.size() >
            source_->text.size() + most_added_bytes) {
            throw ShaderError(std::string(title_of(*source_, stage_)) +
                              ": expected smaller structures, got some with too many members");
        }
        return prepared;
    }

private:
    /// The word that a macro without parameters stands for, as in `#define real highp float`.
    static std::optional<std::string> alias_of(const GlslText::Directive& directive) {
        const auto& rest = directive.rest;
        std::optional<std::string> word;
        for (std::size_t i = 1; i < rest.size(); ++i) {
            const std::string& text = rest[i].text;
            if (text == "highp" || text == "mediump" || text == "lowp") continue;
            if (word || !rest[i].is_word()) return {};
            word = text;
        }
        return word;
    }

    /// A type without the macros that hide it; empty if it is not known or holds textures.
    std::string resolved(const std::string& type, int depth = 0) const {
        if (is_numeric(type)) return type;
        if (depth > most_depth) return {};
        if (const auto found = structures_.find(type); found != structures_.end())
            return is_complete(*found->second, depth + 1) ? type : std::string();
        const auto found = aliases_.find(type);
        if (found == aliases_.end()) return {};
        std::set<std::string> types;
        for (const std::string& alias : found->second) types.insert(resolved(alias, depth + 1));
        if (types.contains("")) return {};
        if (types.size() == 1) return *types.begin();
        // Of several types only `type(0)` can be written.
        return std::all_of(types.begin(), types.end(), is_numeric) ? "float" : std::string();
    }

    bool is_complete(const GlslStructure& structure, int depth) const {
        return std::all_of(
            structure.members.begin(), structure.members.end(),
            [&](const GlslName& member) { return !resolved(member.type, depth).empty(); });
    }

    /// Branches of a condition may declare structures of one name: each of these gets its own
    /// function that sets it to 0. For others the members are set where a variable is declared,
    /// since llvmpipe copies the parameter of a function, which takes long for a large array.
    void add_function(const GlslStructure& structure) {
        const auto& tokens = text_.tokens();
        if (!ambiguous_.contains(structure.name)) return;
        if (structure.end >= tokens.size() || !is_complete(structure, 0)) return;
        std::string body;
        for (const GlslName& member : structure.members)
            body += zero("cubecam_value." + member.name, member.type, member.dimensions) + " ";
        insert(tokens[structure.end].end,
               " void cubecam_zero(out " + structure.name + " cubecam_value) { " + body + "}");
    }

    /// Statements that set a variable to 0; empty if its type is not known.
    std::string zero(const std::string& name, const std::string& type, std::size_t dimensions) {
        if (added_ > most_added_bytes) return {};
        if (dimensions > 0) {
            const std::string index = "cubecam_" + std::to_string(count_++);
            const std::string inner = zero(name + "[" + index + "]", type, dimensions - 1);
            if (inner.empty()) return {};
            return "for (int " + index + " = 0; " + index + " < " + name + ".length(); ++" + index +
                   ") { " + inner + "}";
        }
        const std::string real = resolved(type);
        if (real.empty()) return {};
        if (is_numeric(real)) {
            std::string text = name + " = " + type + "(0);";
            added_ += text.size();
            return text;
        }
        if (ambiguous_.contains(real)) return "cubecam_zero(" + name + ");";
        std::string all;
        for (const GlslName& member : structures_.at(real)->members) {
            all += zero(name + "." + member.name, member.type, member.dimensions);
        }
        return all;
    }

    void insert(std::size_t position, std::string text) {
        if (!text.empty()) insertions_.emplace_back(position, std::move(text));
    }

    /// Gives values to the variables that `names` declares; they end at the token `end`, a ';'.
    void fill_declared(const std::vector<GlslName>& names,
                       const std::vector<GlslText::Token>& tokens, std::size_t end,
                       bool can_follow) {
        std::string following;
        for (const GlslName& name : names) {
            if (name.initialised || name.is("const") || name.is("uniform")) continue;
            const std::string real = resolved(name.type);
            if (real.empty()) continue;
            if (name.dimensions == 0 && is_numeric(real)) {
                insert(tokens[name.token].end, " = " + name.type + "(0)");
            } else if (can_follow) {
                following += zero(name.name, name.type, name.dimensions);
            }
        }
        if (!following.empty()) insert(tokens[end].end, " " + following);
    }

    void fill(const GlslFunction& function) {
        const auto& tokens = text_.tokens();
        for (const GlslName& parameter : function.parameters) {
            if (!parameter.is("out")) continue;
            insert(tokens[function.open].end,
                   " " + zero(parameter.name, parameter.type, parameter.dimensions));
        }
        std::vector<std::string> open;
        for (std::size_t i = function.open + 1; i < function.close; ++i) {
            const std::string& before = tokens[i - 1].text;
            const bool in_for = before == "(" && tokens[i - 2].text == "for";
            const bool begins = before == ";" || before == "{" || before == "}" || before == ":";
            if ((!begins && !in_for) || !tokens[i].is_word()) continue;
            std::size_t end = i;
            int depth = 0;
            while (end < function.close && (depth > 0 || tokens[end].text != ";")) {
                const std::string& text = tokens[end].text;
                if (text == "(" || text == "[" || text == "{") ++depth;
                if (text == ")" || text == "]" || text == "}") --depth;
                if (depth < 0) break;
                ++end;
            }
            if (end == function.close || depth != 0) continue;
            fill_declared(gl::declared_variables(tokens, i, end), tokens, end, !in_for);
            if (tokens[i].text == "struct") i = end;  // its members are no variables
        }
        if (outline_.uncertain || !function.returns || function.close >= tokens.size()) return;
        if (function.type == "void" || resolved(function.type).empty()) return;
        const std::string result = "cubecam_result";
        std::string brackets;
        if (function.dimensions > 0) return;
        const std::string numeric = resolved(function.type);
        const std::string text = is_numeric(numeric) ? " return " + function.type + "(0);"
                                                     : " { " + function.type + " " + result + "; " +
                                                           zero(result, function.type, 0) +
                                                           " return " + result + "; }";
        insert(tokens[function.close].begin, text + " ");
    }

    /// Whole declarations in macros: `#define BEGIN float sum; int count;`.
    void fill_macros() {
        for (const GlslText::Directive& directive : text_.directives()) {
            if (directive.word != "define") continue;
            const auto& rest = directive.rest;
            for (std::size_t i = 1; i < rest.size(); ++i) {
                const std::string& before = rest[i - 1].text;
                const bool begins =
                    i == 1 || before == ";" || before == "{" || before == ")" || before == "}";
                if (!begins || !rest[i].is_word()) continue;
                std::size_t end = i;
                while (end < rest.size() && rest[end].text != ";") ++end;
                if (end == rest.size()) break;
                fill_declared(gl::declared_variables(rest, i, end), rest, end, false);
            }
        }
    }

    std::string edited() {
        std::stable_sort(insertions_.begin(), insertions_.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::string text;
        std::size_t done = 0;
        for (const auto& [position, added] : insertions_) {
            text.append(source_->text, done, position - done).append(added);
            done = position;
        }
        return text.append(source_->text, done);
    }

    std::string forget_macros() const {
        std::string text;
        for (const std::string& macro : macros_) text += "#undef " + macro + "\n";
        return text;
    }

    /// A preprocessor line as it was written.
    static std::string written(const GlslText::Directive& directive) {
        std::string text = "#" + directive.word;
        std::size_t end = 0;
        for (const GlslText::Token& token : directive.rest) {
            if (token.begin > end) text += ' ';
            text += token.text;
            end = token.end;
        }
        return text + "\n";
    }

    /// Variables outside of functions can exist on a condition, so the function that sets them
    /// repeats the preprocessor lines.
    std::string after() {
        std::string repeated;
        bool any = false;
        std::size_t next = 0;
        const auto& directives = text_.directives();
        const auto repeat = [&](std::size_t before_token) {
            for (; next < directives.size() && directives[next].before_token <= before_token;
                 ++next) {
                const std::string& word = directives[next].word;
                if (directives[next].is_conditional() || word == "define" || word == "undef")
                    repeated += written(directives[next]);
            }
        };
        for (const GlslName& name : outline_.names) {
            if (name.kind != GlslName::Kind::variable || name.initialised) continue;
            if (name.is("const") || name.is("uniform") || name.is("in") || name.is("attribute") ||
                name.is("varying")) {
                continue;
            }
            repeat(name.token);
            const std::string statements = zero(name.name, name.type, name.dimensions);
            any = any || !statements.empty();
            repeated += statements + "\n";
        }
        repeat(text_.tokens().size());
        std::string body = any ? forget_macros() + repeated : "";
        if (stage_ != UserStage::vertex) body += built_in_zeros();
        return forget_macros() + zeros_function + " {\n" + body + "}\n" + forget_macros();
    }

    /// A fragment shader that writes one of these on some ways only leaves it undefined on others.
    std::string built_in_zeros() const {
        std::string text;
        if (mentions(source_->text, "gl_FragDepth")) text += "gl_FragDepth = gl_FragCoord.z;\n";
        if (mentions(source_->text, "gl_SampleMask")) text += "gl_SampleMask[0] = ~0;\n";
        return text;
    }

    const UserSource* source_;
    UserStage stage_;
    GlslText text_;
    gl::GlslOutline outline_;
    std::map<std::string, const GlslStructure*> structures_;
    std::map<std::string, std::set<std::string>> aliases_;
    std::set<std::string> declared_, ambiguous_;  ///< names of structures; declared more than once
    std::set<std::string> macros_;
    std::vector<std::pair<std::size_t, std::string>> insertions_;
    std::size_t count_ = 0;
    std::size_t added_ = 0;
};

}  // namespace

PreparedText prepare_user_text(const UserSource& source, UserStage stage) {
    return Zeros(source, stage).run();
}

}  // namespace cubecam
