// The macros of a GLSL source (GLSL 4.50, section 3.3). This file does not use OpenGL.
#include "cubecam/gl/glsl_macros.hpp"

#include <algorithm>
#include <utility>

namespace cubecam::gl {
namespace {

constexpr std::size_t most_tokens_in_all = 400'000;
constexpr std::size_t most_tokens_of_one = 20'000;
constexpr std::size_t most_tokens_of_a_source = 100'000;
constexpr std::size_t most_definitions = 4;
constexpr std::size_t most_hidden = 40;  ///< macros inside each other

bool same_texts(const GlslMacros::Tokens& a, const GlslMacros::Tokens& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const auto& x, const auto& y) { return x.text == y.text; });
}

/// The index after the parenthesis that closes the one at `open`; `end` if nothing closes it.
std::size_t after_parenthesis(const GlslMacros::Tokens& tokens, std::size_t open, std::size_t end) {
    int depth = 0;
    for (std::size_t i = open; i < end; ++i) {
        if (tokens[i].text == "(") ++depth;
        if (tokens[i].text == ")" && --depth == 0) return i + 1;
    }
    return end;
}

}  // namespace

GlslMacros::GlslMacros(const GlslText& text) : left_(most_tokens_in_all) {
    if (text.tokens().size() > most_tokens_of_a_source) return;
    for (const GlslText::Directive& directive : text.directives()) {
        if (directive.word != "define" || directive.rest.empty()) continue;
        auto& all = macros_[directive.rest[0].text];
        auto definition = read(directive);
        if (definition && all.size() < most_definitions) all.push_back(std::move(*definition));
    }
    std::erase_if(macros_, [](const auto& macro) { return macro.second.empty(); });
}

std::optional<GlslMacros::Definition> GlslMacros::read(const GlslText::Directive& directive) {
    const Tokens& rest = directive.rest;
    Definition made;
    std::size_t body = 1;
    if (rest.size() > 1 && rest[1].text == "(" && rest[1].begin == rest[0].end) {
        made.call = true;
        for (body = 2; body < rest.size() && rest[body].text != ")"; ++body) {
            if (rest[body].is_word()) made.parameters.push_back(rest[body].text);
        }
        if (body == rest.size()) return {};
        ++body;
    }
    made.body.assign(rest.begin() + static_cast<std::ptrdiff_t>(body), rest.end());
    return made;
}

bool GlslMacros::any_in(const Tokens& tokens, std::size_t begin, std::size_t end) const {
    if (macros_.empty()) return false;
    for (std::size_t i = begin; i < end; ++i) {
        if (has(tokens[i].text)) return true;
    }
    return false;
}

std::size_t GlslMacros::after_use(const Tokens& tokens, std::size_t at, std::size_t end) const {
    if (at >= end) return at;
    const auto found = macros_.find(tokens[at].text);
    if (found == macros_.end()) return at;
    if (!found->second.front().call) return at + 1;
    if (at + 1 >= end || tokens[at + 1].text != "(") return at;
    return after_parenthesis(tokens, at + 1, end);
}

const GlslMacros::Definition& GlslMacros::choose(std::string_view name, std::size_t choice) const {
    const auto& all = macros_.find(name)->second;
    return all[std::min(choice, all.size() - 1)];
}

