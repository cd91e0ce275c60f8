#include "cubecam/render/resources/node_record.hpp"

#include <algorithm>
#include <cmath>
#include <span>

namespace cubecam {
namespace {

/// The inverse transpose, so that normals stay perpendicular to a surface with an uneven scale. It
/// is scaled to numbers near one, since only directions matter and a float cannot hold the inverse
/// of a very small scale.
glm::mat3 normal_matrix(const glm::dmat4& world) {
    const glm::dmat3 inverse_transpose = glm::transpose(glm::inverse(glm::dmat3(world)));
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
        for (int row = 0; row < 3; ++row)
            largest = std::max(largest, std::abs(inverse_transpose[column][row]));
    }
    return glm::mat3(inverse_transpose / largest);
}

glm::mat4 model_matrix(const NodeSnapshot& node, const glm::dvec3& origin) {
    glm::dmat4 model = node.world;
    model[3] -= glm::dvec4(origin, 0.0);
    return glm::mat4(model);
}

float alpha_of(const MaterialValue& material) {
    return material.traits().alpha * material.surface.opacity;
}

}  // namespace

NodeBlock make_node_block(const NodeSnapshot& node, const glm::dvec3& origin) {
    NodeBlock block{};
    block.model = model_matrix(node, origin);
    block.origin = glm::vec4(origin, 0.0F);
    block.normal_matrix = glm::mat4(normal_matrix(node.world));
    block.node_id = node.id;
    block.label = node.label;
    block.alpha = alpha_of(node.material.value);
    return block;
}

NodeRecord make_node_record(const NodeSnapshot& node, const glm::dvec3& origin,
                            const glm::vec3& ambient) {
    NodeRecord record{};
    const glm::mat4 model = model_matrix(node, origin);
    for (int column = 0; column < 4; ++column) record.model[column] = model[column];
    record.model[0].w = alpha_of(node.material.value);
    const glm::mat3 normals = normal_matrix(node.world);
    for (int column = 0; column < 3; ++column) {
        record.normal_matrix[column] = glm::vec4(normals[column], 0.0F);
    }
    record.id_and_label = {node.id, node.label};
    const MaterialModel& material = *node.material.value.model;
    const std::size_t constants = material.traits().constants;
    if (constants <= most_flat_constants) {
        material.write_constants(ambient, std::span(record.material, constants));
    }
    return record;
}

}  // namespace cubecam
