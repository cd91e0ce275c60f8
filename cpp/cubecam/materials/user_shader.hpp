#pragma once

#include "cubecam/materials/texture_source.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cubecam {

/// GLSL that a user wrote. `path` is the file it was read from, empty if there is none; messages
/// name it.
struct UserSource {
    std::string text;
    std::string path;

    bool operator==(const UserSource&) const = default;
};

/// The numbers of one uniform in C order: a matrix's rows follow each other.
struct UniformValue {
    std::vector<double> numbers;
    std::vector<int> shape;  ///< empty: one number

    bool operator==(const UniformValue&) const = default;
};

/// What a user's shader looks up: by a sampler2D or a samplerCube.
using TextureSource = std::variant<MapSource, CubeSource>;

/// What a user's shader gets by name. Which of them it declares, and as what, only a driver knows:
/// that is checked when it is drawn.
struct ShaderInputs {
    std::map<std::string, UniformValue> uniforms;
    std::map<std::string, TextureSource> textures;

    bool operator==(const ShaderInputs&) const = default;
};

/// Throws std::invalid_argument for a name that GLSL cannot have, or one that is both a uniform and
/// a texture.
void check(const ShaderInputs& inputs);

/// Whether `word` stands in GLSL text as a word of its own, in a comment too.
bool mentions(std::string_view text, std::string_view word);

}  // namespace cubecam
