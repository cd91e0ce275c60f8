// Drivers' logs with the lines of the users' own texts. This file does not use OpenGL.
#include "cubecam/core/error.hpp"
#include "cubecam/gl/glsl_text.hpp"
#include "cubecam/gl/program.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>
#include <utility>

namespace cubecam::gl {

namespace {

constexpr std::size_t context_lines = 2;      // shown before and after an error's line
constexpr std::size_t most_characters = 160;  // of a line that is shown
constexpr std::size_t most_places = 6;        // whose lines are shown

/// Types and other words that a log may quote beside the name that it is about.
constexpr std::array<std::string_view, 18> common_words = {
    "vec2", "vec3", "vec4",    "float",   "int", "bool", "uint",   "mat2",    "mat3",
    "mat4", "void", "uniform", "varying", "in",  "out",  "struct", "Surface", "Vertex"};

struct LogPlace {
    std::size_t line;       ///< of the expanded text
    std::string_view rest;  ///< the text after the line number
    std::string_view head;  ///< the text before the string number, such as "ERROR: "
};

std::optional<std::size_t> read_number(std::string_view& text) {
    std::size_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return value;
}

/// Mesa writes "0:12(5): error: ...", NVIDIA "0(12) : error C0000: ...", others "ERROR: 0:12: ...".
std::optional<LogPlace> find_place(std::string_view line) {
    std::string_view rest = line;
    for (const std::string_view word : {"ERROR: ", "WARNING: ", "error: ", "warning: "}) {
        if (rest.starts_with(word)) rest.remove_prefix(word.size());
    }
    const std::string_view head = line.substr(0, line.size() - rest.size());
    const auto string_number = read_number(rest);
    if (!string_number || rest.empty() || (rest[0] != ':' && rest[0] != '(')) return std::nullopt;
    const bool bracket = rest[0] == '(';
    rest.remove_prefix(1);
    const auto number = read_number(rest);
    if (!number) return std::nullopt;
    if (bracket && rest.starts_with(')')) rest.remove_prefix(1);
    return LogPlace{*number, rest, head};
}

std::vector<std::string_view> lines_of(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) {
        const std::size_t end = text.find('\n');
        std::string_view line = text.substr(0, end);
        text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
        if (line.ends_with('\r')) line.remove_suffix(1);
        lines.push_back(line);
    }
    return lines;
}

void append_excerpt(std::string& text, const ShaderSource& source, std::size_t error_line) {
    const std::vector<std::string_view> lines = lines_of(source.shown_text());
    const std::size_t first = error_line > context_lines ? error_line - context_lines : 1;
    const std::size_t last = std::min(error_line + context_lines, lines.size());
    text.append("\n").append(source.shown()).append(":\n");
    for (std::size_t number = first; number <= last; ++number) {
        std::string digits = std::to_string(number);
        digits.insert(0, digits.size() < 5 ? 5 - digits.size() : 0, ' ');
        text += (number == error_line ? ">" : " ") + digits + " | ";
        const std::string_view line = lines[number - 1];
        text.append(line.substr(0, most_characters));
        if (line.size() > most_characters) text += " ...";
        text.push_back('\n');
    }
}

/// The words in quotes: `a', 'a', "a".
std::vector<std::string> quoted_words(std::string_view line) {
    std::vector<std::string> words;
    for (std::size_t i = 0; i < line.size(); ++i) {
        const char open = line[i];
        if (open != '`' && open != '\'' && open != '"') continue;
        const std::size_t end = line.find(open == '"' ? '"' : '\'', i + 1);
        if (end == std::string_view::npos) break;
        const GlslText quoted(line.substr(i + 1, end - i - 1));
        for (const GlslText::Token& token : quoted.tokens()) {
            const bool common = std::find(common_words.begin(), common_words.end(), token.text) !=
                                common_words.end();
            if (token.is_word() && !common) words.push_back(token.text);
        }
        i = end;
    }
    return words;
}

/// Something that a log says, and where.
struct Remark {
    const ShaderSource* source = nullptr;  ///< null: nowhere
    std::size_t line = 0;
    std::string text;
    bool indirect = false;  ///< the driver gave a line of an own file
};

/// The users' texts in a stage. Includes do not depend on conditions, so that a vertex shader also
/// has the lines of the fragments' text, which a condition leaves out.
std::vector<const ShaderSource*> users_in(const ExpandedShader& shader) {
    std::vector<const ShaderSource*> found;
    const bool vertices = !shader.files.empty() && shader.files.front().name.ends_with(".vert");
    for (const ShaderSource& file : shader.files) {
        const bool of_vertices = file.name.ends_with("vertex.glsl");
        if (file.user && !file.text.empty() && of_vertices == vertices) found.push_back(&file);
    }
    return found;
}

class Explainer {
public:
    explicit Explainer(std::span<const ExpandedShader> shaders) : shaders_(shaders) {
        for (const ExpandedShader& shader : shaders) {
            const auto found = users_in(shader);
            users_.insert(users_.end(), found.begin(), found.end());
        }
    }

