#include "cubecam/cubemap/box_kernels.hpp"

#include "cubecam/cubemap/clones.hpp"

#include <algorithm>
#include <cstring>

namespace cubecam {

namespace {

// One texel is one register of four floats. Wider ones, with two or four texels, would have to be
// put together from as many loads, which takes as long as the arithmetic that they save.

[[gnu::always_inline]] inline Float4 texel_at(const char* address) {
    Float4 texel;  // `address` is aligned for a float only
    std::memcpy(&texel, address, sizeof texel);
    return texel;
}

[[gnu::always_inline]] inline Float4 each(float number) {
    return Float4{number, number, number, number};
}

/// apply_tap's arithmetic.
template <bool near>
[[gnu::always_inline]] inline Float4 weigh(const Float4& first, const Float4& second,
                                           const Float4& third, float near_weight,
                                           float last_weight) {
    if constexpr (near) {
        return first + ((second - first) * each(near_weight) + (third - first) * each(last_weight));
    } else {
        return first + (second - first) * each(near_weight);
    }
}

/// Filters texels `step` bytes apart; the last one lies `last` bytes from the first.
template <bool near>
[[gnu::always_inline]] inline Float4 filter(const char* from, std::ptrdiff_t step,
                                            std::ptrdiff_t last, float near_weight,
                                            float last_weight) {
    const Float4 first = texel_at(from);
    const Float4 second = texel_at(from + step);
    if constexpr (near) {
        return weigh<true>(first, second, texel_at(from + last), near_weight, last_weight);
    } else {
        return weigh<false>(first, second, second, near_weight, last_weight);
    }
}

/// One texel by a tap of any width.
[[gnu::always_inline]] inline Float4 filter_far(const BoxTap& tap, const char* from,
                                                std::ptrdiff_t step) {
    return apply_tap<Reach::far>(
        tap, [=](int i) __attribute__((always_inline)) { return texel_at(from + i * step); });
}

template <bool near>
[[gnu::always_inline]] inline void row_near(const char* row, const RowTaps& taps, Float4* to) {
    const std::ptrdiff_t texel = taps.texel;
    for (std::size_t i = 0; i < taps.count; ++i) {
        to[i] = filter<near>(row + taps.first_at[i], texel, taps.last_at[i], taps.near[i],
                             taps.last[i]);
    }
}

template <bool near>
[[gnu::always_inline]] inline void columns_near(const char* rows, const BoxTap* taps,
                                                std::size_t count, Float4* to) {
    constexpr std::ptrdiff_t texel = sizeof(Float4);
    constexpr std::ptrdiff_t stride = tile_size * texel;
    for (std::size_t i = 0; i < count; ++i, rows += texel) {
        const BoxTap& tap = taps[i];
        to[i] = filter<near>(rows + tap.first * stride, stride, tap.inner * stride + stride,
                             tap.near, tap.last);
    }
}

template <bool near>
[[gnu::always_inline]] inline void boxes_near(const TexelGrid& texels, const BoxTap* down,
                                              const BoxTap* across, std::size_t count, Float4* to) {
    const char* base = reinterpret_cast<const char*>(texels.base);
    const std::ptrdiff_t row = texels.row;
    const std::ptrdiff_t texel = texels.texel;
    for (std::size_t i = 0; i < count; ++i) {
        const BoxTap& right = across[i];
        const BoxTap& below = down[i];
        const char* first = base + below.first * row + right.first * texel;
        const std::ptrdiff_t last = right.inner * texel + texel;
        const auto line = [&](const char* from) __attribute__((always_inline)) {
            return filter<near>(from, texel, last, right.near, right.last);
        };
        const Float4 upper = line(first);
        const Float4 middle = line(first + row);
        Float4 lower = middle;
        if constexpr (near) lower = line(first + below.inner * row + row);
        to[i] = weigh<near>(upper, middle, lower, below.near, below.last);
    }
}

[[gnu::always_inline]] inline Float4 bilinear(const TexelGrid& texels, const BilinearTaps& taps,
                                              std::size_t i) {
    const char* at = reinterpret_cast<const char*>(texels.base) + taps.at[i];
    const Float4 upper = mix_texels(texel_at(at), texel_at(at + texels.texel), taps.right[i]);
    at += texels.row;
    const Float4 lower = mix_texels(texel_at(at), texel_at(at + texels.texel), taps.right[i]);
    return mix_texels(upper, lower, taps.bottom[i]);
}

}  // namespace

void RowTaps::set(const TapList& list, std::ptrdiff_t texel_bytes) {
    taps = &list;
    texel = texel_bytes;
    count = list.size();
    const auto step = static_cast<std::int32_t>(texel_bytes);
    for (std::size_t i = 0; i < count; ++i) {
        const BoxTap& tap = *list.data(i);
        first_at[i] = tap.first * step;
        last_at[i] = (tap.inner + 1) * step;
        near[i] = tap.near;
        last[i] = tap.last;
    }
}

CUBECAM_CLONES void filter_row(const float* row, const RowTaps& taps, Float4* to) {
    const char* from = reinterpret_cast<const char*>(row);
    const Reach reach = taps.taps->reach();
    if (reach == Reach::linear) return row_near<false>(from, taps, to);
    if (reach == Reach::near) return row_near<true>(from, taps, to);
    for (std::size_t i = 0; i < taps.count; ++i) {
        to[i] = filter_far(*taps.taps->data(i), from + taps.first_at[i], taps.texel);
    }
}

CUBECAM_CLONES void filter_columns(Reach reach, const Float4* rows, const BoxTap* taps,
                                   std::size_t count, Float4* to) {
    const char* from = reinterpret_cast<const char*>(rows);
    if (reach == Reach::linear) return columns_near<false>(from, taps, count, to);
    if (reach == Reach::near) return columns_near<true>(from, taps, count, to);
    constexpr std::ptrdiff_t stride = tile_size * sizeof(Float4);
    for (std::size_t i = 0; i < count; ++i, from += sizeof(Float4)) {
        to[i] = filter_far(taps[i], from + taps[i].first * stride, stride);
    }
}

CUBECAM_CLONES void filter_boxes(Reach reach, const TexelGrid& texels, const BoxTap* down,
                                 const BoxTap* across, std::size_t count, Float4* to) {
    if (reach == Reach::linear) return boxes_near<false>(texels, down, across, count, to);
    if (reach == Reach::near) return boxes_near<true>(texels, down, across, count, to);
    const char* base = reinterpret_cast<const char*>(texels.base);
    for (std::size_t i = 0; i < count; ++i) {
        const char* from = base + down[i].first * texels.row + across[i].first * texels.texel;
        const BoxTap& tap = across[i];
        to[i] = apply_tap<Reach::far>(down[i], [&](int k) __attribute__((always_inline)) {
            return filter_far(tap, from + k * texels.row, texels.texel);
        });
    }
}

CUBECAM_CLONES void place_bilinear(const float* x, const float* z, float cosine, float sine,
                                   const PolePlane& plane, BilinearTaps& taps) {
    const PolePlane at = plane;
    for (int i = 0; i < tile_size; ++i) {
        const float turned_x = x[i] * cosine - z[i] * sine;
        const float turned_z = z[i] * cosine + x[i] * sine;
        const float column = turned_x * at.scale + at.middle;
        const float row = at.turn * turned_z * at.scale + at.middle;
        // Both are at least -1/2: after adding 1, rounding towards 0 is rounding down.
        const int left = static_cast<int>(column + 1.0f) - 1;
        const int upper = static_cast<int>(row + 1.0f) - 1;
        taps.right[i] = column - static_cast<float>(left);
        taps.bottom[i] = row - static_cast<float>(upper);
        const int beyond =
            (turned_x > 1.0f) | (turned_x < -1.0f) | (turned_z > 1.0f) | (turned_z < -1.0f);
        taps.outside[i] |= beyond;
        // What lies beyond the square is looked up by the caller, and here anywhere in the grid.
        const int in_column = std::min(std::max(left - at.column0, 0), at.columns - 2);
        const int in_row = std::min(std::max(upper - at.row0, 0), at.rows - 2);
        taps.at[i] = in_row * at.row + in_column * at.texel;
    }
}

CUBECAM_CLONES void look_bilinear(const TexelGrid& texels, const BilinearTaps& taps,
                                  std::size_t count, Float4* first) {
    for (std::size_t i = 0; i < count; ++i) first[i] = bilinear(texels, taps, i);
}

CUBECAM_CLONES void add_bilinear(const TexelGrid& texels, const BilinearTaps& taps,
                                 std::size_t count, const Float4* first, Float4* sum) {
    for (std::size_t i = 0; i < count; ++i) sum[i] += bilinear(texels, taps, i) - first[i];
}

}  // namespace cubecam
