#pragma once

#include "cubecam/render/resources/bound_texture.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <vector>

namespace cubecam {

/// How the levels of an environment's cube were made, beside the finest one.
enum class EnvironmentLevels : std::uint8_t { none, mipmaps };

/// What a surface reflects.
struct Environment {
    BoundTexture cube;  ///< texture 0: none, black
    EnvironmentLevels levels = EnvironmentLevels::none;
    int level_count = 1;  ///< the finest one included
    std::optional<glm::dvec3>
        position;  ///< where it was captured, world; none: infinitely far away

    /// Adds all that a picture depends on.
    void add_to(std::vector<std::uint64_t>& key) const;
};

/// All that a node looks up.
struct NodeTextures {
    Environment environment;
    std::vector<BoundTexture> textures;  ///< of the material, in the order of its fields
};

/// The uniform block `Environment` of shaders/include/environment.glsl, std140.
struct EnvironmentBlock {
    glm::vec4 position{0.0F};  ///< xyz: where it was captured, w: 1; all 0: infinitely far away
    glm::ivec4 levels{0};      ///< x: how many there are
};

/// `origin` is where the shaders' positions count from.
EnvironmentBlock make_environment_block(const Environment& environment, const glm::dvec3& origin);

}  // namespace cubecam
