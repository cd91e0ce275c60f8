/// Texels of a cube as floats, with their neighbours beyond the edges. Only the .cpp files of
/// cubemap/ include this header.
#pragma once

#include "cubecam/image/pixels.hpp"
#include "cubecam/math/cube_edges.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <type_traits>

namespace cubecam {

/// Four floats that compilers keep in one register (GCC and Clang).
typedef float Float4 __attribute__((vector_size(16)));

/// A texel of 1, 3 or 4 channels during a computation. With three channels the fourth lane is 0.
template <int Channels>
using Lane = std::conditional_t<Channels == 1, float, Float4>;

inline float to_float(std::uint8_t value) { return unorm8_to_float(value); }
inline float to_float(std::uint16_t value) { return half_to_float(value); }
inline float to_float(float value) { return value; }

template <int Channels, typename Pixel>
Lane<Channels> load_texel(const Pixel* from) {
    if constexpr (Channels == 1) {
        return to_float(from[0]);
    } else if constexpr (std::is_same_v<Pixel, std::uint8_t>) {
        // One division of four numbers; each is rounded as unorm8_to_float does.
        const float alpha = Channels == 4 ? static_cast<float>(from[Channels - 1]) : 0.0f;
        return Float4{static_cast<float>(from[0]), static_cast<float>(from[1]),
                      static_cast<float>(from[2]), alpha} /
               255.0f;
    } else if constexpr (Channels == 3) {
        return Float4{to_float(from[0]), to_float(from[1]), to_float(from[2]), 0.0f};
    } else if constexpr (std::is_same_v<Pixel, float>) {
        Float4 texel;
        std::memcpy(&texel, from, sizeof texel);
        return texel;
    } else {
        return Float4{to_float(from[0]), to_float(from[1]), to_float(from[2]), to_float(from[3])};
    }
}

/// Like load_texel, but faster, for a texel that another one follows in memory. With three channels
/// the fourth lane then holds the number that follows, and no caller may use it.
template <int Channels, typename Pixel>
Lane<Channels> load_texel_before_another(const Pixel* from) {
    if constexpr (Channels == 3 && std::is_same_v<Pixel, float>) {
        return load_texel<4>(from);
    } else {
        return load_texel<Channels>(from);
    }
}

template <int Channels>
void store_texel(Lane<Channels> texel, float* to) {
    if constexpr (Channels == 1) {
        *to = texel;
    } else if constexpr (Channels == 3) {
        typedef double Double2 __attribute__((vector_size(16)));
        const double two = reinterpret_cast<Double2>(texel)[0];  // 8 bytes of register, 2 floats
        std::memcpy(to, &two, sizeof two);
        to[2] = texel[2];
    } else {
        std::memcpy(to, &texel, sizeof texel);
    }
}

/// Whether all numbers are finite.
inline bool all_finite(const float* numbers, std::size_t count) {
    constexpr std::uint32_t exponent = 0x7f800000u;
    std::uint32_t bad = 0;  // whole numbers and no branch, so that the compiler uses SIMD
    for (std::size_t i = 0; i < count; ++i) {
        bad |= (std::bit_cast<std::uint32_t>(numbers[i]) & exponent) == exponent ? 1u : 0u;
    }
    return bad == 0;
}

/// Whether all channels of a texel are finite.
template <int Channels>
bool is_finite(const Lane<Channels>& texel) {
    if constexpr (Channels == 1) {
        return texel - texel == 0.0f;
    } else {
        bool finite = true;
        for (int c = 0; c < Channels; ++c) finite &= texel[c] - texel[c] == 0.0f;
        return finite;
    }
}

/// The texel, with the channels of `other` in place of those that are not finite.
template <int Channels>
Lane<Channels> finite_or(Lane<Channels> texel, const Lane<Channels>& other) {
    if constexpr (Channels == 1) {
        return is_finite<1>(texel) ? texel : other;
    } else {
        for (int c = 0; c < Channels; ++c) {
            if (!is_finite<1>(texel[c])) texel[c] = other[c];
        }
        return texel;
    }
}

/// Interpolates from a to b. Between equal texels the result is exact, unlike a (1 - w) + b w.
template <typename LaneType>
LaneType mix_texels(LaneType a, LaneType b, float weight) {
    return a + (b - a) * weight;
}

/// Lookups in one level of a cube, read seamlessly (GL 4.6 section 8.14.2, "Seamless cube map
/// filtering"). `Cube` has a `size`, and inside(face, row, column) for texels of its faces.
template <typename Cube, int Channels>
struct SeamlessLookups {
    const Cube& cube() const { return static_cast<const Cube&>(*this); }

