#pragma once

#include "cubecam/materials/kind.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/filtered_texture.hpp"
#include "cubecam/scene/environment_placing.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace cubecam {

/// How the levels of an environment's cube were made, except the finest one.
enum class EnvironmentLevels : std::uint8_t { none, mipmaps, filtered };

/// The picture that a planar mirror shows instead of the environment, where a ray does not go
/// through its plane.
struct PlanarReflection {
    BoundTexture picture;    ///< texture 0: none
    glm::dvec3 normal{0.0};  ///< of the plane, unit length
    double distance = 1.0;   ///< PlanarMirrorValue::distance
};

/// The environment that a surface reflects.
struct Environment {
    BoundTexture cube;  ///< texture 0: none, black
    EnvironmentLevels levels = EnvironmentLevels::none;
    int level_count = 1;                 ///< including the finest one
    std::optional<glm::dvec3> position;  ///< of the capture, world; none: infinitely far away
    EnvironmentPlacing placing;          ///< plain except for the scene's own environment
    EnvironmentParts parts;              ///< what the surface looks up besides the cube
    /// The levels by roughness, and the irradiance; null: not needed, or replaced by mipmaps. It
    /// stays valid for the call.
    const FilteredTexture* filtered = nullptr;
    BoundTexture box_mipmaps;  ///< the cube with box-filtered levels; texture 0: not needed
    PlanarReflection planar;

    /// Makes the filtered levels the levels of the environment.
    void filter(const FilteredTexture& by_roughness) {
        filtered = &by_roughness;
        levels = EnvironmentLevels::filtered;
        level_count = by_roughness.level_count();
    }

    /// Adds all values on which a picture depends.
    void add_to(std::vector<std::uint64_t>& key) const;
};

/// All textures that a node looks up.
struct NodeTextures {
    Environment environment;
    std::vector<BoundTexture> textures;  ///< in the order of the material's fields
    BoundTexture behind;  ///< the scene behind a transmissive surface; texture 0: none
};

/// The uniform block `Environment` of shaders/include/environment.glsl, std140.
struct EnvironmentBlock {
    glm::vec4 position{0.0F};  ///< xyz: position of the capture, w: 1; all 0: infinitely far
    glm::ivec4 levels{0};      ///< x: how many levels
    glm::vec4 turn[3];  ///< xyz: rows of the matrix from the world to the cube; [0].w: intensity
    glm::vec4 texel{0.0F};                                 ///< xy: FilteredTexture::texel
    std::array<glm::vec4, most_filtered_levels> places{};  ///< FilteredTexture::places
    glm::vec4 planar{0.0F};  ///< PlanarReflection: xyz: normal, w: distance
};
static_assert(sizeof(EnvironmentBlock) == 112 + 16 * most_filtered_levels);

/// Whether a surface reads the block, or only the cube. `user_code`: the GLSL is a user's own.
inline bool needs_block(const Environment& environment, bool user_code) {
    return user_code || environment.parts.filtered || !environment.placing.is_plain() ||
           environment.planar.picture.texture != 0;
}

/// `origin` is the origin of the shaders' positions.
EnvironmentBlock make_environment_block(const Environment& environment, const glm::dvec3& origin);

}  // namespace cubecam
