// The declarations of a GLSL source (GLSL 4.50, chapter 4). This file does not use OpenGL.
#include "cubecam/gl/glsl_outline.hpp"

#include "cubecam/gl/glsl_macros.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <set>
#include <utility>

namespace cubecam::gl {
namespace {

using Tokens = std::vector<GlslText::Token>;

constexpr std::array<std::string_view, 27> qualifier_words = {
    "const",     "in",       "out",       "inout",         "uniform",    "buffer",   "shared",
    "attribute", "varying",  "centroid",  "sample",        "patch",      "flat",     "smooth",
    "highp",     "mediump",  "lowp",      "noperspective", "precise",    "coherent", "volatile",
    "restrict",  "readonly", "writeonly", "invariant",     "subroutine", "layout"};

/// Words that may stand before another word without being its type.
constexpr std::array<std::string_view, 11> no_types = {
    "return", "else", "do", "case", "struct", "precision", "goto", "if", "for", "while", "switch"};

template <std::size_t n>
bool is_in(const std::array<std::string_view, n>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

/// What stands before the name of a declaration.
struct Head {
    std::vector<std::string> qualifiers;
    bool has_layout_location = false;
    std::string type;  ///< empty: there is none
    std::size_t dimensions = 0;
    std::size_t next = 0;  ///< the index of the token after it
};

std::size_t skip_dimensions(const Tokens& tokens, std::size_t at, std::size_t end,
                            std::size_t& dimensions) {
    while (at < end && tokens[at].text == "[") {
        ++dimensions;
        at = after_bracket(tokens, at, end);
    }
    return at;
}

void read_qualifiers(const Tokens& tokens, std::size_t end, Head& head) {
    while (head.next < end && is_in(qualifier_words, tokens[head.next].text)) {
        const std::string& word = tokens[head.next].text;
        head.qualifiers.push_back(word);
        ++head.next;
        if (head.next == end || tokens[head.next].text != "(") continue;
        if (word != "layout" && word != "subroutine") continue;
        const std::size_t close = after_bracket(tokens, head.next, end);
        for (std::size_t i = head.next; i < close; ++i) {
            if (tokens[i].text == "location") head.has_layout_location = true;
        }
        head.next = close;
    }
}

Head read_head(const Tokens& tokens, std::size_t begin, std::size_t end) {
    Head head;
    head.next = begin;
    read_qualifiers(tokens, end, head);
    if (head.next == end || !tokens[head.next].is_word()) return head;
    if (is_in(no_types, tokens[head.next].text)) return head;
    head.type = tokens[head.next].text;
    head.next = skip_dimensions(tokens, head.next + 1, end, head.dimensions);
    return head;
}

GlslName name_of(const Head& head, const Tokens& tokens, std::size_t at, GlslName::Kind kind) {
    return {kind,
            tokens[at].text,
            head.type,
            head.dimensions,
            head.qualifiers,
            head.has_layout_location,
            false,
            at,
            tokens[at].line};
}

/// Reads `name[3] = value, name, ...`.
void read_variables(const Tokens& tokens, std::size_t at, std::size_t end, const Head& head,
                    GlslName::Kind kind, std::vector<GlslName>& names) {
    while (at < end && tokens[at].is_word()) {
        GlslName name = name_of(head, tokens, at, kind);
        at = skip_dimensions(tokens, at + 1, end, name.dimensions);
        if (at < end && tokens[at].text == "=") {
            name.initialised = true;
            while (at < end && tokens[at].text != ",") {
                const std::string& text = tokens[at].text;
                const bool open = text == "(" || text == "[" || text == "{";
                at = open ? after_bracket(tokens, at, end) : at + 1;
            }
        }
        if (at < end && tokens[at].text != ",") return;  // no declaration
        names.push_back(std::move(name));
        ++at;
    }
}

std::vector<GlslName> read_parameters(const Tokens& tokens, std::size_t begin, std::size_t end) {
    std::vector<GlslName> names;
    for (std::size_t at = begin; at < end;) {
        std::size_t comma = at;
        while (comma < end && tokens[comma].text != ",") {
            comma = tokens[comma].text == "[" ? after_bracket(tokens, comma, end) : comma + 1;
        }
        const Head head = read_head(tokens, at, comma);
        if (!head.type.empty())
            read_variables(tokens, head.next, comma, head, GlslName::Kind::variable, names);
        at = comma + 1;
    }
    return names;
}

class Outliner {
public:
    explicit Outliner(const GlslText& text) : text_(text), tokens_(text.tokens()), macros_(text) {}

    GlslOutline run() {
        const auto& directives = text_.directives();
        std::size_t next = 0;
        for (const GlslText::Directive& directive : directives) {
            int braces = 0;
            for (const GlslText::Token& token : directive.rest) {
                braces += token.text == "{" ? 1 : token.text == "}" ? -1 : 0;
            }
            if (directive.word != "define" || directive.rest.empty()) continue;
            const std::string& last = directive.rest.back().text;
            if (last == ";" || last == "}") whole_.insert(directive.rest[0].text);
            if (braces != 0) found_.uncertain = true;
        }
        for (std::size_t i = 0; i < tokens_.size(); ++i) {
            for (; next < directives.size() && directives[next].before_token <= i; ++next) {
                follow(directives[next]);
            }
            read(i);
        }
        for (; next < directives.size(); ++next) follow(directives[next]);
        const auto returning = macros_.holding("return");
        for (GlslFunction& function : found_.functions) {
            function.close = std::min(function.close, tokens_.size());
            function.returns =
                std::any_of(tokens_.begin() + static_cast<std::ptrdiff_t>(function.open),
                            tokens_.begin() + static_cast<std::ptrdiff_t>(function.close),
                            [&returning](const GlslText::Token& token) {
                                return token.text == "return" || returning.contains(token.text);
                            });
        }
        if (!state_.open.empty() && !found_.uncertain) {
            const Open& first = state_.open.front();
            found_.open_bracket = tokens_[first.token].line;
            found_.open_bracket_kind = tokens_[first.token].text[0];
        }
        return std::move(found_);
    }

private:
    enum class Role { function, structure, block, plain };

    struct Open {
        std::string closer;
        std::size_t token;
        Role role;
        std::size_t index;  ///< of the function or structure

        bool operator==(const Open&) const = default;
    };

    struct State {
        std::vector<Open> open;
        std::size_t statement = 0;  ///< the index of its first token
        std::string tail_of;        ///< the structure or block that the statement follows
        std::size_t tail_index = 0;
        std::vector<std::string> tail_qualifiers;
    };

    struct Branch {
        State before;
        std::optional<std::vector<Open>> first_end;
        bool has_else = false;
    };

    /// Each branch of a condition begins with the brackets that were open before it.
    void follow(const GlslText::Directive& directive) {
        const std::string& word = directive.word;
        if (word == "if" || word == "ifdef" || word == "ifndef") {
            branches_.push_back({state_, {}, false});
        } else if (branches_.empty()) {
            return;
        } else if (word == "elif" || word == "else") {
            end_branch();
            branches_.back().has_else |= word == "else";
            const std::size_t statement = state_.statement;
            state_ = branches_.back().before;
            // The words of the branch before are no part of the statement.
            if (state_.statement != statement || directive.before_token > state_.statement)
                state_.statement = std::max(state_.statement, directive.before_token);
        } else if (word == "endif") {
            end_branch();
            if (!branches_.back().has_else && branches_.back().before.open != state_.open)
                found_.uncertain = true;
            branches_.pop_back();
        }
    }

    void end_branch() {
        auto& first = branches_.back().first_end;
        if (!first) first = state_.open;
        const auto same = [](const Open& a, const Open& b) { return a.closer == b.closer; };
        if (!std::equal(first->begin(), first->end(), state_.open.begin(), state_.open.end(), same))
            found_.uncertain = true;
    }

    void read(std::size_t i) {
        const std::string& text = tokens_[i].text;
        if (text == "(" || text == "[" || text == "{") {
            open_bracket(i);
        } else if (text == ")" || text == "]" || text == "}") {
            close_bracket(i);
        } else if (text == ";" && (state_.open.empty() || state_.open.back().closer == "}")) {
            end_statement(i);
        }
    }

    void restart(std::size_t i) {
        state_.statement = i;
        state_.tail_of.clear();
        state_.tail_qualifiers.clear();
    }

    void open_bracket(std::size_t i) {
        const std::string& text = tokens_[i].text;
        Open made{text == "(" ? ")" : text == "[" ? "]" : "}", i, Role::plain, 0};
        if (text == "{" && (state_.open.empty() || state_.open.back().closer == "}")) {
            made.role = role_at(i, made.index);
            const std::string before = i > 0 ? tokens_[i - 1].text : "";
            const bool list = before == "=" || before == "," || before == "{";
            state_.open.push_back(std::move(made));
            if (!list || state_.open.back().role != Role::plain) restart(i + 1);
            return;
        }
        state_.open.push_back(std::move(made));
    }

    /// Returns where the declaration of a global statement begins. Macros that end with
    /// a declaration, as in `LAMP(red) vec3 shade(...)`, need no semicolon behind them.
    std::size_t after_macros(std::size_t end) const {
        std::size_t at = state_.statement;
        const auto is_word = [&](std::size_t i) { return i < end && tokens_[i].is_word(); };
        while (is_word(at) && whole_.contains(tokens_[at].text)) {
            const bool call = at + 1 < end && tokens_[at + 1].text == "(";
            const std::size_t next = call ? after_bracket(tokens_, at + 1, end) : at + 1;
            if (!is_word(next) || (!call && !is_word(next + 1))) break;
            at = next;
        }
        return at;
    }

    /// Skips such macros, and notes what they declare.
    std::size_t read_macros(std::size_t end) {
        const std::size_t at = after_macros(end);
        if (at > state_.statement) {
            if (auto found = understood("", state_.statement, at, "")) add(std::move(*found));
        }
        return at;
    }

    /// What the tokens [begin, end) declare when macros are expanded, between other text. None if
    /// there is no macro, or if that depends on a condition.
    std::optional<GlslOutline> understood(const std::string& head, std::size_t begin,
                                          std::size_t end, const std::string& tail) const {
        if (!macros_.any_in(tokens_, begin, end)) return {};
        std::optional<GlslOutline> all;
        for (const Tokens& expanded : macros_.expanded(tokens_, begin, end)) {
            const GlslText text(head + joined(expanded) + tail);
            GlslOutline found = Outliner(text).run();
            if (found.uncertain || found.open_bracket) return {};
            if (all && !same(*all, found)) return {};
            all = std::move(found);
        }
        return all;
    }

    static bool same(const std::vector<GlslName>& a, const std::vector<GlslName>& b) {
        return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                          [](const GlslName& x, const GlslName& y) {
                              return x.kind == y.kind && x.name == y.name && x.type == y.type &&
                                     x.dimensions == y.dimensions && x.qualifiers == y.qualifiers;
                          });
    }

    static bool same(const GlslOutline& a, const GlslOutline& b) {
        return same(a.names, b.names) &&
               std::equal(a.structures.begin(), a.structures.end(), b.structures.begin(),
                          b.structures.end(),
                          [](const GlslStructure& x, const GlslStructure& y) {
                              return same(x.members, y.members);
                          }) &&
               std::equal(a.functions.begin(), a.functions.end(), b.functions.begin(),
                          b.functions.end(), [](const GlslFunction& x, const GlslFunction& y) {
                              return x.result_text == y.result_text &&
                                     same(x.parameters, y.parameters);
                          });
    }

    /// Adds what the macros of the statement declare, except for names that are there.
    void add(GlslOutline found, std::size_t first_name = std::string::npos) {
        const std::size_t first = std::min(first_name, found_.names.size());
        const std::vector<GlslName> there(found_.names.begin() + static_cast<std::ptrdiff_t>(first),
                                          found_.names.end());
        for (GlslName& name : found.names) {
            const bool again = std::any_of(there.begin(), there.end(), [&](const GlslName& held) {
                return held.name == name.name;
            });
            if (again) continue;
            name.token = state_.statement;
            name.line = tokens_[state_.statement].line;
            found_.names.push_back(std::move(name));
        }
        for (GlslStructure& structure : found.structures) {
            structure.end = tokens_.size();
            found_.structures.push_back(std::move(structure));
        }
    }

    /// Finds out what the braces at `i` hold, and notes its name.
    Role role_at(std::size_t i, std::size_t& index) {
        for (std::size_t k = state_.statement; k + 1 < i + 1; ++k) {
            if (tokens_[k].text != "struct") continue;
            const bool named = k + 1 < i && tokens_[k + 1].is_word();
            const std::string name = named ? tokens_[k + 1].text : "";
            index = found_.structures.size();
            found_.structures.push_back({name, {}, tokens_.size()});
            if (named && state_.open.empty()) {
                found_.names.push_back({GlslName::Kind::structure,
                                        name,
                                        name,
                                        0,
                                        {},
                                        false,
                                        true,
                                        k + 1,
                                        tokens_[k + 1].line});
            }
            return Role::structure;
        }
        if (!state_.open.empty()) return Role::plain;
        const std::size_t begin = read_macros(i);
        Head head = read_head(tokens_, begin, i);
        if (i > state_.statement && tokens_[i - 1].text == ")") {
            index = found_.functions.size();
            return read_function(head, begin, i) ? Role::function : Role::plain;
        }
        if (!head.qualifiers.empty() && !head.type.empty() && head.next == i) {
            found_.names.push_back(name_of(head, tokens_, head.next - 1, GlslName::Kind::block));
            block_qualifiers_ = head.qualifiers;
            return Role::block;
        }
        return Role::plain;
    }

    /// Reads the head of a function, from `begin` to the brace at `i`.
    bool read_function(const Head& head, std::size_t begin, std::size_t i) {
        auto expanded = understood("", begin, i, "{ }");
        if (expanded && expanded->functions.size() != 1) expanded.reset();
        const bool plain = !head.type.empty() && head.next + 1 < i &&
                           tokens_[head.next].is_word() && tokens_[head.next + 1].text == "(";
        if (!plain && !expanded) return false;
        GlslFunction function;
        if (plain) {
            const GlslName name = name_of(head, tokens_, head.next, GlslName::Kind::function);
            function = {name.name,
                        head.type,
                        head.dimensions,
                        read_parameters(tokens_, head.next + 2, i - 1),
                        name,
                        "",
                        i,
                        tokens_.size(),
                        false,
                        name.line};
            function.result_text =
                joined(Tokens(tokens_.begin() + static_cast<std::ptrdiff_t>(begin),
                              tokens_.begin() + static_cast<std::ptrdiff_t>(head.next)));
        }
        if (expanded) {
            GlslFunction& found = expanded->functions.front();
            if (plain) {
                function.parameters = std::move(found.parameters);
                function.result = std::move(found.result);
                function.result_text = std::move(found.result_text);
            } else {
                function = std::move(found);
                function.line = tokens_[begin].line;
                function.open = i;
                function.close = tokens_.size();
            }
        }
        GlslName name = function.result;
        name.name = function.name;
        name.type = function.type;
        name.dimensions = function.dimensions;
        name.initialised = true;
        name.token = plain ? head.next : begin;
        name.line = function.line;
        found_.names.push_back(std::move(name));
        found_.functions.push_back(std::move(function));
        return true;
    }

    void close_bracket(std::size_t i) {
        if (state_.open.empty() || state_.open.back().closer != tokens_[i].text) {
            found_.uncertain = true;
            return;
        }
        const Open closed = state_.open.back();
        state_.open.pop_back();
        if (closed.closer != "}") return;
        const std::string before = tokens_[closed.token == 0 ? 0 : closed.token - 1].text;
        const bool list = before == "=" || before == "," || before == "{";
        if (closed.role == Role::plain && list) return;
        restart(i + 1);
        if (closed.role == Role::function) found_.functions[closed.index].close = i;
        if (closed.role == Role::structure) {
            state_.tail_of = found_.structures[closed.index].name;
            state_.tail_index = closed.index + 1;
        }
        if (closed.role == Role::block) state_.tail_qualifiers = block_qualifiers_;
    }

    void end_statement(std::size_t i) {
        if (state_.open.empty()) {
            end_global_statement(i);
        } else if (state_.open.back().role == Role::structure) {
            read_members(i, found_.structures[state_.open.back().index].members);
        } else if (state_.open.back().role == Role::block) {
            read_members(i, found_.names);
        }
        restart(i + 1);
    }

    void read_members(std::size_t i, std::vector<GlslName>& into) {
        const Head head = read_head(tokens_, state_.statement, i);
        const std::size_t before = into.size();
        if (!head.type.empty())
            read_variables(tokens_, head.next, i, head, GlslName::Kind::member, into);
        auto expanded = understood("struct cubecam_any { ", state_.statement, i + 1, " };");
        if (!expanded || expanded->structures.size() != 1) return;
        auto& members = expanded->structures.front().members;
        if (members.size() <= into.size() - before) return;
        into.erase(into.begin() + static_cast<std::ptrdiff_t>(before), into.end());
        for (GlslName& member : members) {
            member.token = state_.statement;
            member.line = tokens_[state_.statement].line;
            into.push_back(std::move(member));
        }
    }

    void end_global_statement(std::size_t i) {
        Head head;
        if (!state_.tail_of.empty() || !state_.tail_qualifiers.empty()) {
            // `struct A { ... } a, b;` or `uniform Block { ... } name;`
            if (state_.tail_index > 0 && !state_.tail_of.empty())
                found_.structures[state_.tail_index - 1].end = i;
            head.type = state_.tail_of;
            head.qualifiers = state_.tail_qualifiers;
            head.next = state_.statement;
        } else {
            const std::size_t begin = read_macros(i);
            const std::size_t first = found_.names.size();
            head = read_head(tokens_, begin, i);
            if (!head.type.empty()) read_global(head, i);
            auto expanded = understood("", begin, i + 1, "");
            if (expanded && expanded->names.size() > found_.names.size() - first)
                add(std::move(*expanded), first);
            return;
        }
        read_global(head, i);
    }

    void read_global(const Head& head, std::size_t i) {
        if (head.next + 1 < i && tokens_[head.next].is_word() &&
            tokens_[head.next + 1].text == "(") {
            found_.names.push_back(name_of(head, tokens_, head.next, GlslName::Kind::function));
            return;
        }
        read_variables(tokens_, head.next, i, head, GlslName::Kind::variable, found_.names);
    }

    const GlslText& text_;
    const Tokens& tokens_;
    GlslMacros macros_;
    GlslOutline found_;
    State state_;
    std::vector<Branch> branches_;
    std::set<std::string, std::less<>> whole_;  ///< macros that end with a declaration
    std::vector<std::string> block_qualifiers_;
};

}  // namespace

bool GlslName::is(std::string_view qualifier) const {
    return std::find(qualifiers.begin(), qualifiers.end(), qualifier) != qualifiers.end();
}

GlslOutline outline(const GlslText& text) { return Outliner(text).run(); }

std::size_t after_bracket(const Tokens& tokens, std::size_t open, std::size_t end) {
    int depth = 0;
    for (std::size_t i = open; i < end; ++i) {
        const std::string& text = tokens[i].text;
        if (text == "(" || text == "[" || text == "{") ++depth;
        if ((text == ")" || text == "]" || text == "}") && --depth == 0) return i + 1;
    }
    return end;
}

std::string joined(const std::vector<GlslText::Token>& tokens) {
    std::string text;
    for (const GlslText::Token& token : tokens) text += (text.empty() ? "" : " ") + token.text;
    return text;
}

std::vector<GlslName> declared_variables(const std::vector<GlslText::Token>& tokens,
                                         std::size_t begin, std::size_t end) {
    std::vector<GlslName> names;
    Head head = read_head(tokens, begin, end);
    if (head.next + 2 < end && tokens[head.next].text == "struct" &&
        tokens[head.next + 2].text == "{") {
        head.type = tokens[head.next + 1].text;
        head.next = after_bracket(tokens, head.next + 2, end);
    }
    if (head.type.empty() || head.next == end || !tokens[head.next].is_word()) return names;
    read_variables(tokens, head.next, end, head, GlslName::Kind::variable, names);
    return names;
}

}  // namespace cubecam::gl