    /// `shader`: the one that was compiled; null: all were linked.
    std::string explain(std::string_view log, const ExpandedShader* shader) {
        const bool linking = shader == nullptr;
        for (const std::string_view line : lines_of(log)) {
            if (linking) follow_heading(line, shader);
            add(line, shader != nullptr ? shader : only_shader(), linking);
        }
        if (linking && !users_.empty() && !has_user_place()) add_any_place();
        return text();
    }

private:
    const ExpandedShader* only_shader() const {
        return shaders_.size() == 1 ? &shaders_.front() : nullptr;
    }

    /// NVIDIA writes "Fragment info" ahead of what concerns a stage, AMD "Fragment link error".
    void follow_heading(std::string_view line, const ExpandedShader*& shader) const {
        std::string lower(line);
        std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
            return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
        });
        for (const auto& [word, ending] :
             {std::pair{"fragment", ".frag"}, std::pair{"vertex", ".vert"}}) {
            if (!lower.starts_with(word) &&
                lower.find(std::string("linking ") + word) == std::string::npos)
                continue;
            for (const ExpandedShader& held : shaders_) {
                if (!held.files.empty() && held.files.front().name.ends_with(ending))
                    shader = &held;
            }
        }
    }

    void add(std::string_view line, const ExpandedShader* shader, bool linking) {
        const auto place = find_place(line);
        const bool placed = place && shader != nullptr && place->line <= shader->lines.size();
        if (placed && place->line > 0) {
            add_numbered(*place, *shader);
        } else if (linking || placed) {
            add_named(line);  // Mesa gives line 0 to what concerns a whole function
        } else {
            remarks_.push_back({nullptr, 0, std::string(line)});
        }
    }

    void add_numbered(const LogPlace& place, const ExpandedShader& shader) {
        const auto [file, number, after] = shader.lines[place.line - 1];
        const std::string head(place.head);
        if (file == ExpandedShader::ahead) {
            remarks_.push_back(
                {nullptr, 0,
                 head + "(put ahead):" + std::to_string(number) + std::string(place.rest)});
            return;
        }
        const ShaderSource& source = shader.files[file];
        if (source.user && !after) return add_remark(source, number, head, place.rest);
        // The own files compile, so that the cause is in the user's text before this line.
        for (const std::string& word : quoted_words(place.rest)) {
            for (const ShaderSource* user : users_in(shader)) {
                const auto line = line_of_word(user->text, word);
                if (line) return add_remark(*user, *line, head, place.rest, true);
            }
        }
        const std::vector<const ShaderSource*> users = users_in(shader);
        const ShaderSource* before = nullptr;
        std::size_t last = 0;
        for (std::size_t i = 0; i < place.line; ++i) {
            const ExpandedShader::Line& held = shader.lines[i];
            if (held.file == ExpandedShader::ahead) continue;
            const ShaderSource* held_file = &shader.files[held.file];
            if (std::find(users.begin(), users.end(), held_file) == users.end()) continue;
            before = held_file;
            last = held.number;
        }
        if (before == nullptr) return add_remark(source, number, head, place.rest, true);
        add_remark(*before, last, head,
                   std::string(place.rest) + " (behind the end of this source: is something not "
                                             "closed, or a semicolon missing?)",
                   true);
    }

    /// A message of a linker, which has no line: its names tell what it is about.
    void add_named(std::string_view line) {
        remarks_.push_back({nullptr, 0, std::string(line)});
        for (const std::string& word : quoted_words(line)) {
            bool found = false;
            for (const ShaderSource* user : users_) {
                const auto number = line_of_word(user->text, word);
                if (!number) continue;
                add_remark(*user, *number, "", std::string(": ") + word);
                found = true;
            }
            if (found) return;
        }
        // Limits of uniforms and of what stages hand on are given without names.
        for (const std::string_view word : {"uniform", "sampler", "varying", "input", "output"}) {
            if (line.find(word) == std::string_view::npos) continue;
            const std::string_view looked_for = word == "uniform" || word == "sampler" ? "uniform"
                                                : word == "output"                     ? "out"
                                                                                       : "in";
            for (const ShaderSource* user : users_) {
                const GlslText text(user->text);
                for (const GlslText::Token& token : text.tokens()) {
                    if (token.text != looked_for) continue;
                    add_remark(*user, token.line, "",
                               ": a declaration that may take too much room");
                    break;
                }
            }
            if (has_user_place()) return;
        }
    }

    bool has_user_place() const {
        return std::any_of(remarks_.begin(), remarks_.end(), [](const Remark& remark) {
            return remark.source != nullptr && remark.source->user;
        });
    }

    /// The function that the own main() calls, if nothing else is known.
    void add_any_place() {
        for (const ShaderSource* user : users_) {
            for (const char* word : {"shade", "effect", "vertex"}) {
                const auto line = line_of_word(user->text, word);
                if (!line) continue;
                return add_remark(*user, *line, "", std::string(": the program of this function"));
            }
        }
    }

    void add_remark(const ShaderSource& source, std::size_t line, const std::string& head,
                    std::string_view rest, bool indirect = false) {
        remarks_.push_back(
            {&source, line,
             head + std::string(source.shown()) + ":" + std::to_string(line) + std::string(rest),
             indirect});
    }

    /// What the driver says of own files follows from a mistake in a user's text, and is left out.
    std::string text() const {
        const bool direct = std::any_of(remarks_.begin(), remarks_.end(), [](const Remark& remark) {
            return remark.source != nullptr && !remark.indirect;
        });
        std::string text;
        std::vector<std::pair<const ShaderSource*, std::size_t>> places;
        std::set<std::string> written;
        for (const Remark& remark : remarks_) {
            if (direct && remark.indirect) continue;
            if (!remark.text.empty() && !written.insert(remark.text).second) continue;
            text.append(remark.text).push_back('\n');
            const std::pair place{remark.source, remark.line};
            if (remark.source == nullptr || places.size() == most_places) continue;
            if (std::find(places.begin(), places.end(), place) == places.end())
                places.push_back(place);
        }
        for (const auto& [source, line] : places) append_excerpt(text, *source, line);
        while (text.ends_with('\n')) text.pop_back();
        return text;
    }

    std::span<const ExpandedShader> shaders_;
    std::vector<const ShaderSource*> users_;
    std::vector<Remark> remarks_;
};

}  // namespace

