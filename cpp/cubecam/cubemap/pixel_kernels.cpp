#include "cubecam/cubemap/pixel_kernels.hpp"

#include "cubecam/cubemap/clones.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

namespace cubecam {

namespace {

constexpr std::size_t piece = 64;  ///< texels that are converted at a time

[[gnu::always_inline]] inline bool finite(const float* numbers, std::size_t count) {
    constexpr std::uint32_t exponent = 0x7f800000u;
    std::uint32_t bad = 0;  // whole numbers and no branch, so that the compiler uses SIMD
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t bits = std::bit_cast<std::uint32_t>(numbers[i]) & exponent;
        bad |= bits == exponent ? 1u : 0u;
    }
    return bad == 0;
}

// Plain loops, which the compiler turns into SIMD for each processor: of vector types that are
// wider than the processor's, GCC makes scalar code.

/// value / 255 as the division rounds it, without a division: 1/255 has parts of 9 and 24 bits. The
/// product with the first part has no rounding error, and the sum is rounded once. `count` is a
/// multiple of byte_block.
constexpr std::size_t byte_block = 32;
[[gnu::always_inline]] inline void byte_blocks(const std::uint8_t* from, std::size_t count,
                                               float* __restrict to) {
    constexpr float high = 0x1.01p-8f;
    constexpr auto low = static_cast<float>(1.0 / 255.0 - 0x1.01p-8);
    for (std::size_t i = 0; i < count / byte_block * byte_block; ++i) {
        const auto value = static_cast<float>(static_cast<std::int32_t>(from[i]));
        to[i] = value * high + value * low;
    }
}

[[gnu::always_inline]] inline void bytes_to_floats(const std::uint8_t* from, std::size_t count,
                                                   float* to) {
    const std::size_t whole = count / byte_block * byte_block;
    byte_blocks(from, whole, to);
    if (whole == count) return;
    std::uint8_t rest[byte_block] = {};
    float made[byte_block];
    std::memcpy(rest, from + whole, count - whole);
    byte_blocks(rest, byte_block, made);
    std::memcpy(to + whole, made, (count - whole) * sizeof(float));
}

[[gnu::always_inline]] inline void halves_to_floats(const std::uint16_t* from, std::size_t count,
                                                    float* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = half_to_float(from[i]);
}

[[gnu::always_inline]] inline void floats_to_bytes(const float* from, std::size_t count,
                                                   std::uint8_t* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) {
        const float positive = from[i] > 0.0f ? from[i] : 0.0f;  // NaN gives 0
        const float clamped = positive < 1.0f ? positive : 1.0f;
        to[i] = static_cast<std::uint8_t>(static_cast<std::int32_t>(clamped * 255.0f + 0.5f));
    }
}

[[gnu::always_inline]] inline void floats_to_halves(const float* from, std::size_t count,
                                                    std::uint16_t* __restrict to) {
    for (std::size_t i = 0; i < count; ++i) to[i] = float_to_half(from[i]);
}

/// Writes the first lanes of texels as floats in order of memory.
template <int channels>
[[gnu::always_inline]] inline void pack(const Float4* from, std::ptrdiff_t count, int step,
                                        float* to) {
    if (step < 0) from += count - 1;
    constexpr std::size_t bytes = channels * sizeof(float);
    // All but the last may write over the beginning of the next one: a whole register is stored.
    for (std::ptrdiff_t i = 1; i < count; ++i, from += step, to += channels) {
        std::memcpy(to, from, channels == 3 ? sizeof *from : bytes);
    }
    std::memcpy(to, from, bytes);
}

template <int channels>
[[gnu::always_inline]] inline void store(const Float4* from, std::size_t count, int step,
                                         DType dtype, std::byte* to) {
    if (dtype == DType::float32) {
        float* first = reinterpret_cast<float*>(to);
        if (step < 0) first -= (count - 1) * channels;
        pack<channels>(from, static_cast<std::ptrdiff_t>(count), step, first);
    } else {
        alignas(64) float line[piece * channels];
        const std::size_t texel = channels * dtype_size(dtype);
        for (std::size_t begin = 0; begin < count; begin += piece) {
            const std::size_t length = std::min(piece, count - begin);
            pack<channels>(from + begin, static_cast<std::ptrdiff_t>(length), step, line);
            std::byte* const first =
                step > 0 ? to + begin * texel : to - (begin + length - 1) * texel;
            if (dtype == DType::uint8) {
                floats_to_bytes(line, length * channels, reinterpret_cast<std::uint8_t*>(first));
            } else {
                floats_to_halves(line, length * channels, reinterpret_cast<std::uint16_t*>(first));
            }
        }
    }
}

}  // namespace

CUBECAM_CLONES bool all_finite_row(const float* numbers, std::size_t count) {
    return finite(numbers, count);
}

CUBECAM_CLONES bool row_to_floats(DType dtype, const std::byte* pixels, std::size_t count,
                                  float* to) {
    if (dtype == DType::uint8) {
        bytes_to_floats(reinterpret_cast<const std::uint8_t*>(pixels), count, to);
        return true;
    }
    if (dtype == DType::float16) {
        halves_to_floats(reinterpret_cast<const std::uint16_t*>(pixels), count, to);
    } else {
        std::memcpy(to, pixels, count * sizeof(float));
    }
    return finite(to, count);
}

CUBECAM_CLONES bool all_finite_texels(const Float4* texels, std::size_t count, int channels) {
    constexpr std::size_t chains = 4;
    Float4 sums[chains] = {};  // of x - x, which is 0 or NaN
    std::size_t i = 0;
    for (; i + chains <= count; i += chains) {
        for (std::size_t k = 0; k < chains; ++k) sums[k] += texels[i + k] - texels[i + k];
    }
    for (; i < count; ++i) sums[0] += texels[i] - texels[i];
    const Float4 sum = (sums[0] + sums[1]) + (sums[2] + sums[3]);
    bool good = true;
    for (int c = 0; c < channels; ++c) good &= sum[c] == 0.0f;
    return good;
}

CUBECAM_CLONES void store_texels(const Float4* from, std::size_t count, int channels, int step,
                                 DType dtype, std::byte* to) {
    switch (channels) {
        case 1: return store<1>(from, count, step, dtype, to);
        case 2: return store<2>(from, count, step, dtype, to);
        case 3: return store<3>(from, count, step, dtype, to);
        default: return store<4>(from, count, step, dtype, to);
    }
}

}  // namespace cubecam
