#include "cubecam/render/draw_block.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

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

void fill(DrawBlock& block, const BasicParameters& p) { block.color = p.color; }

void fill(DrawBlock& block, const PhongParameters& p) {
    block.color = p.color;
    // pow(0, 0) is undefined in GLSL.
    block.parameters = {p.ka, p.kd, p.ks, std::max(p.shininess, 1e-6F)};
}

void fill(DrawBlock& block, const MirrorParameters& p) {
    block.color = glm::vec4(glm::vec3(p.color), p.color.a * p.tint.a);
    block.tint = p.tint;
    block.parameters = {p.env_weight, p.color_weight, p.fresnel.value_or(0.0F), 0.0F};
}

void fill(DrawBlock& block, const GlassParameters& p) {
    block.color = glm::vec4(1.0F, 1.0F, 1.0F, p.tint.a);
    block.tint = p.tint;
    block.parameters = {p.eta, 0.0F, 0.0F, 0.0F};
}

}  // namespace

DrawBlock make_draw_block(const NodeSnapshot& node) {
    DrawBlock block{};
    block.model = glm::mat4(node.world);
    block.normal_matrix = normal_matrix(node.world);
    block.node_id = node.id;
    block.translucent = node.translucent ? 1 : 0;
    const MaterialValue& material = node.material.value;
    std::visit([&block](const auto& parameters) { fill(block, parameters); }, material.parameters);
    block.color.a *= material.surface.opacity;
    return block;
}

}  // namespace cubecam