std::string explain_shader_log(std::string_view log, const ExpandedShader& shader) {
    return Explainer({&shader, 1}).explain(log, &shader);
}

std::string explain_link_log(std::string_view log, std::span<const ExpandedShader> shaders) {
    return Explainer(shaders).explain(log, nullptr);
}

std::string shown_names(std::span<const ExpandedShader> shaders) {
    std::string users;
    std::string files;
    const auto add = [](std::string& names, std::string_view name) {
        names.append(names.empty() ? "" : " + ").append(name);
    };
    for (const ExpandedShader& shader : shaders) {
        if (shader.files.empty()) continue;
        add(files, shader.files.front().name);
        for (const ShaderSource* file : users_in(shader)) add(users, file->shown());
    }
    return users.empty() ? files : users;
}

ShaderError source_error(const ShaderSource& source, std::size_t line, const std::string& message) {
    std::string text = std::string(source.shown()) + " does not compile:\n";
    text.append(source.shown()).append(":" + std::to_string(line) + ": " + message + "\n");
    append_excerpt(text, source, line);
    while (text.ends_with('\n')) text.pop_back();
    return ShaderError(text);
}

std::optional<std::size_t> line_of_word(std::string_view text, std::string_view word) {
    const GlslText parsed(text);
    const std::vector<GlslText::Token>& tokens = parsed.tokens();
    std::optional<std::size_t> first;
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        if (tokens[i].text != word) continue;
        if (!first) first = tokens[i].line;
        const bool declared = i > 0 && (tokens[i - 1].is_word() || tokens[i - 1].text == "]") &&
                              tokens[i - 1].text != "return" && tokens[i - 1].text != "else";
        if (declared) return tokens[i].line;
    }
    if (first) return first;
    for (const GlslText::Directive& directive : parsed.directives()) {
        for (const GlslText::Token& token : directive.rest) {
            if (token.text == word) return token.line;
        }
    }
    return std::nullopt;
}

}  // namespace cubecam::gl