    bool contains(int index) const { return index >= 0 && index < cube().size; }

    /// Returns the texel of any row and column. Beyond an edge it is a texel of the neighbour face,
    /// as if the cube were unfolded; if both row and column are outside, it is the average of the
    /// three texels that meet in that corner.
    Lane<Channels> seamless(Face face, int row, int column) const {
        const int size = cube().size;
        const bool row_in = contains(row);
        const bool column_in = contains(column);
        if (row_in && column_in) return cube().inside(face, row, column);
        if (row_in || column_in) {
            const TexelPlace place = texel_beyond_edge(face, row, column, size);
            return cube().inside(place.face, place.row, place.column);
        }
        const int near_row = row < 0 ? 0 : size - 1;
        const int near_column = column < 0 ? 0 : size - 1;
        const int next_row = row < 0 ? -1 : size;
        const int next_column = column < 0 ? -1 : size;
        const Lane<Channels> own = cube().inside(face, near_row, near_column);
        const Lane<Channels> above = seamless(face, next_row, near_column);
        const Lane<Channels> beside = seamless(face, near_row, next_column);
        // A sum of differences: three equal texels give exactly the same fourth one.
        const Lane<Channels> average = own + ((above - own) + (beside - own)) / 3.0f;
        // A difference of infinities is NaN.
        return finite_or<Channels>(average, own / 3.0f + above / 3.0f + beside / 3.0f);
    }

    /// The bilinear lookup at column x and row y, from -1/2 to N - 1/2; texel centres lie at whole
    /// numbers.
    Lane<Channels> between(Face face, float x, float y) const {
        // x and y are at least -1/2: after adding 1, rounding towards 0 is rounding down.
        const int column = static_cast<int>(x + 1.0f) - 1;
        const int row = static_cast<int>(y + 1.0f) - 1;
        return between_faces(face, row, column, x - static_cast<float>(column),
                             y - static_cast<float>(row));
    }

    Lane<Channels> bilinear(Face face, float s, float t) const {
        const auto size = static_cast<float>(cube().size);
        return cube().between(face, s * size - 0.5f, t * size - 0.5f);
    }

    /// Like `between`, but a sum of weighted texels, for places where `between` gives NaN or
    /// infinity. A texel of weight 0 does not count, nor one whose weight may come from rounding
    /// errors of x or y alone.
    Lane<Channels> sum_between(Face face, float x, float y) const {
        const float error = std::max(1e-6f, static_cast<float>(cube().size) * 2.4e-7f);
        const auto rounded = [error](float weight) {
            return weight < error ? 0.0f : weight > 1.0f - error ? 1.0f : weight;
        };
        const int column = static_cast<int>(x + 1.0f) - 1;
        const int row = static_cast<int>(y + 1.0f) - 1;
        const float right = rounded(x - static_cast<float>(column));
        const float bottom = rounded(y - static_cast<float>(row));
        Lane<Channels> sum{};
        const auto add = [&](int at_row, int at_column, float weight) {
            if (weight > 0) sum += seamless(face, at_row, at_column) * weight;
        };
        add(row, column, (1.0f - bottom) * (1.0f - right));
        add(row, column + 1, (1.0f - bottom) * right);
        add(row + 1, column, bottom * (1.0f - right));
        add(row + 1, column + 1, bottom * right);
        return sum;
    }

    /// Like `bilinear`; see sum_between.
    Lane<Channels> sum_bilinear(Face face, float s, float t) const {
        return sum_between(face, s * static_cast<float>(cube().size) - 0.5f,
                           t * static_cast<float>(cube().size) - 0.5f);
    }

