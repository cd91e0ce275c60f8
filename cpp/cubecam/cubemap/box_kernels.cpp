#include "cubecam/cubemap/box_kernels.hpp"

#include "cubecam/cubemap/clones.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>

namespace cubecam {

namespace {

/// Two and four texels side by side. Functions take them by reference: without AVX, passing them by
/// value has no fixed ABI.
typedef float Float8 __attribute__((vector_size(32)));
typedef float Float16 __attribute__((vector_size(64)));

[[gnu::always_inline]] inline Float4 texel_at(const char* address) {
    Float4 texel;  // `address` is aligned for a float only
    std::memcpy(&texel, address, sizeof texel);
    return texel;
}

/// The addresses of four texels.
struct Four {
    const char* at[4];
};

[[gnu::always_inline]] inline void load(const Four& from, std::ptrdiff_t offset, Float16& texels) {
    const Float8 low = __builtin_shufflevector(
        texel_at(from.at[0] + offset), texel_at(from.at[1] + offset), 0, 1, 2, 3, 4, 5, 6, 7);
    const Float8 high = __builtin_shufflevector(
        texel_at(from.at[2] + offset), texel_at(from.at[3] + offset), 0, 1, 2, 3, 4, 5, 6, 7);
    texels = __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14,
                                     15);
}

[[gnu::always_inline]] inline Four moved(const Four& from, const std::ptrdiff_t (&by)[4]) {
    return {{from.at[0] + by[0], from.at[1] + by[1], from.at[2] + by[2], from.at[3] + by[3]}};
}

[[gnu::always_inline]] inline void store(const Float16& texels, Float4* to) {
    std::memcpy(static_cast<void*>(to), &texels, sizeof texels);
}

/// Weights of four taps, each in four lanes.
struct Weights {
    Float16 near;
    Float16 last;
};

[[gnu::always_inline]] inline void load(const BoxTap* taps, Weights& weights) {
    static_assert(sizeof(BoxTap) == 16 && offsetof(BoxTap, near) == 8 &&
                  offsetof(BoxTap, last) == 12);
    Float16 all;
    std::memcpy(&all, taps, sizeof all);
    weights.near = __builtin_shufflevector(all, all, 2, 2, 2, 2, 6, 6, 6, 6, 10, 10, 10, 10, 14, 14,
                                           14, 14);
    weights.last = __builtin_shufflevector(all, all, 3, 3, 3, 3, 7, 7, 7, 7, 11, 11, 11, 11, 15, 15,
                                           15, 15);
}

/// Four of sixteen numbers, from number 4 * four on, each in four lanes.
template <int four>
[[gnu::always_inline]] inline void spread(const Float16& numbers, Float16& lanes) {
    constexpr int i = 4 * four;
    lanes = __builtin_shufflevector(numbers, numbers, i, i, i, i, i + 1, i + 1, i + 1, i + 1, i + 2,
                                    i + 2, i + 2, i + 2, i + 3, i + 3, i + 3, i + 3);
}

/// apply_tap's arithmetic on four texels.
template <bool near>
[[gnu::always_inline]] inline void weigh(const Float16& first, const Float16& second,
                                         const Float16& third, const Weights& weights,
                                         Float16& result) {
    if constexpr (near) {
        result = first + ((second - first) * weights.near + (third - first) * weights.last);
    } else {
        result = first + (second - first) * weights.near;
    }
}

/// Filters texels `step` bytes apart; the last ones lie at `last`.
template <bool near>
[[gnu::always_inline]] inline void filter(const Four& from, std::ptrdiff_t step, const Four& last,
                                          std::ptrdiff_t offset, const Weights& weights,
                                          Float16& result) {
    Float16 first;
    Float16 second;
    Float16 third;
    load(from, offset, first);
    load(from, offset + step, second);
    if constexpr (near) {
        load(last, offset, third);
    } else {
        third = second;
    }
    weigh<near>(first, second, third, weights, result);
}

/// One texel by a tap of any width.
[[gnu::always_inline]] inline Float4 filter_far(const BoxTap& tap, const char* from,
                                                std::ptrdiff_t step) {
    return apply_tap<Reach::far>(
        tap, [=](int i) __attribute__((always_inline)) { return texel_at(from + i * step); });
}

template <bool near>
[[gnu::always_inline]] inline void row_near(const char* row, const RowTaps& taps, Float4* to) {
    for (std::size_t i = 0; i < taps.count; i += 4) {
        Four first;
        Four last;
        for (std::size_t k = 0; k < 4; ++k) {
            first.at[k] = row + taps.first_at[i + k];
            last.at[k] = first.at[k] + taps.last_at[i + k];
        }
        Weights weights;
        std::memcpy(&weights.near, taps.near + 4 * i, sizeof weights.near);
        std::memcpy(&weights.last, taps.last + 4 * i, sizeof weights.last);
        Float16 result;
        filter<near>(first, taps.texel, last, 0, weights, result);
        store(result, to + i);
    }
}

template <bool near>
[[gnu::always_inline]] inline void columns_near(const char* rows, const BoxTap* taps,
                                                std::size_t count, Float4* to) {
    constexpr std::ptrdiff_t texel = sizeof(Float4);
    constexpr std::ptrdiff_t stride = tile_size * texel;
    for (std::size_t i = 0; i < count; i += 4, taps += 4, rows += 4 * texel) {
        Four first;
        Four last;
        for (std::ptrdiff_t k = 0; k < 4; ++k) {
            first.at[k] = rows + taps[k].first * stride + k * texel;
            last.at[k] = first.at[k] + taps[k].inner * stride + stride;
        }
        Weights weights;
        load(taps, weights);
        Float16 result;
        filter<near>(first, stride, last, 0, weights, result);
        store(result, to + i);
    }
}

template <bool near>
[[gnu::always_inline]] inline void boxes_near(const TexelGrid& texels, const BoxTap* down,
                                              const BoxTap* across, std::size_t count, Float4* to) {
    const char* base = reinterpret_cast<const char*>(texels.base);
    const std::ptrdiff_t row = texels.row;
    const std::ptrdiff_t texel = texels.texel;
    for (std::size_t i = 0; i < count; i += 4, down += 4, across += 4) {
        Four first;
        std::ptrdiff_t right[4];
        std::ptrdiff_t below[4];
        for (std::size_t k = 0; k < 4; ++k) {
            first.at[k] = base + down[k].first * row + across[k].first * texel;
            right[k] = across[k].inner * texel + texel;
            below[k] = down[k].inner * row + row;
        }
        const Four last = moved(first, right);
        Weights weights;
        load(across, weights);
        Float16 upper;
        Float16 middle;
        Float16 lower;
        filter<near>(first, texel, last, 0, weights, upper);
        filter<near>(first, texel, last, row, weights, middle);
        if constexpr (near) {
            filter<near>(moved(first, below), texel, moved(last, below), 0, weights, lower);
        } else {
            lower = middle;
        }
        load(down, weights);
        Float16 result;
        weigh<near>(upper, middle, lower, weights, result);
        store(result, to + i);
    }
}

/// Four bilinear lookups: those from number i + 4 * four on.
template <int four>
[[gnu::always_inline]] inline void bilinear(const TexelGrid& texels, const BilinearTaps& taps,
                                            std::size_t i, Float16& result) {
    const char* base = reinterpret_cast<const char*>(texels.base);
    Four first;
    for (std::size_t k = 0; k < 4; ++k) first.at[k] = base + taps.at[i + 4 * four + k];
    // As they were stored: a load from parts of two stores would wait for both.
    Float16 weights;
    Float16 right;
    Float16 bottom;
    std::memcpy(&weights, taps.right + i, sizeof weights);
    spread<four>(weights, right);
    std::memcpy(&weights, taps.bottom + i, sizeof weights);
    spread<four>(weights, bottom);
    Float16 a;
    Float16 b;
    load(first, 0, a);
    load(first, texels.texel, b);
    const Float16 upper = a + (b - a) * right;
    load(first, texels.row, a);
    load(first, texels.row + texels.texel, b);
    const Float16 lower = a + (b - a) * right;
    result = upper + (lower - upper) * bottom;
}

/// Calls body(i, std::integral_constant<int, four>) for the lookups i + 4 * four.
template <typename Body>
[[gnu::always_inline]] inline void for_fours(std::size_t count, const Body& body) {
    for (std::size_t i = 0; i < count; i += 16) {
        body(i, std::integral_constant<int, 0>{});
        if (i + 4 < count) body(i, std::integral_constant<int, 1>{});
        if (i + 8 < count) body(i, std::integral_constant<int, 2>{});
        if (i + 12 < count) body(i, std::integral_constant<int, 3>{});
    }
}

}  // namespace