bool GlslMacros::expand_use(const Tokens& tokens, std::size_t at, std::size_t end,
                            std::size_t choice, const Hidden& hidden, Tokens& into) const {
    const std::string& name = tokens[at].text;
    const Definition& macro = choose(name, choice);
    std::vector<Tokens> arguments;
    if (macro.call) {
        const std::size_t close = after_parenthesis(tokens, at + 1, end) - 1;
        if (left_ < close - at) return false;
        left_ -= close - at;
        arguments.emplace_back();
        int depth = 0;
        for (std::size_t i = at + 2; i < close; ++i) {
            const std::string& text = tokens[i].text;
            depth += text == "(" ? 1 : text == ")" ? -1 : 0;
            if (text == "," && depth == 0) {
                arguments.emplace_back();
            } else {
                arguments.back().push_back(tokens[i]);
            }
        }
    }
    const auto argument_of = [&](const std::string& word) -> const Tokens* {
        const auto place = std::find(macro.parameters.begin(), macro.parameters.end(), word);
        const auto i = static_cast<std::size_t>(place - macro.parameters.begin());
        return i < std::min(macro.parameters.size(), arguments.size()) ? &arguments[i] : nullptr;
    };
    Tokens replaced;
    const Tokens& body = macro.body;
    const auto pastes = [&body](std::size_t i) {
        return i + 1 < body.size() && body[i].text == "#" && body[i + 1].text == "#";
    };
    bool paste = false;
    for (std::size_t i = 0; i < body.size(); ++i) {
        if (pastes(i)) {
            paste = !replaced.empty();
            ++i;
            continue;
        }
        Tokens next;
        const Tokens* argument = argument_of(body[i].text);
        if (argument == nullptr) {
            next.push_back(body[i]);
        } else if (paste || pastes(i + 1)) {
            next = *argument;
        } else if (!expand(*argument, 0, argument->size(), choice, hidden, next)) {
            return false;
        }
        if (paste && !next.empty()) {
            replaced.back().text += next.front().text;
            next.erase(next.begin());
        }
        paste = false;
        replaced.insert(replaced.end(), next.begin(), next.end());
        if (replaced.size() > most_tokens_of_one) return false;
    }
    for (GlslText::Token& token : replaced) {
        token.begin = tokens[at].begin;
        token.end = tokens[at].end;
        token.line = tokens[at].line;
    }
    Hidden deeper = hidden;
    deeper.insert(name);
    return expand(replaced, 0, replaced.size(), choice, deeper, into);
}

bool GlslMacros::expand(const Tokens& tokens, std::size_t begin, std::size_t end,
                        std::size_t choice, const Hidden& hidden, Tokens& into) const {
    if (hidden.size() > most_hidden) return false;
    for (std::size_t i = begin; i < end;) {
        const bool known =
            tokens[i].is_word() && has(tokens[i].text) && !hidden.contains(tokens[i].text);
        if (known) {
            const bool call = choose(tokens[i].text, choice).call;
            if (!call || (i + 1 < end && tokens[i + 1].text == "(")) {
                if (!expand_use(tokens, i, end, choice, hidden, into)) return false;
                i = call ? after_parenthesis(tokens, i + 1, end) : i + 1;
                continue;
            }
        }
        if (left_ == 0 || into.size() >= most_tokens_of_one) return false;
        --left_;
        into.push_back(tokens[i++]);
    }
    return true;
}

std::vector<GlslMacros::Tokens> GlslMacros::expanded(const Tokens& tokens, std::size_t begin,
                                                     std::size_t end) const {
    std::size_t choices = 1;
    for (const auto& [name, all] : macros_) choices = std::max(choices, all.size());
    std::vector<Tokens> results;
    for (std::size_t choice = 0; choice < choices; ++choice) {
        Tokens made;
        if (!expand(tokens, begin, end, choice, {}, made)) return {};
        const bool there = std::any_of(results.begin(), results.end(),
                                       [&](const Tokens& held) { return same_texts(held, made); });
        if (!there) results.push_back(std::move(made));
    }
    return results;
}

std::set<std::string, std::less<>> GlslMacros::holding(std::string_view word) const {
    std::set<std::string, std::less<>> found;
    const auto holds = [&](const GlslText::Token& token) {
        return token.text == word || found.contains(token.text);
    };
    for (bool more = true; more;) {
        more = false;
        for (const auto& [name, all] : macros_) {
            const bool any = std::any_of(all.begin(), all.end(), [&](const Definition& made) {
                return std::any_of(made.body.begin(), made.body.end(), holds);
            });
            more = (any && found.insert(name).second) || more;
        }
    }
    return found;
}

}  // namespace cubecam::gl
