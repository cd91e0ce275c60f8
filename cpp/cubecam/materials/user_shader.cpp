#include "cubecam/materials/user_shader.hpp"

#include "cubecam/core/checks.hpp"

#include <algorithm>
#include <cctype>

namespace cubecam {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

/// Refuses a name that GLSL cannot have. Valid names are "color" and, for members and elements,
/// "lamps[2].color".
void check_name(const std::string& name, const char* what) {
    const bool right = !name.empty() && std::isdigit(static_cast<unsigned char>(name[0])) == 0 &&
                       is_word(name[0]) && std::all_of(name.begin(), name.end(), [](char c) {
                           return is_word(c) || c == '.' || c == '[' || c == ']';
                       });
    expect(right && !name.starts_with("gl_"), std::string(what) + " named as GLSL names them",
           "'" + name + "'");
}

}  // namespace

void check(const ShaderInputs& inputs) {
    for (const auto& [name, value] : inputs.uniforms) {
        check_name(name, "uniforms");
        expect(!inputs.textures.contains(name), "a uniform or a texture of a name",
               "both a uniform and a texture '" + name + "'");
    }
    for (const auto& [name, source] : inputs.textures) check_name(name, "textures");
}

bool mentions(std::string_view text, std::string_view word) {
    for (std::size_t at = text.find(word); at != std::string_view::npos;
         at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if (at > 0 && is_word(text[at - 1])) continue;
        if (end < text.size() && is_word(text[end])) continue;
        return true;
    }
    return false;
}

bool may_count_triangles(std::string_view text) {
    for (const char* part : {"gl_PrimitiveID", "##", "\\\n", "\\\r"}) {
        if (text.find(part) != std::string_view::npos) return true;
    }
    return false;
}

}  // namespace cubecam
