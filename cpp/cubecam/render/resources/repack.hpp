#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace cubecam {

/// What a driver gives to what a caller gets, texel by texel. Both loops have no branch and no
/// table, so that a compiler can make them one instruction of many lanes.

/// The first three of every four floats. `to` must not overlap `from`.
inline void drop_fourth(const float* from, std::size_t texels, float* to) {
    if (texels == 0) return;
    // Four are written, of which the next texel overwrites the last.
    for (std::size_t i = 0; i + 1 < texels; ++i) {
        std::memcpy(to + 3 * i, from + 4 * i, 4 * sizeof(float));
    }
    std::memcpy(to + 3 * (texels - 1), from + 4 * (texels - 1), 3 * sizeof(float));
}

/// GL_UNSIGNED_SHORT_5_6_5 as RGBA8, alpha 255, each channel to nearest: v / (2^bits - 1) as a
/// number of 255 (GL 4.6, equation 2.1). The products give (255 v + most / 2) / most for every v.
inline void widen_565(const std::uint16_t* from, std::size_t texels, std::uint32_t* to) {
    for (std::size_t i = 0; i < texels; ++i) {
        const std::uint32_t p = from[i];
        const std::uint32_t red = ((p >> 11) * 527 + 23) >> 6;
        const std::uint32_t green = ((p >> 5 & 63) * 259 + 33) >> 6;
        const std::uint32_t blue = ((p & 31) * 527 + 23) >> 6;
        to[i] = red | green << 8 | blue << 16 | 0xFF000000U;
    }
}

/// A reversed depth of floats turned round in place: 0 near, 1 far. Where nothing was drawn it
/// becomes 1, whatever the buffer was cleared to.
inline void turn_depth(float* values, std::size_t count, float clear) {
    for (std::size_t i = 0; i < count; ++i) {
        values[i] = values[i] == clear ? 1.0F : 1.0F - values[i];
    }
}

/// The same of whole numbers of `bits` bits, which GL widened to 32. Turned round as the whole
/// number that it is, a fixed-point depth loses nothing. In place: both types have four bytes.
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
