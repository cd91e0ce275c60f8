/// Rows of pixels as floats, and texels of four floats as pixels (clones.hpp). Only the .cpp files
/// of cubemap/ include this header.
#pragma once

#include "cubecam/cubemap/cube_texels.hpp"
#include "cubecam/image/pixels.hpp"

#include <cstddef>

namespace cubecam {

/// Whether all numbers are finite.
bool all_finite_row(const float* numbers, std::size_t count);

/// Whether the first `channels` lanes of all texels are finite.
bool all_finite_texels(const Float4* texels, std::size_t count, int channels);

/// Converts a row as pixels_to_floats does, to the same bits. Returns whether all are finite.
bool row_to_floats(DType dtype, const std::byte* pixels, std::size_t count, float* to);

/// Writes `channels` numbers of each texel, rounded as floats_to_pixels rounds them: one after
/// another, or in the opposite order (step 1 or -1); the first of them goes to `to`.
void store_texels(const Float4* from, std::size_t count, int channels, int step, DType dtype,
                  std::byte* to);

}  // namespace cubecam
