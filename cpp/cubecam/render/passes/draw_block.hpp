#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <cstdint>

namespace cubecam {

/// Where that block is bound, and where the block of the material's own constants is.
inline constexpr unsigned draw_binding = 0;
inline constexpr unsigned material_binding = 3;

/// The uniform block `Draw` of shaders/include/draw.glsl, std140.
struct DrawBlock {
    glm::mat4 model;
    glm::mat4 normal_matrix;
    float alpha;  ///< opacity and the colours' alpha
    std::int32_t node_id;
    std::int32_t padding[2] = {0, 0};
    glm::vec4 origin;  ///< xyz: world position that positions in the shaders count from
};
static_assert(sizeof(DrawBlock) == 160);

/// `origin` is where the shaders' positions count from.
DrawBlock make_draw_block(const NodeSnapshot& node, const glm::dvec3& origin);

}  // namespace cubecam