    [[gnu::noinline]] Lane<Channels> between_faces(Face face, int row, int column,
                                                   float right_weight, float bottom_weight) const {
        return mix_texels(
            mix_texels(seamless(face, row, column), seamless(face, row, column + 1), right_weight),
            mix_texels(seamless(face, row + 1, column), seamless(face, row + 1, column + 1),
                       right_weight),
            bottom_weight);
    }
};

/// A level whose type and number of channels are known to the compiler.
template <typename Pixel, int Channels>
struct CubeTexels : SeamlessLookups<CubeTexels<Pixel, Channels>, Channels> {
    const Pixel* pixels;  ///< [6][size][size][Channels]
    int size;

    CubeTexels(const Pixel* first, int n) : pixels(first), size(n) {}

    const Pixel* at(Face face, int row, int column) const {
        const auto n = static_cast<std::size_t>(size);
        return pixels + ((face_index(face) * n + static_cast<std::size_t>(row)) * n +
                         static_cast<std::size_t>(column)) *
                            Channels;
    }

    Lane<Channels> inside(Face face, int row, int column) const {
        return load_texel<Channels>(at(face, row, column));
    }

    /// As SeamlessLookups::between, faster where the face holds all four texels.
    Lane<Channels> between(Face face, float x, float y) const {
        // x and y are at least -1/2: after adding 1, rounding towards 0 is rounding down.
        const int column = static_cast<int>(x + 1.0f) - 1;
        const int row = static_cast<int>(y + 1.0f) - 1;
        const float right_weight = x - static_cast<float>(column);
        const float bottom_weight = y - static_cast<float>(row);
        // The last column is excluded: there may be no memory behind its last texel.
        if (column >= 0 && row >= 0 && column + 2 < size && row + 1 < size) {
            const auto load = [](const Pixel* from) {
                return load_texel_before_another<Channels>(from);
            };
            const Pixel* upper = at(face, row, column);
            const Pixel* lower = upper + static_cast<std::size_t>(size) * Channels;
            return mix_texels(mix_texels(load(upper), load(upper + Channels), right_weight),
                              mix_texels(load(lower), load(lower + Channels), right_weight),
                              bottom_weight);
        }
        return this->between_faces(face, row, column, right_weight, bottom_weight);
    }
};

/// A level of any type and number of channels, which the slow paths read. Lanes beyond the channels
/// are 0.
struct CubePixels : SeamlessLookups<CubePixels, 4> {
    const std::byte* pixels;  ///< [6][size][size][channels]
    int size;
    int channels;
    DType dtype;

    CubePixels(const std::byte* first, int n, int channel_count, DType type)
        : pixels(first), size(n), channels(channel_count), dtype(type) {}

    std::size_t texel_bytes() const {
        return static_cast<std::size_t>(channels) * dtype_size(dtype);
    }

    const std::byte* at(Face face, int row, int column) const {
        const auto n = static_cast<std::size_t>(size);
        return pixels + ((face_index(face) * n + static_cast<std::size_t>(row)) * n +
                         static_cast<std::size_t>(column)) *
                            texel_bytes();
    }

    Float4 inside(Face face, int row, int column) const {
        float lanes[4] = {0, 0, 0, 0};
        pixels_to_floats(dtype, at(face, row, column), static_cast<std::size_t>(channels), lanes);
        return Float4{lanes[0], lanes[1], lanes[2], lanes[3]};
    }
};

/// Calls body(std::integral_constant<int, C>), where C is `channels`.
template <typename Body>
decltype(auto) with_channels(int channels, const Body& body) {
    if (channels == 1) return body(std::integral_constant<int, 1>{});
    if (channels == 3) return body(std::integral_constant<int, 3>{});
    if (channels == 4) return body(std::integral_constant<int, 4>{});
    throw std::invalid_argument("channels: expected 1, 3 or 4, got " + std::to_string(channels));
}

/// Calls body(const Pixel*), where Pixel is the type that `dtype` names.
template <typename Body>
decltype(auto) with_pixels(DType dtype, const std::byte* pixels, const Body& body) {
    if (dtype == DType::uint8) return body(reinterpret_cast<const std::uint8_t*>(pixels));
    if (dtype == DType::float16) return body(reinterpret_cast<const std::uint16_t*>(pixels));
    return body(reinterpret_cast<const float*>(pixels));
}

}  // namespace cubecam
