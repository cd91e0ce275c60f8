// The text of programs: includes, options and readable logs. This file does not use OpenGL.
#include "cubecam/core/error.hpp"
#include "cubecam/gl/program.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <set>

namespace cubecam::gl {

namespace {

constexpr std::size_t context_lines = 2;  // shown before and after an error's line

const ShaderSource* find_source(std::span<const ShaderSource> sources, std::string_view name) {
    const auto found =
        std::find_if(sources.begin(), sources.end(),
                     [&](const ShaderSource& source) { return source.name == name; });
    return found != sources.end() ? &*found : nullptr;
}

std::string_view skip_spaces(std::string_view text) {
    const std::size_t start = text.find_first_not_of(" \t");
    return start == std::string_view::npos ? std::string_view{} : text.substr(start);
}

/// Returns what follows the directive `#word` if a line is one.
std::optional<std::string_view> directive(std::string_view line, std::string_view word) {
    line = skip_spaces(line);
    if (!line.starts_with('#')) return std::nullopt;
    line = skip_spaces(line.substr(1));
    if (!line.starts_with(word)) return std::nullopt;
    line.remove_prefix(word.size());
    if (!line.empty() && (std::isalnum(static_cast<unsigned char>(line[0])) != 0 || line[0] == '_'))
        return std::nullopt;
    return skip_spaces(line);
}

/// Removes the next line from `text` and returns it without its end.
std::string_view take_line(std::string_view& text) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    return line;
}

class Expander {
public:
    explicit Expander(std::span<const ShaderSource> sources) : sources_(sources) {}

    /// A line that belongs to no file.
    void add_ahead(const std::string& line) {
        result.text += line + "\n";
        result.lines.push_back({ExpandedShader::ahead, result.lines.size() + 1});
    }

    void add(const ShaderSource& source) {
        const std::size_t file = result.files.size();
        result.files.push_back(source);
        std::string_view rest = source.text;
        for (std::size_t line_number = 1; !rest.empty(); ++line_number) {
            const std::string_view line = take_line(rest);
            const std::string place =
                std::string(source.shown()) + ":" + std::to_string(line_number);
            if (directive(line, "version")) {
                throw ShaderError(place +
                                  ": a #version line; the version is put ahead of every shader");
            }
            if (const auto include = directive(line, "include")) {
                add_include(*include, place);
            } else {
                result.text.append(line).push_back('\n');
                result.lines.push_back({file, line_number});
            }
        }
    }

    ExpandedShader result;

private:
    void add_include(std::string_view rest, const std::string& place) {
        const std::size_t end = rest.find('"', 1);
        if (!rest.starts_with('"') || end == std::string_view::npos) {
            throw ShaderError(place + ": expected #include \"file.glsl\", got #include " +
                              std::string(rest));
        }
        const std::string_view name = rest.substr(1, end - 1);
        const ShaderSource* source = find_source(sources_, name);
        if (source == nullptr)
            throw ShaderError(place + ": there is no shader file \"" + std::string(name) + "\"");
        if (find_source(result.files, name) == nullptr) add(*source);
    }

    std::span<const ShaderSource> sources_;
};

struct LogPlace {
    std::size_t line;       ///< of the expanded text
    std::string_view rest;  ///< the text after the line number
    std::string_view head;  ///< the text before the string number, such as "ERROR: "
};

std::optional<std::size_t> take_number(std::string_view& text) {
    std::size_t value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc()) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
    return value;
}

/// Mesa writes "0:12(5): error: ...", NVIDIA "0(12) : error C0000: ...", others "ERROR: 0:12: ...".
std::optional<LogPlace> find_place(std::string_view line) {
    std::string_view rest = line;
    for (const std::string_view word : {"ERROR: ", "WARNING: "}) {
        if (rest.starts_with(word)) rest.remove_prefix(word.size());
    }
    const std::string_view head = line.substr(0, line.size() - rest.size());
    const auto string_number = take_number(rest);
    if (!string_number || rest.empty() || (rest[0] != ':' && rest[0] != '(')) return std::nullopt;
    const bool bracket = rest[0] == '(';
    rest.remove_prefix(1);
    const auto number = take_number(rest);
    if (!number) return std::nullopt;
    if (bracket && rest.starts_with(')')) rest.remove_prefix(1);
    return LogPlace{*number, rest, head};
}

std::vector<std::string_view> split_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) lines.push_back(take_line(text));
    return lines;
}

void append_excerpt(std::string& text, const ShaderSource& source, std::size_t error_line) {
    const std::vector<std::string_view> lines = split_lines(source.text);
    const std::size_t first = error_line > context_lines ? error_line - context_lines : 1;
    const std::size_t last = std::min(error_line + context_lines, lines.size());
    text.append("\n").append(source.shown()).append(":\n");
    for (std::size_t number = first; number <= last; ++number) {
        std::string digits = std::to_string(number);
        digits.insert(0, digits.size() < 5 ? 5 - digits.size() : 0, ' ');
        text += (number == error_line ? ">" : " ") + digits + " | ";
        text.append(lines[number - 1]).push_back('\n');
    }
}

}  // namespace

ExpandedShader expand_shader(std::string_view name, const ShaderOptions& options,
                             std::span<const ShaderSource> sources) {
    const ShaderSource* source = find_source(sources, name);
    if (source == nullptr)
        throw ShaderError("there is no shader file \"" + std::string(name) + "\"");

    Expander expander(sources);
    expander.add_ahead("#version 450 core");
    for (const std::string& extension : options.extensions)
        expander.add_ahead("#extension " + extension + " : require");
    for (const auto& [macro, value] : options.defines)
        expander.add_ahead("#define " + macro + " " + value);
    expander.add(*source);
    return std::move(expander.result);
}

std::string explain_shader_log(std::string_view log, const ExpandedShader& shader) {
    std::string text;
    std::set<std::pair<std::size_t, std::size_t>> places;
    for (const std::string_view line : split_lines(log)) {
        const auto place = find_place(line);
        if (!place || place->line == 0 || place->line > shader.lines.size()) {
            text.append(line).push_back('\n');
            continue;
        }
        const auto [file, number] = shader.lines[place->line - 1];
        const bool ahead = file == ExpandedShader::ahead;
        text.append(place->head).append(ahead ? "(put ahead)" : shader.files[file].shown());
        text.append(":").append(std::to_string(number)).append(place->rest).push_back('\n');
        if (!ahead) places.emplace(file, number);
    }
    for (const auto& [file, number] : places) append_excerpt(text, shader.files[file], number);
    while (text.ends_with('\n')) text.pop_back();
    return text;
}

}  // namespace cubecam::gl
