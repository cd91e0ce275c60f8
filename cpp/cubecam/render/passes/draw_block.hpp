#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <cstdint>

namespace cubecam {

/// Where that block is bound.
inline constexpr unsigned draw_binding = 0;

/// The uniform block `Draw` of shaders/include/draw.glsl, std140.
struct DrawBlock {
    glm::mat4 model;
    glm::mat4 normal_matrix;
    glm::vec4 material[2];  ///< what the material's shader file says
    float alpha;
    std::int32_t node_id;
    std::int32_t padding[2] = {0, 0};
    glm::vec4 origin;  ///< xyz: world position that positions in the shaders count from
};
static_assert(sizeof(DrawBlock) == 192);

/// `origin` is where the shaders' positions count from. `ambient` is what falls on everything: 1,
/// the model's own ambient light, plus the scene's ambient lights.
DrawBlock make_draw_block(const NodeSnapshot& node, const glm::dvec3& origin,
                          const glm::vec3& ambient);

}  // namespace cubecam
