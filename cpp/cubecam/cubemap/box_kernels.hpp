/// The inner loops of resampling for texels of three and four channels: two texels at a time if the
/// processor has AVX2, which is checked at run time. Only the .cpp files of cubemap/ include this
/// header.
#pragma once

#include "cubecam/cubemap/box_filter.hpp"

#include <cstddef>
#include <cstdint>

namespace cubecam {

/// A tap with the places of its texels in memory: the bytes from the base to its first texel, and
/// from there to its last. The weights are those of BoxTap.
struct BoundTap {
    std::int32_t first;
    std::int32_t last;
    float near_weight;
    float last_weight;
};

/// to[i] = the box taps[i] over texels from `base`, the second one `step` bytes after the first,
/// for taps of two texels (linear) or at most three (near).
void filter_linear(const void* base, std::ptrdiff_t step, const BoundTap* taps, std::size_t count,
                   Float4* to);
void filter_near(const void* base, std::ptrdiff_t step, const BoundTap* taps, std::size_t count,
                 Float4* to);

/// Boxes in both directions over a rectangle with rows of `stride` bytes: down[i] by across[i].
void filter_boxes_linear(const Float4* base, std::ptrdiff_t stride, const BoundTap* down,
                         const BoundTap* across, std::size_t count, Float4* to);
void filter_boxes_near(const Float4* base, std::ptrdiff_t stride, const BoundTap* down,
                       const BoundTap* across, std::size_t count, Float4* to);

}  // namespace cubecam
