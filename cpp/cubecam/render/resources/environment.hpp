#pragma once

#include "cubecam/render/resources/bound_texture.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace cubecam {

/// How the levels of an environment's cube were made, except the finest one.
enum class EnvironmentLevels : std::uint8_t { none, mipmaps };

/// The environment that a surface reflects.
struct Environment {
    BoundTexture cube;  ///< texture 0: none, black
    EnvironmentLevels levels = EnvironmentLevels::none;
    int level_count = 1;                 ///< including the finest one
    std::optional<glm::dvec3> position;  ///< of the capture, world; none: infinitely far away

    /// Adds all values on which a picture depends.
    void add_to(std::vector<std::uint64_t>& key) const;
};

/// All textures that a node looks up.
struct NodeTextures {
    Environment environment;
    std::vector<BoundTexture> textures;  ///< in the order of the material's fields
};

/// The uniform block `Environment` of shaders/include/environment.glsl, std140.
struct EnvironmentBlock {
    glm::vec4 position{0.0F};  ///< xyz: position of the capture, w: 1; all 0: infinitely far
    glm::ivec4 levels{0};      ///< x: how many levels
};

/// `origin` is the origin of the shaders' positions.
EnvironmentBlock make_environment_block(const Environment& environment, const glm::dvec3& origin);

}  // namespace cubecam
