// The text of programs: includes and options. This file does not use OpenGL.
#include "cubecam/core/error.hpp"
#include "cubecam/gl/glsl_text.hpp"
#include "cubecam/gl/program.hpp"

#include <algorithm>
#include <cctype>
#include <optional>
#include <set>

namespace cubecam::gl {

namespace {

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

std::vector<std::string_view> split_lines(std::string_view text) {
    std::vector<std::string_view> lines;
    while (!text.empty()) lines.push_back(take_line(text));
    return lines;
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
        if (source.user) return add_user_text(source);
        const std::size_t file = result.files.size();
        result.files.push_back(source);
        std::string_view rest = source.text;
        for (std::size_t line_number = 1; !rest.empty(); ++line_number) {
            const std::string_view line = take_line(rest);
            const std::string place =
                std::string(source.shown()) + ":" + std::to_string(line_number);
            if (directive(line, "version")) refuse_version(place);
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
    [[noreturn]] static void refuse_version(const std::string& place) {
        throw ShaderError(place + ": a #version line; the version is put ahead of every shader");
    }

    /// A user's text may contain directives within comments and on continued lines, and has no
    /// includes. Its #line would hide where a message belongs, so the directive is left out.
    void add_user_text(const ShaderSource& source) {
        const std::size_t file = result.files.size();
        result.files.push_back(source);
        const GlslText text(source.text);
        std::set<std::size_t> left_out;
        for (const GlslText::Directive& found : text.directives()) {
            if (found.word == "version") {
                throw source_error(source, found.line,
                                   "a #version line; the version is put ahead of every shader");
            }
            if (found.word != "line") continue;
            for (std::size_t line = found.line; line <= found.last_line; ++line)
                left_out.insert(line);
        }
        std::size_t number = 0;
        for (const std::string_view line : split_lines(source.text)) {
            ++number;
            if (!left_out.contains(number)) result.text.append(line);
            result.text.push_back('\n');
            result.lines.push_back({file, number});
        }
        const auto add_after = [&](std::string_view line) {
            result.text.append(line).push_back('\n');
            result.lines.push_back({file, text.last_line(), true});
        };
        add_after("");  // the last line may end in a backslash
        for (const std::string_view line : split_lines(source.after)) add_after(line);
    }

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

}  // namespace cubecam::gl
