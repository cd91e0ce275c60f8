#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <cstdint>

namespace cubecam {

/// Binding points of the uniform blocks of a draw call: the node, the material's constants, the
/// view, the environment.
inline constexpr unsigned node_binding = 0;
inline constexpr unsigned material_binding = 3;
inline constexpr unsigned view_binding = 4;
inline constexpr unsigned environment_binding = 5;
/// Of the environments that are blended with the first one, and of their influences.
inline constexpr unsigned further_environment_binding = 8;
inline constexpr unsigned influences_binding = 12;
inline constexpr unsigned probe_grid_binding = 13;

/// The largest number of material constants that are flat inputs: more of them would cost each
/// triangle more than they save (docs/adr/0004).
inline constexpr std::size_t most_flat_constants = 2;

/// A node that is drawn alone, for all views that see it: the uniform block `Node` of
/// shaders/include/node.glsl, std140.
struct NodeBlock {
    glm::mat4 model;
    glm::mat4 normal_matrix;
    float alpha;  ///< the product of opacity and the colours' alpha
    std::int32_t node_id;
    std::int32_t label;
    std::int32_t padding = 0;
    glm::vec4 origin;  ///< xyz: world position of the origin of positions in the shaders
};
static_assert(sizeof(NodeBlock) == 160);

/// A node that is drawn together with others, for one view. Shaders read it as vertex attributes
/// that advance once for each instance (shaders/include/node.glsl).
struct NodeRecord {
    glm::vec4 model[4];                       ///< columns; [0].w: alpha, as above
    glm::vec4 normal_matrix[3];               ///< columns
    glm::vec4 material[most_flat_constants];  ///< the material's constants, if they fit
    glm::ivec2 id_and_label;
    std::int32_t padding[2] = {0, 0};
};
static_assert(sizeof(NodeRecord) == 160);

/// `origin` is the origin of the shaders' positions.
NodeBlock make_node_block(const NodeSnapshot& node, const glm::dvec3& origin);

/// `ambient` is the sum of the scene's ambient lights.
NodeRecord make_node_record(const NodeSnapshot& node, const glm::dvec3& origin,
                            const glm::vec3& ambient);

}  // namespace cubecam
