#pragma once

#include "cubecam/render/passes/shadow_view.hpp"
#include "cubecam/render/passes/texture_units.hpp"

#include <glad/gl.h>
#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>

namespace cubecam {

/// The largest number of lights with a shadow: each takes a texture unit.
inline constexpr std::size_t max_shadows = 16;

/// A light's shadow map, ready for lookups.
struct ShadowUse {
    ShadowView view;
    Shadow shadow;
    GLuint texture = 0;
    std::uint64_t revision = 0;  ///< new whenever a layer was drawn
};

/// An element of the uniform block `Shadows` of shaders/include/shadows.glsl, std140.
struct ShadowBlock {
    glm::vec4 rows[3]{};
    glm::vec4 lens{};
    glm::vec4 filter{};
};

/// `origin` is the origin of the shaders' positions.
ShadowBlock make_shadow_block(const ShadowUse& use, const glm::dvec3& origin);

}  // namespace cubecam
