/// The inner loop of filtering. Only the .cpp files of lighting/ include this header.
#pragma once

#include "cubecam/lighting/radiance_tree.hpp"

#include <cstddef>

namespace cubecam {

/// Texels that are filtered together.
inline constexpr std::size_t tile_texels = 16;

/// Unit vectors in the axes of a source face.
struct alignas(64) TileNormals {
    float x[tile_texels];
    float y[tile_texels];
    float z[tile_texels];
};

/// Weighted sums of a tile over some nodes.
struct alignas(64) TileSums {
    float red[tile_texels];
    float green[tile_texels];
    float blue[tile_texels];
    float alpha[tile_texels];
    float weight[tile_texels];
};

/// sums = the sum over nodes of lobe(N, node) * (radiance, solid angle), where
///   lobe = max(N.L, 0) / (1 + sharpness (1 - N.L))^2
/// is GGX's D(h) N.L with V = N (filtered_cube.cpp derives it) without a constant factor. Red,
/// green and blue are weighted each for its own center; alpha and the solid angle are weighted for
/// the geometric one, which is also that of constant light, so that a constant stays constant.
void filter_tile(const TileNormals& normals, float sharpness, const RadianceNode* const* nodes,
                 std::size_t count, TileSums& sums);

}  // namespace cubecam
