#include "cubecam/render/passes/environment_text.hpp"

#include "cubecam/gl/embedded.hpp"
#include "cubecam/gl/glsl_outline.hpp"
#include "cubecam/render/resources/node_record.hpp"

#include <cctype>
#include <map>
#include <stdexcept>

namespace cubecam {
namespace {

std::string text_of_file(std::string_view name) {
    for (const gl::ShaderSource& source : gl::embedded_shaders()) {
        if (source.name == name) return std::string(source.text);
    }
    throw std::logic_error("there is no shader file " + std::string(name));
}

/// The GLSL of one environment in one text.
const std::string& text_of_one() {
    static const std::string text = [] {
        constexpr std::string_view include = "#include \"include/parallax.glsl\"";
        std::string whole = text_of_file(environment_include);
        const std::size_t at = whole.find(include);
        if (at == std::string::npos) throw std::logic_error("environment.glsl has no parallax");
        return whole.replace(at, include.size(), text_of_file("include/parallax.glsl"));
    }();
    return text;
}

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

void replace_all(std::string& text, std::string_view old, std::string_view by) {
    for (std::size_t at = text.find(old); at != std::string::npos;
         at = text.find(old, at + by.size())) {
        text.replace(at, old.size(), by);
    }
}

/// The text with a suffix behind each of the names, and behind each word ENVIRONMENT_...
std::string renamed(std::string_view text, const std::string& suffix) {
    const auto& names = environment_names();
    std::string made;
    for (std::size_t at = 0; at < text.size();) {
        if (!in_word(text[at])) {
            made.push_back(text[at++]);
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && in_word(text[end])) ++end;
        const std::string_view word = text.substr(at, end - at);
        made.append(word);
        if (names.contains(word) || word.starts_with("ENVIRONMENT_")) made.append(suffix);
        at = end;
    }
    return made;
}

std::string binding(unsigned number) { return "binding = " + std::to_string(number) + ")"; }

}  // namespace

const std::set<std::string, std::less<>>& environment_names() {
    static const std::set<std::string, std::less<>> names = [] {
        std::set<std::string, std::less<>> found;
        const gl::GlslText text(text_of_one());
        for (const gl::GlslText::Directive& directive : text.directives()) {
            if (directive.word == "define" && !directive.rest.empty()) {
                found.insert(std::string(directive.rest[0].text));
            }
        }
        for (const gl::GlslName& name : gl::outline(text).names) found.insert(name.name);
        return found;
    }();
    return names;
}

std::string blended_environment_text(std::span<const EnvironmentUnits> units) {
    std::string text;
    for (std::size_t i = 0; i < units.size(); ++i) {
        std::string one = renamed(text_of_one(), "_" + std::to_string(i));
        if (i > 0) {
            // Numbers of one digit; the new ones have two.
            const EnvironmentUnits& own = units[i];
            const auto block = static_cast<unsigned>(further_environment_binding + i - 1);
            replace_all(one, "(std140, " + binding(environment_binding),
                        "(std140, " + binding(block));
            const std::map<unsigned, unsigned> moved{{texture_unit::cube, own.cube},
                                                     {texture_unit::filtered, own.filtered},
                                                     {texture_unit::box_mipmaps, own.box_mipmaps},
                                                     {texture_unit::distances, own.distances},
                                                     {texture_unit::farthest, own.farthest}};
            for (const auto& [old, now] : moved) {
                replace_all(one, "(" + binding(old) + " uniform", "(" + binding(now) + " uniform");
            }
        }
        text += one + "\n";
    }
    return text + "#include \"include/environment_blend.glsl\"\n";
}

}  // namespace cubecam
