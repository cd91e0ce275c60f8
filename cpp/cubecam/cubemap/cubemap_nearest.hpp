/// Outputs of a capture, such as distances, normals and ids, as panoramas and in other sizes. These
/// functions only move texels, each result being the texel that contains the direction: a mixture
/// of two ids or distances would be the number of no object and no surface.
#pragma once

#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/image/pixels.hpp"
#include "cubecam/math/equirect.hpp"

#include <cstddef>

namespace cubecam {

/// Six "gl" faces [6][size][size] of texels of `bytes` bytes each: 1, 4, 8, 12 or 16.
struct TexelBytes {
    const std::byte* texels;
    int size;
    std::size_t bytes;
};

/// Returns [width/2][width] texels. @throws std::invalid_argument unless width is even and
/// positive.
PixelBuffer nearest_equirect(const TexelBytes& cube, int width, Center center, Sampling sampling);

/// Returns [6][size][size] texels. Where a new texel's center lies between two old ones, the one of
/// the larger row or column is taken.
PixelBuffer nearest_faces(const TexelBytes& cube, int size);

/// Returns the texels that `count` directions meet (xyz each, of any length but 0).
PixelBuffer nearest_lookup(const TexelBytes& cube, const float* directions, std::size_t count);

}  // namespace cubecam
