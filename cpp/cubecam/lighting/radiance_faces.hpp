/// Faces of cubemaps as radiance: RGBA floats, which filters and the GPU read.
#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/lighting/filtered_cube.hpp"
#include "cubecam/math/cube_face.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace cubecam {

/// The texels of one face as floats, uint8 as value/255. One channel becomes grey; alpha is 1 where
/// the cube has none.
std::vector<glm::vec4> radiance_face(const CubeMapData& cube, Face face);

/// The levels that a cubemap has of its own (CubeMapData::levels), as floats: levels 1, 2, ...;
/// empty if it has none.
std::vector<FilteredLevel> own_levels(const CubeMapData& cube);

/// Each face with a border of one texel, (size + 2)^2 texels a face: plain bilinear lookups within
/// it give what seamless lookups of the cube give. A border texel is the neighbour's texel across
/// the edge; in a corner, it is the average of the three texels that meet there (GL 4.6, section
/// 8.14).
std::vector<glm::vec4> bordered_faces(const FilteredLevel& level);

}  // namespace cubecam
