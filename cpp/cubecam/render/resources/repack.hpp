#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cubecam {

/// Conversions of a driver's texels to a caller's. The loops have no branch and no table, so that a
/// compiler can use SIMD.

/// Copies the first three of every four floats. `to` must not overlap `from`.
inline void drop_fourth(const float* from, std::size_t texels, float* to) {
    if (texels == 0) return;
    // Each step writes four floats; the next step overwrites the last of them.
    for (std::size_t i = 0; i + 1 < texels; ++i) {
        std::memcpy(to + 3 * i, from + 4 * i, 4 * sizeof(float));
    }
    std::memcpy(to + 3 * (texels - 1), from + 4 * (texels - 1), 3 * sizeof(float));
}

/// Converts GL_UNSIGNED_SHORT_5_6_5 to RGBA8 with alpha 255: each channel v / (2^bits - 1) (GL 4.6,
/// equation 2.1), times 255, rounded to nearest. The products equal (255 v + most / 2) / most for
/// every v, where most is 2^bits - 1.
inline void widen_565(const std::uint16_t* from, std::size_t texels, std::uint32_t* to) {
    for (std::size_t i = 0; i < texels; ++i) {
        const std::uint32_t p = from[i];
        const std::uint32_t red = ((p >> 11) * 527 + 23) >> 6;
        const std::uint32_t green = ((p >> 5 & 63) * 259 + 33) >> 6;
        const std::uint32_t blue = ((p & 31) * 527 + 23) >> 6;
        to[i] = red | green << 8 | blue << 16 | 0xFF000000U;
    }
}

/// Reverses a stored depth of floats in place: 0 is near and 1 is far afterwards. Where nothing was
/// drawn the result is 1, whatever the clear value is.
inline void turn_depth(float* values, std::size_t count, float clear) {
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = values[i] == clear ? 1.0F : 1.0F - values[i];
    }
}

/// Does the same for whole numbers of `bits` bits, which GL has widened to 32 bits. The function
/// subtracts whole numbers, so a fixed-point depth loses no precision. It works in place: both
/// types have four bytes.
inline void turn_fixed_depth(std::byte* values, std::size_t count, int bits, float clear) {
    const std::uint32_t most = (std::uint32_t{1} << bits) - 1;
    const std::uint32_t untouched = clear == 0.0F ? 0 : most;
    for (std::size_t i = 0; i < count; ++i) {
        std::uint32_t stored = 0;
        std::memcpy(&stored, values + 4 * i, 4);
        stored >>= 32 - bits;
        if (stored == untouched) stored = 0;
        const auto depth = static_cast<float>(static_cast<double>(most - stored) / most);
        std::memcpy(values + 4 * i, &depth, 4);
    }
}

}  // namespace cubecam
