#include "cubecam/render/passes/draw_block.hpp"

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

/// Each writes what shaders/<material>.glsl reads. Factors that no texture changes are multiplied
/// here, once.
void fill(DrawBlock& block, const BasicParameters& p, const glm::vec3&) {
    block.material[0] = p.color;
    block.alpha = p.color.a;
}

void fill(DrawBlock& block, const PhongParameters& p, const glm::vec3& ambient) {
    const glm::vec3 color(p.color);
    block.material[0] = glm::vec4(p.ka * color * ambient, p.shininess);
    block.material[1] = glm::vec4(p.kd * color, p.ks);
    block.alpha = p.color.a;
}

void fill(DrawBlock& block, const MirrorParameters& p, const glm::vec3&) {
    block.material[0] = glm::vec4(p.env_weight * glm::vec3(p.tint), p.fresnel.value_or(0.0F));
    block.material[1] = glm::vec4(p.color_weight * glm::vec3(p.color), 0.0F);
    block.alpha = p.tint.a * p.color.a;
}

void fill(DrawBlock& block, const GlassParameters& p, const glm::vec3&) {
    block.material[0] = glm::vec4(glm::vec3(p.tint), p.eta);
    block.alpha = p.tint.a;
}

void fill(DrawBlock& block, const ShaderParameters&, const glm::vec3&) { block.alpha = 1.0F; }

}  // namespace

DrawBlock make_draw_block(const NodeSnapshot& node, const glm::dvec3& origin,
                          const glm::vec3& ambient) {
    DrawBlock block{};
    glm::dmat4 model = node.world;
    model[3] -= glm::dvec4(origin, 0.0);
    block.model = glm::mat4(model);
    block.origin = glm::vec4(origin, 0.0F);
    block.normal_matrix = normal_matrix(node.world);
    block.node_id = node.id;
    const MaterialValue& material = node.material.value;
    std::visit([&](const auto& parameters) { fill(block, parameters, ambient); },
               material.parameters);
    block.alpha *= material.surface.opacity;
    return block;
}

}  // namespace cubecam
