#pragma once

#include "cubecam/scene/probe_grid.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace cubecam {

/// The uniform block `ProbeGrid` of shaders/include/probe_grid.glsl, std140.
struct ProbeGridBlock {
    glm::vec4 first{0.0F};  ///< xyz: the first node, from the origin; w: normal bias, world units
    glm::vec4 step{1.0F};   ///< xyz: from node to node; w: view bias, world units
    glm::ivec4 counts{2};   ///< xyz: nodes; w: ProbeGridValue::resolution
};
static_assert(sizeof(ProbeGridBlock) == 48);

ProbeGridBlock make_probe_grid_block(const ProbeGridValue& grid, const glm::dvec3& origin);

/// Numbers of a texture, row by row.
struct GridPicture {
    int width;
    int height;
    std::vector<float> numbers;
};

/// Nine texels of four numbers for each node: the factors of the polynomials of grid_node_light();
/// the first texel's alpha says whether the node is active.
GridPicture light_picture(const ProbeGridValue& grid);

/// The octahedral maps, each with a border of one texel of what lies beyond its edge.
GridPicture distances_picture(const ProbeGridValue& grid);

}  // namespace cubecam
