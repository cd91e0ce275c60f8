// Values for the variables of a user's GLSL that have none.
#include "cubecam/core/error.hpp"
#include "cubecam/gl/glsl_macros.hpp"
#include "cubecam/gl/glsl_outline.hpp"
#include "cubecam/render/passes/shader_names.hpp"
#include "cubecam/render/passes/user_text.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
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
using Tokens = gl::GlslMacros::Tokens;

constexpr std::size_t most_added_bytes = std::size_t{1} << 20;
constexpr std::size_t most_listed = 1024;
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
        : source_(&source), stage_(stage), text_(source.text), outline_(gl::outline(text_)),
          expander_(text_) {
        for (const GlslStructure& structure : shader_names(stage).structures)
            structures_[structure.name] = &structure;
        for (const GlslStructure& structure : outline_.structures) {
            const bool again = declared_.insert(structure.name).second == false;
            if (again) ambiguous_.insert(structure.name);
            structures_[structure.name] = &structure;
            if (structure.end >= text_.tokens().size()) closed_.insert(structure.name);
        }
        std::erase_if(closed_, [this](const auto& name) { return !ambiguous_.contains(name); });
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
        if (depth > most_depth || closed_.contains(type)) return {};
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

    static bool needs_value(const GlslName& name) {
        return !name.initialised && !name.is("const") && !name.is("uniform");
    }

    /// Gives values to the variables that `names` declares; they end at the token `end`, a ';'.
    void fill_declared(const std::vector<GlslName>& names,
                       const std::vector<GlslText::Token>& tokens, std::size_t end,
                       bool can_follow) {
        std::string following;
        for (const GlslName& name : names) {
            if (!needs_value(name)) continue;
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
        std::size_t after_macro = 0;
        for (std::size_t i = function.open + 1; i < function.close; ++i) {
            if (tokens[i].text == "switch") guard_switch(i, function.close);
            const bool in_for = tokens[i - 1].text == "(" && tokens[i - 2].text == "for";
            const bool begins = begins_statement(tokens, i) || i == after_macro;
            if ((!begins && !in_for) || !tokens[i].is_word()) continue;
            if (begins) {
                const std::size_t after = fill_whole_macro(i, function.close);
                if (after > i) {
                    after_macro = after;
                    i = after - 1;
                    continue;
                }
            }
            const std::size_t end = end_of_statement(i, function.close);
            if (end == function.close) continue;
            const std::vector<GlslName> plain = gl::declared_variables(tokens, i, end);
            fill_declared(plain, tokens, end, !in_for);
            fill_hidden(plain, i, end, !in_for);
            if (tokens[i].text == "struct") i = end;  // its members are no variables
        }
        if (outline_.uncertain || !function.returns || function.close >= tokens.size()) return;
        const GlslName& made = function.result;
        const std::string numeric = resolved(made.type);
        if (made.type == "void" || numeric.empty()) return;
        // llvmpipe copies arrays wherever a function could return.
        if (made.dimensions > 0 && ends_with_return(function)) return;
        insert(tokens[function.close].begin, " " + return_of_zero(function) + " ");
    }

    std::string return_of_zero(const GlslFunction& function) {
        const GlslName& made = function.result;
        const bool numeric = is_numeric(resolved(made.type));
        if (numeric && made.dimensions == 0) return "return " + made.type + "(0);";
        // A list of numbers is less work for llvmpipe than a loop.
        const std::size_t open = function.result_text.find('[');
        const std::size_t length =
            numeric && made.dimensions == 1
                ? static_cast<std::size_t>(std::atoi(function.result_text.c_str() + open + 2))
                : 0;
        const std::string head = function.result_text.substr(0, open);
        const std::string plain = "[ " + std::to_string(length) + " ]";
        if (length > 0 && length <= most_listed && head + plain == function.result_text) {
            std::string values;
            for (std::size_t i = 0; i < length; ++i)
                values += (i > 0 ? "," : "") + made.type + "(0)";
            return "return " + made.type + "[](" + values + ");";
        }
        const std::string result = "cubecam_result";
        return "{ " + function.result_text + " " + result + "; " +
               zero(result, made.type, made.dimensions) + " return " + result + "; }";
    }

    bool ends_with_return(const GlslFunction& function) const {
        const auto& tokens = text_.tokens();
        std::size_t i = function.close - 1;
        if (i <= function.open || tokens[i].text != ";") return false;
        while (!begins_statement(tokens, i)) --i;
        return tokens[i].text == "return" && !has_conditions(i - 1, function.close);
    }

    static bool begins_statement(const Tokens& tokens, std::size_t i) {
        const std::string& before = tokens[i - 1].text;
        return before == ";" || before == "{" || before == "}" || before == ":";
    }

    /// Returns the index of the ';' that ends the statement, or `limit` if there is none.
    std::size_t end_of_statement(std::size_t begin, std::size_t limit) const {
        const auto& tokens = text_.tokens();
        int depth = 0;
        for (std::size_t i = begin; i < limit; ++i) {
            const std::string& text = tokens[i].text;
            if (depth == 0 && text == ";") return i;
            if (text == "(" || text == "[" || text == "{") ++depth;
            if (text == ")" || text == "]" || text == "}") --depth;
            if (depth < 0) return limit;
        }
        return limit;
    }

    /// The variables without a value that all results of a macro's expansion declare, and nothing
    /// else; none if one does something else.
    std::vector<GlslName> declared_by(const std::vector<Tokens>& results) const {
        std::optional<std::vector<GlslName>> all;
        for (const Tokens& tokens : results) {
            std::vector<GlslName> names;
            for (std::size_t begin = 0; begin < tokens.size();) {
                std::size_t end = begin;
                while (end < tokens.size() && tokens[end].text != ";") ++end;
                const auto more = gl::declared_variables(tokens, begin, end);
                const bool plain = std::all_of(more.begin(), more.end(), needs_value);
                if (more.empty() || !plain) return {};
                names.insert(names.end(), more.begin(), more.end());
                begin = end + 1;
            }
            if (all && !same(*all, names)) return {};
            all = std::move(names);
        }
        return all ? std::move(*all) : std::vector<GlslName>();
    }

    static bool same(const std::vector<GlslName>& a, const std::vector<GlslName>& b) {
        return std::equal(
            a.begin(), a.end(), b.begin(), b.end(), [](const GlslName& x, const GlslName& y) {
                return x.name == y.name && x.type == y.type && x.dimensions == y.dimensions;
            });
    }

    std::string zeros_of(const std::vector<GlslName>& names) {
        std::string text;
        for (const GlslName& name : names) text += zero(name.name, name.type, name.dimensions);
        return text;
    }

    /// The use of a macro that consists of whole statements, as in `DECLARE_SUM return sum;`.
    /// Returns the index of the token after it; `at` if there is none.
    std::size_t fill_whole_macro(std::size_t at, std::size_t limit) {
        const auto& tokens = text_.tokens();
        const std::size_t after = expander_.after_use(tokens, at, limit);
        if (after == at) return at;
        const auto results = expander_.expanded(tokens, at, after);
        const auto whole = [](const Tokens& made) {
            return !made.empty() && (made.back().text == ";" || made.back().text == "}");
        };
        if (results.empty() || !std::all_of(results.begin(), results.end(), whole)) return at;
        const std::string text = zeros_of(declared_by(results));
        if (!text.empty()) insert(tokens[after - 1].end, " " + text);
        return after;
    }

    /// Gives values to what a statement declares by macros only, as in `FLOAT(sum);`.
    void fill_hidden(const std::vector<GlslName>& plain, std::size_t begin, std::size_t end,
                     bool can_follow) {
        const auto& tokens = text_.tokens();
        if (!expander_.any_in(tokens, begin, end)) return;
        std::optional<std::vector<GlslName>> all;
        for (const Tokens& made : expander_.expanded(tokens, begin, end)) {
            auto names = gl::declared_variables(made, 0, made.size());
            if (all && !same(*all, names)) return;
            all = std::move(names);
        }
        if (!all) return;
        std::erase_if(*all, [&](const GlslName& name) {
            return !needs_value(name) ||
                   std::any_of(plain.begin(), plain.end(), [&](const GlslName& held) {
                       return held.name == name.name && !resolved(held.type).empty();
                   });
        });
        if (can_follow) {
            const std::string text = zeros_of(*all);
            if (!text.empty()) insert(tokens[end].end, " " + text);
        } else if (all->size() == 1 && all->front().dimensions == 0 &&
                   is_numeric(all->front().type)) {
            insert(tokens[end - 1].end, " = " + all->front().type + "(0)");
        }
    }

    /// What a statement declares, by macros or without; `end` becomes the index of its last token.
    std::vector<GlslName> declared_at(std::size_t begin, std::size_t limit,
                                      std::size_t& end) const {
        const auto& tokens = text_.tokens();
        const std::size_t after = expander_.after_use(tokens, begin, limit);
        if (after > begin) {
            auto names = declared_by(expander_.expanded(tokens, begin, after));
            end = after - 1;
            if (!names.empty() && (after == limit || tokens[after].text != ";")) return names;
        }
        end = end_of_statement(begin, limit);
        if (end == limit) return {};
        auto names = gl::declared_variables(tokens, begin, end);
        if (!names.empty() || !expander_.any_in(tokens, begin, end)) return names;
        const auto results = expander_.expanded(tokens, begin, end);
        if (results.size() != 1) return {};
        return gl::declared_variables(results.front(), 0, results.front().size());
    }

    /// A label of `switch` can be reached past a declaration. There the variable gets a value
    /// unless the declaration was passed, which an own variable notes.
    void guard_switch(std::size_t at, std::size_t limit) {
        const auto& tokens = text_.tokens();
        if (at + 1 >= limit || tokens[at + 1].text != "(") return;
        const std::size_t open = gl::after_bracket(tokens, at + 1, limit);
        if (open >= limit || tokens[open].text != "{") return;
        const std::size_t close = gl::after_bracket(tokens, open, limit) - 1;
        const bool closed = tokens[close].text == "}" && !outline_.uncertain;
        if (!closed || !conditions_nest(at, close)) return;
        std::string notes;
        std::vector<std::pair<std::string, std::string>> passed;  // notes and values
        for (std::size_t i = open + 1; i < close; ++i) {
            const std::string& text = tokens[i].text;
            if (text == "{" || text == "(") {
                i = gl::after_bracket(tokens, i, close) - 1;
            } else if (is_label(text)) {
                while (i < close && tokens[i].text != ":") ++i;
                for (const auto& [note, values] : passed)
                    insert(tokens[i].end, " if (!" + note + ") { " + values + " }");
            } else if (begins_statement(tokens, i) && tokens[i].is_word()) {
                std::size_t end = i;
                std::vector<GlslName> names = declared_at(i, close, end);
                const std::size_t label = next_label(end, close);
                // No #if leaves it out, or a part of it.
                const bool always = condition_depth(open, i) == 0 && !has_conditions(i, end);
                std::erase_if(names, [&](const GlslName& name) {
                    return !always || name.is("const") || !mentioned(name.name, label, close);
                });
                const std::string values = zeros_of(names);
                if (values.empty()) continue;
                const std::string note = "cubecam_passed_" + std::to_string(count_++);
                notes += "bool " + note + " = false; ";
                insert(tokens[end].end, " " + note + " = true;");
                passed.emplace_back(note, values);
                i = end;
            }
        }
        if (passed.empty()) return;
        insert(tokens[at].begin, "{ " + notes);
        insert(tokens[close].end, " }");
    }

    static bool is_label(std::string_view word) { return word == "case" || word == "default"; }

    std::size_t next_label(std::size_t begin, std::size_t limit) const {
        const auto& tokens = text_.tokens();
        while (begin < limit && !is_label(tokens[begin].text)) ++begin;
        return begin;
    }

    /// Whether a name stands among the tokens, or may stand in a macro that is used there.
    bool mentioned(const std::string& name, std::size_t begin, std::size_t end) const {
        const auto& tokens = text_.tokens();
        const auto macros = expander_.holding(name);
        const auto pasting = expander_.holding("#");
        for (std::size_t i = begin; i < end; ++i) {
            const std::string& text = tokens[i].text;
            if (text == name || macros.contains(text) || pasting.contains(text)) return true;
        }
        return false;
    }

    bool has_conditions(std::size_t begin, std::size_t end) const {
        return std::any_of(text_.directives().begin(), text_.directives().end(),
                           [=](const GlslText::Directive& directive) {
                               return directive.is_conditional() &&
                                      directive.before_token > begin &&
                                      directive.before_token <= end;
                           });
    }

    /// Whether all conditions of which a part stands between two tokens begin and end there.
    bool conditions_nest(std::size_t begin, std::size_t end) const {
        int depth = 0;
        for (const GlslText::Directive& directive : text_.directives()) {
            const bool inside = directive.before_token > begin && directive.before_token <= end;
            if (!inside || !directive.is_conditional()) continue;
            if (directive.word.starts_with("if")) {
                ++depth;
            } else if (depth == 0) {
                return false;
            } else if (directive.word == "endif") {
                --depth;
            }
        }
        return depth == 0;
    }

    /// In how many conditions that begin after the token `begin` the token `at` stands.
    int condition_depth(std::size_t begin, std::size_t at) const {
        int depth = 0;
        for (const GlslText::Directive& directive : text_.directives()) {
            if (directive.before_token <= begin || directive.before_token > at) continue;
            depth += directive.word.starts_with("if") ? 1 : directive.word == "endif" ? -1 : 0;
        }
        return depth;
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
                if (before == "{" && i > 2 && rest[i - 3].text == "struct") {
                    while (i < rest.size() && rest[i].text != "}") ++i;
                    continue;
                }
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
    gl::GlslMacros expander_;
    std::map<std::string, const GlslStructure*> structures_;
    std::map<std::string, std::set<std::string>> aliases_;
    std::set<std::string> declared_, ambiguous_;  ///< names of structures; declared more than once
    std::set<std::string> closed_;                ///< ambiguous ones that get no function
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
