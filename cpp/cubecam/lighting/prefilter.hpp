/// Cubemaps made of cubemaps: filtered by roughness, and their diffuse light.
#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/lighting/filtered_cube.hpp"

#include <memory>

namespace cubecam {

/// The cube with CubeMapData::levels: levels 1 to levels - 1 of FilteredCube, in the cube's dtype
/// and channels. Outputs of a capture are left out. Null if it was cancelled.
/// @throws std::invalid_argument unless levels is at least 2.
std::shared_ptr<CubeMap> prefilter(const CubeMapData& cube, int levels,
                                   const FilteredCube::Progress& progress = {});

/// The cosine-weighted mean of the radiance around each direction, size * size texels a face, in
/// the cube's dtype and channels. Null if it was cancelled.
std::shared_ptr<CubeMap> irradiance(const CubeMapData& cube, int size,
                                    const FilteredCube::Progress& progress = {});

}  // namespace cubecam
