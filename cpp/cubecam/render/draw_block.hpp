#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <cstdint>

namespace cubecam {

/// The uniform block `Draw` of shaders/draw.glsl, std140.
struct DrawBlock {
    glm::mat4 model;
    glm::mat4 normal_matrix;
    glm::vec4 color;
    glm::vec4 tint;
    glm::vec4 parameters;
    std::int32_t node_id;
    std::int32_t translucent;
    std::int32_t padding[2] = {0, 0};
};
static_assert(sizeof(DrawBlock) == 192);

DrawBlock make_draw_block(const NodeSnapshot& node);

}  // namespace cubecam
