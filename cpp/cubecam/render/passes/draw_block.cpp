#include "cubecam/render/passes/draw_block.hpp"

#include <algorithm>
#include <cmath>

namespace cubecam {
namespace {

/// The inverse transpose, so that normals stay normal to a surface that is scaled unevenly; scaled
/// to numbers near one, since only its direction counts and a float has no room for the inverse of
/// a very small scale.
glm::mat4 normal_matrix(const glm::dmat4& world) {
    const glm::dmat3 inverse_transpose = glm::transpose(glm::inverse(glm::dmat3(world)));
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(inverse_transpose[column][row]));
    }
    return glm::mat4(glm::mat3(inverse_transpose / largest));
}

}  // namespace

DrawBlock make_draw_block(const NodeSnapshot& node, const glm::dvec3& origin) {
    DrawBlock block{};
    glm::dmat4 model = node.world;
    model[3] -= glm::dvec4(origin, 0.0);
    block.model = glm::mat4(model);
    block.origin = glm::vec4(origin, 0.0F);
    block.normal_matrix = normal_matrix(node.world);
    block.node_id = node.id;
    const MaterialValue& material = node.material.value;
    block.alpha = material.traits().alpha * material.surface.opacity;
    return block;
}

}  // namespace cubecam
