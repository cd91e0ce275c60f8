#include "cubecam/render/passes/output_declarations.hpp"

#include "cubecam/gl/glsl_text.hpp"

#include <algorithm>
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

using Tokens = std::vector<gl::GlslText::Token>;

[[noreturn]] void refuse_output(const UserSource& source, std::size_t line,
                                const std::string& expected, const std::string& got) {
    throw std::invalid_argument((source.path.empty() ? "fragment" : source.path) + ":" +
                                std::to_string(line) + ": expected " + expected + ", got \"" + got +
                                '"');
}

/// The outputs that a statement declares, whose tokens are those from `begin` up to `end`.
std::vector<NamedOutput> outputs_of(const UserSource& source, const Tokens& tokens,
                                    std::size_t begin, std::size_t end) {
    std::string text;
    for (std::size_t i = begin; i < end; ++i) text += (text.empty() ? "" : " ") + tokens[i].text;
    std::size_t at = begin + 1;
    const auto is = [&](std::string_view word) { return at < end && tokens[at].text == word; };
    if (is("lowp") || is("mediump") || is("highp")) ++at;
    int channels = 0;
    for (int count = 1; count <= 4; ++count) {
        if (is(glsl_type(count, OutputType::float32))) channels = count;
    }
    std::vector<NamedOutput> outputs;
    std::vector<std::size_t> lines;
    for (++at; at < end; at += 2) {
        const bool comma = at + 1 == end || tokens[at + 1].text == ",";
        if (!comma || !tokens[at].is_word()) break;
        outputs.push_back({tokens[at].text, channels});
        lines.push_back(tokens[at].line);
    }
    const bool whole = at >= end && tokens[end - 1].text != ",";
    if (tokens[begin].text != "out" || channels == 0 || outputs.empty() || !whole) {
        refuse_output(source, tokens[begin].line,
                      "outputs declared as `out vec4 name;`, of float, vec2, vec3 or vec4", text);
    }
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        const auto same = [&](std::string_view name) { return name == outputs[i].name; };
        if (std::any_of(std::begin(taken_names), std::end(taken_names), same) ||
            std::any_of(output_table.begin(), output_table.end(),
                        [&same](const OutputRow& row) { return same(row.name); })) {
            refuse_output(source, lines[i],
                          "an output of a name that is not one of " + known_outputs(),
                          outputs[i].name);
        }
    }
    return outputs;
}

/// `source` has plain lines.
std::vector<Declaration> find_declarations(const UserSource& source) {
    if (!mentions(source.text, "out")) return {};
    const gl::GlslText text(source.text);
    const Tokens& tokens = text.tokens();
    std::vector<Declaration> declarations;
    int braces = 0;
    int brackets = 0;
    bool named = false;  // the statement contains `out`, outside a parameter list
    std::size_t begin = 0;
    const auto restart = [&](std::size_t i) {
        named = false;
        begin = i + 1;
    };
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const std::string& word = tokens[i].text;
        if (word == "(") ++brackets;
        if (word == ")") --brackets;
        if (word == "}" && --braces == 0) restart(i);
        if (braces == 0 && brackets == 0 && word == "out") named = true;
        if (braces == 0 && ((word == "{" && named) || word == ";")) {
            if (named) {
                declarations.push_back(
                    {tokens[begin].begin, tokens[i].end, outputs_of(source, tokens, begin, i)});
            }
            restart(i);
        }
        if (word == "{") ++braces;
    }
    return declarations;
}

UserSource plain(const UserSource& source) {
    return {gl::with_plain_lines(source.text), source.path};
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
    for (const Declaration& declaration : find_declarations(plain(fragment))) {
        outputs.insert(outputs.end(), declaration.outputs.begin(), declaration.outputs.end());
    }
    return outputs;
}

UserSource place_outputs(const UserSource& source, const Outputs& outputs) {
    const UserSource fragment = plain(source);
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
