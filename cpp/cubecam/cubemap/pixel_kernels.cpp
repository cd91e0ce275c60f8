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

/// Sixteen numbers. Functions take them by reference, as in box_kernels.cpp.
typedef float Floats __attribute__((vector_size(64)));
typedef std::uint32_t Words __attribute__((vector_size(64)));
typedef std::int32_t Ints __attribute__((vector_size(64)));
typedef std::uint16_t Halves __attribute__((vector_size(32)));
typedef std::uint8_t Bytes __attribute__((vector_size(16)));
constexpr std::size_t lane_count = 16;

/// As half_to_float.
[[gnu::always_inline]] inline void convert(const Halves& from, Floats& to) {
    constexpr std::uint32_t exponent_mask = 0x7c00u << 13;
    const Words half = __builtin_convertvector(from, Words);
    Words bits = (half & 0x7fffu) << 13;
    const Words exponent = bits & exponent_mask;
    bits += (127u - 15u) << 23;
    const Words special = bits + ((128u - 16u) << 23);
    const Floats small = reinterpret_cast<Floats>(bits + (1u << 23)) - 0x1p-14f;
    bits = exponent == exponent_mask ? special
           : exponent == 0           ? reinterpret_cast<Words>(small)
                                     : bits;
    to = reinterpret_cast<Floats>(bits | (half & 0x8000u) << 16);
}

/// As float_to_unorm8.
[[gnu::always_inline]] inline void convert(const Floats& from, Bytes& to) {
    const Floats positive = from > 0.0f ? from : Floats{};  // NaN gives 0
    const Floats one = Floats{} + 1.0f;
    const Floats clamped = positive < 1.0f ? positive : one;
    to = __builtin_convertvector(__builtin_convertvector(clamped * 255.0f + 0.5f, Ints), Bytes);
}

/// As float_to_half.
[[gnu::always_inline]] inline void convert(const Floats& from, Halves& to) {
    const Words all = reinterpret_cast<Words>(from);
    const Words sign = all & 0x80000000u;
    const Words bits = all ^ sign;
    const Words nan = Words{} + 0x7e00u;
    const Words infinity = Words{} + 0x7c00u;
    const Words special = bits > 0x7f800000u ? nan : infinity;
    const Words small = reinterpret_cast<Words>(reinterpret_cast<Floats>(bits) + 0.5f) -
                        std::bit_cast<std::uint32_t>(0.5f);
    const Words normal = (bits + ((15u - 127u) << 23) + 0xfffu + ((bits >> 13) & 1u)) >> 13;
    const Words half = bits >= ((127u + 16u) << 23)  ? special
                       : bits < ((127u - 14u) << 23) ? small
                                                     : normal;
    to = __builtin_convertvector(half | (sign >> 16), Halves);
}

template <typename From, typename To, typename Source, typename Target>
[[gnu::always_inline]] inline void convert_row(const Source* from, std::size_t count, Target* to) {
    static_assert(sizeof(From) == lane_count * sizeof(Source));
    static_assert(sizeof(To) == lane_count * sizeof(Target));
    From given{};
    To made;
    std::size_t i = 0;
    for (; i + lane_count <= count; i += lane_count) {
        std::memcpy(&given, from + i, sizeof given);
        convert(given, made);
        std::memcpy(to + i, &made, sizeof made);
    }
    if (i == count) return;
    std::memcpy(&given, from + i, (count - i) * sizeof(Source));
    convert(given, made);
    std::memcpy(to + i, &made, (count - i) * sizeof(Target));
}

/// value / 255 as the division rounds it, without a division: 1/255 has parts of 9 and 24 bits. The
/// product with the first part has no rounding error, and the sum is rounded once. `count` is a
/// multiple of byte_block. (A plain loop: of vector types GCC 12 makes scalar code here.)
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
                convert_row<Floats, Bytes>(line, length * channels,
                                           reinterpret_cast<std::uint8_t*>(first));
            } else {
                convert_row<Floats, Halves>(line, length * channels,
                                            reinterpret_cast<std::uint16_t*>(first));
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
        convert_row<Halves, Floats>(reinterpret_cast<const std::uint16_t*>(pixels), count, to);
    } else {
        std::memcpy(to, pixels, count * sizeof(float));
    }
    return finite(to, count);
}

CUBECAM_CLONES bool all_finite_texels(const Float4* texels, std::size_t count, int channels) {
    Floats sums[2] = {};  // of x - x, which is 0 or NaN
    std::size_t i = 0;
    for (; i + 8 <= count; i += 8) {
        for (std::size_t k = 0; k < 2; ++k) {
            Floats four;
            std::memcpy(&four, texels + i + 4 * k, sizeof four);
            sums[k] += four - four;
        }
    }
    Float4 sum = {};
    for (; i < count; ++i) sum += texels[i] - texels[i];
    const Floats both = sums[0] + sums[1];
    bool good = true;
    for (int c = 0; c < channels; ++c) {
        good &= sum[c] + both[c] + both[c + 4] + both[c + 8] + both[c + 12] == 0.0f;
    }
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
