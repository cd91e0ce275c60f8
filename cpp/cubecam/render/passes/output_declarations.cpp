#include "cubecam/render/passes/output_declarations.hpp"

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string_view>

namespace cubecam {
namespace {

constexpr std::string_view taken_names[] = {"color"};

/// A declaration at the outermost level of a source, from its first token to its semicolon.
struct Declaration {
    std::size_t begin;
    std::size_t end;
    std::vector<NamedOutput> outputs;
};

bool is_letter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Overwrites comments and preprocessor lines by spaces, so that positions in the text stay the
/// same.
std::string without_comments(std::string text) {
    const auto erase = [&text](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < std::min(end, text.size()); ++i) {
            if (text[i] != '\n') text[i] = ' ';
        }
    };
    bool line_start = true;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text.compare(i, 2, "//") == 0) {
            erase(i, text.find('\n', i));
        } else if (text.compare(i, 2, "/*") == 0) {
            const std::size_t end = text.find("*/", i + 2);
            erase(i, end == std::string::npos ? end : end + 2);
        } else if (text[i] == '#' && line_start) {
            std::size_t end = text.find('\n', i);
            while (end != std::string::npos && text[end - 1] == '\\')
                end = text.find('\n', end + 1);
            erase(i, end);
        }
        line_start = text[i] == '\n' || (line_start && text[i] == ' ');
    }
    return text;
}

std::vector<std::string> tokens_of(std::string_view text) {
    std::vector<std::string> tokens;
    for (std::size_t i = 0; i < text.size();) {
        std::size_t end = i + 1;
        if (is_letter(text[i])) {
            while (end < text.size() && is_letter(text[end])) ++end;
        }
        if (std::isspace(static_cast<unsigned char>(text[i])) == 0) {
            tokens.emplace_back(text.substr(i, end - i));
        }
        i = end;
    }
    return tokens;
}

[[noreturn]] void refuse_output(const UserSource& source, const std::string& expected,
                                const std::string& got) {
    throw std::invalid_argument((source.path.empty() ? "fragment" : source.path) + ": expected " +
                                expected + ", got \"" + got + '"');
}

std::vector<NamedOutput> outputs_of(const UserSource& source,
                                    const std::vector<std::string>& tokens) {
    std::string text;
    for (const std::string& token : tokens) text += (text.empty() ? "" : " ") + token;
    std::size_t at = 1;
    const auto is = [&](std::string_view word) { return at < tokens.size() && tokens[at] == word; };
    if (is("lowp") || is("mediump") || is("highp")) ++at;
    int channels = 0;
    for (int count = 1; count <= 4; ++count) {
        if (is(glsl_type(count, OutputType::float32))) channels = count;
    }
    std::vector<NamedOutput> outputs;
    for (++at; at < tokens.size(); at += 2) {
        const bool comma = at + 1 == tokens.size() || tokens[at + 1] == ",";
        if (!comma || !is_letter(tokens[at].front())) break;
        outputs.push_back({tokens[at], channels});
    }
    const bool whole = at >= tokens.size() && tokens.back() != ",";
    if (tokens.front() != "out" || channels == 0 || outputs.empty() || !whole) {
        refuse_output(source, "outputs declared as `out vec4 name;`, of float, vec2, vec3 or vec4",
                      text);
    }
    for (const NamedOutput& output : outputs) {
        const auto same = [&output](std::string_view name) { return name == output.name; };
        if (std::any_of(std::begin(taken_names), std::end(taken_names), same) ||
            std::any_of(output_table.begin(), output_table.end(),
                        [&same](const OutputRow& row) { return same(row.name); })) {
            refuse_output(source, "an output of a name that is not one of " + known_outputs(),
                          output.name);
        }
    }
    return outputs;
}

