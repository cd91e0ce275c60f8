#pragma once

#include "cubecam/materials/texture_source.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cubecam {

/// GLSL that a user wrote. `path` is the file that it was read from, or empty; messages name it.
struct UserSource {
    std::string text;
    std::string path;

    bool operator==(const UserSource&) const = default;
};

/// The numbers of one uniform in C order: the rows of a matrix follow each other.
struct UniformValue {
    std::vector<double> numbers;
    std::vector<int> shape;  ///< empty: one number

    bool operator==(const UniformValue&) const = default;
};

/// A texture that a user's shader looks up, by a sampler2D or a samplerCube.
using TextureSource = std::variant<MapSource, CubeSource>;

/// The values that a user's shader gets by name. Only a driver knows which names the shader
/// declares, and their types: they are checked when the shader is used for drawing.
struct ShaderInputs {
    std::map<std::string, UniformValue> uniforms;
    std::map<std::string, TextureSource> textures;

    bool operator==(const ShaderInputs&) const = default;
};

/// Throws std::invalid_argument for a name that GLSL cannot have, or one that is both a uniform and
/// a texture.
void check(const ShaderInputs& inputs);

/// Whether GLSL text contains `word` as a whole word, also in a comment.
bool mentions(std::string_view text, std::string_view word);

/// Whether GLSL text may read gl_PrimitiveID: it has that word, or what could put it together.
bool may_count_triangles(std::string_view text);

}  // namespace cubecam