void RowTaps::set(const TapList& list, std::ptrdiff_t texel_bytes) {
    taps = &list;
    texel = texel_bytes;
    count = (list.size() + 3) / 4 * 4;
    const auto step = static_cast<std::int32_t>(texel_bytes);
    for (std::size_t i = 0; i < count; ++i) {
        const BoxTap& tap = *list.data(i);
        first_at[i] = tap.first * step;
        last_at[i] = (tap.inner + 1) * step;
        for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) {
            near[k] = tap.near;
            last[k] = tap.last;
        }
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
        const int beyond = (turned_x > 1.0f) | (turned_x < -1.0f) | (turned_z > 1.0f) |
                           (turned_z < -1.0f);
        taps.outside[i] |= beyond;
        // What lies beyond the square is looked up by the caller, and here anywhere in the grid.
        const int in_column = std::min(std::max(left - at.column0, 0), at.columns - 2);
        const int in_row = std::min(std::max(upper - at.row0, 0), at.rows - 2);
        taps.at[i] = in_row * at.row + in_column * at.texel;
    }
}

CUBECAM_CLONES void look_bilinear(const TexelGrid& texels, const BilinearTaps& taps,
                                  std::size_t count, Float4* first) {
    for_fours(count, [&](std::size_t i, auto four) __attribute__((always_inline)) {
        Float16 found;
        bilinear<four()>(texels, taps, i, found);
        store(found, first + i + 4 * four());
    });
}

CUBECAM_CLONES void add_bilinear(const TexelGrid& texels, const BilinearTaps& taps,
                                 std::size_t count, const Float4* first, Float4* sum) {
    for_fours(count, [&](std::size_t i, auto four) __attribute__((always_inline)) {
        Float16 found;
        Float16 one;
        Float16 total;
        bilinear<four()>(texels, taps, i, found);
        std::memcpy(&one, first + i + 4 * four(), sizeof one);
        std::memcpy(&total, sum + i + 4 * four(), sizeof total);
        total += found - one;
        store(total, sum + i + 4 * four());
    });
}

}  // namespace cubecam