std::vector<Declaration> find_declarations(const UserSource& source) {
    if (!mentions(source.text, "out")) return {};
    const std::string text = without_comments(source.text);
    std::vector<Declaration> declarations;
    int braces = 0;
    int brackets = 0;
    bool named = false;  // the statement contains `out`, outside a parameter list
    std::size_t begin = 0;
    const auto restart = [&](std::size_t i) {
        named = false;
        begin = i + 1;
    };
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (c == '(') ++brackets;
        if (c == ')') --brackets;
        if (c == '}' && --braces == 0) restart(i);
        if (braces == 0 && brackets == 0 && (i == 0 || !is_letter(text[i - 1])) &&
            text.compare(i, 3, "out") == 0 && (i + 3 == text.size() || !is_letter(text[i + 3]))) {
            named = true;
        }
        if (braces == 0 && ((c == '{' && named) || c == ';')) {
            while (begin < i && std::isspace(static_cast<unsigned char>(text[begin])) != 0) ++begin;
            if (named) {
                const auto tokens = tokens_of(std::string_view(text).substr(begin, i - begin));
                declarations.push_back({begin, i + 1, outputs_of(source, tokens)});
            }
            restart(i);
        }
        if (c == '{') ++braces;
    }
    return declarations;
}

std::string declaration_text(std::size_t slot, std::string_view type, std::string_view name) {
    const std::string variable = std::string(type) + " " + std::string(name) + ";";
    if (slot == 0) return variable;
    return "layout(location = " + std::to_string(slot) + ") out " + variable;
}

/// Returns the slot of an output, or 0 if it is not among `outputs`.
std::size_t slot_of(const std::vector<ShadedOutput>& outputs, std::string_view name) {
    for (const ShadedOutput& output : outputs) {
        if (output.name == name) return output.slot;
    }
    return 0;
}

}  // namespace

std::vector<NamedOutput> declared_outputs(const UserSource& fragment) {
    std::vector<NamedOutput> outputs;
    for (const Declaration& declaration : find_declarations(fragment)) {
        outputs.insert(outputs.end(), declaration.outputs.begin(), declaration.outputs.end());
    }
    return outputs;
}

UserSource place_outputs(const UserSource& fragment, const Outputs& outputs) {
    const std::vector<ShadedOutput> written = outputs.by_slot();
    UserSource placed{"", fragment.path};
    std::size_t done = 0;
    for (const Declaration& declaration : find_declarations(fragment)) {
        placed.text.append(fragment.text, done, declaration.begin - done);
        for (const NamedOutput& output : declaration.outputs) {
            placed.text +=
                declaration_text(slot_of(written, output.name),
                                 glsl_type(output.channels, OutputType::float32), output.name);
        }
        const auto first = fragment.text.begin() + static_cast<std::ptrdiff_t>(declaration.begin);
        const auto last = fragment.text.begin() + static_cast<std::ptrdiff_t>(declaration.end);
        placed.text.append(static_cast<std::size_t>(std::count(first, last, '\n')), '\n');
        done = declaration.end;
    }
    placed.text.append(fragment.text, done);
    return placed;
}

std::vector<std::pair<std::string, std::string>>
output_defines(const Outputs& outputs, const std::vector<NamedOutput>& declared) {
    const std::vector<ShadedOutput> written = outputs.by_slot();
    std::string declarations;
    std::string zeros;
    for (const OutputRow& row : output_table) {
        if (row.source != OutputSource::shader) continue;
        declarations +=
            declaration_text(slot_of(written, row.name), glsl_type(row.channels, row.type),
                             "o_" + std::string(row.name));
    }
    const auto set_zero = [&zeros](const std::string& name, int channels) {
        zeros += name + " = " + std::string(glsl_type(channels, OutputType::float32)) + "(0.0);";
    };
    for (const NamedOutput& output : declared) set_zero(output.name, output.channels);
    for (const NamedOutput& output : outputs.named()) {
        if (std::find(declared.begin(), declared.end(), output) != declared.end()) continue;
        const std::size_t slot = slot_of(written, output.name);
        const std::string name = "o_other_" + std::to_string(slot);
        declarations +=
            declaration_text(slot, glsl_type(output.channels, OutputType::float32), name);
        set_zero(name, output.channels);
    }
    std::vector<std::pair<std::string, std::string>> defines;
    if (!written.empty()) {
        defines.emplace_back("OUTPUTS", "1");
        defines.emplace_back("OUTPUT_DECLARATIONS", declarations);
    }
    if (!zeros.empty()) defines.emplace_back("OUTPUT_ZEROS", zeros);
    return defines;
}

}  // namespace cubecam
