/// Types of pixels and their conversions. Numbers are linear and raw: as a float, a uint8 is
/// value/255, as in GL's normalised formats.
#pragma once

#include "cubecam/core/memory.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace cubecam {

enum class DType { uint8, float16, float32 };  ///< float16 is kept as the bits of binary16

constexpr std::size_t dtype_size(DType dtype) {
    return dtype == DType::uint8 ? 1 : dtype == DType::float16 ? 2 : 4;
}

constexpr const char* dtype_name(DType dtype) {
    return dtype == DType::uint8 ? "uint8" : dtype == DType::float16 ? "float16" : "float32";
}

/// An allocator that leaves trivial elements uninitialized. A plain vector would set them to zero
/// on one thread before all workers fill it, which takes a third of the time of small conversions.
/// What the memory cannot hold is refused with OutOfMemory, whatever work asks for it.
template <typename T>
struct UninitializedAllocator : std::allocator<T> {
    template <typename U>
    struct rebind {
        using other = UninitializedAllocator<U>;
    };
    UninitializedAllocator() = default;
    template <typename U>
    UninitializedAllocator(const UninitializedAllocator<U>&) noexcept {}
    T* allocate(std::size_t count) {
        if (count <= static_cast<std::size_t>(-1) / sizeof(T)) check_room(count * sizeof(T));
        T* memory = std::allocator<T>::allocate(count);
        if (count >= large_allocation / sizeof(T)) advise_large_pages(memory, count * sizeof(T));
        return memory;
    }
    template <typename U>
    void construct(U* at) noexcept {
        // GCC sets even `new Float4` to 0, so trivial elements are not constructed at all.
        if constexpr (!std::is_trivially_default_constructible_v<U>) {
            ::new (static_cast<void*>(at)) U;
        }
    }
    template <typename U, typename... Args>
    void construct(U* at, Args&&... args) {
        ::new (static_cast<void*>(at)) U(std::forward<Args>(args)...);
    }
};

/// The vector type of raw pixels and of arrays of floats or ids. New elements are NOT zero.
template <typename T>
using Buffer = std::vector<T, UninitializedAllocator<T>>;
using PixelBuffer = Buffer<std::byte>;

/// binary16 to binary32, exact for every bit pattern (IEEE 754-2008; after F. Giesen, "half to
/// float done quic", 2012). The computation uses only normal floats, so flush-to-zero does no harm.
inline float half_to_float(std::uint16_t half) {
    constexpr std::uint32_t exponent_mask = 0x7c00u << 13;
    std::uint32_t bits = (half & 0x7fffu) << 13;
    const std::uint32_t exponent = bits & exponent_mask;
    bits += (127u - 15u) << 23;
    const std::uint32_t special = bits + ((128u - 16u) << 23);
    const float small = std::bit_cast<float>(bits + (1u << 23)) - std::bit_cast<float>(113u << 23);
    bits = exponent == exponent_mask ? special
           : exponent == 0           ? std::bit_cast<std::uint32_t>(small)
                                     : bits;
    return std::bit_cast<float>(bits | (half & 0x8000u) << 16);
}

/// binary32 to binary16, rounded to nearest, ties to even; 65520 and above give inf, NaN stays NaN.
inline std::uint16_t float_to_half(float value) {
    const std::uint32_t all = std::bit_cast<std::uint32_t>(value);
    const std::uint32_t sign = all & 0x80000000u;
    const std::uint32_t bits = all ^ sign;
    const std::uint32_t special = bits > 0x7f800000u ? 0x7e00u : 0x7c00u;
    // Adding this number lets the hardware round a denormal's bits into the low end.
    constexpr std::uint32_t magic = ((127u - 15u) + (23u - 10u) + 1u) << 23;
    const std::uint32_t small =
        std::bit_cast<std::uint32_t>(std::bit_cast<float>(bits) + std::bit_cast<float>(magic)) -
        magic;
    const std::uint32_t normal = (bits + ((15u - 127u) << 23) + 0xfffu + ((bits >> 13) & 1u)) >> 13;
    const std::uint32_t half = bits >= ((127u + 16u) << 23)  ? special
                               : bits < ((127u - 14u) << 23) ? small
                                                             : normal;
    return static_cast<std::uint16_t>(half | (sign >> 16));
}

/// Rounds to nearest after clamping to 0..1; NaN gives 0 (GL 4.6 section 2.3.5.2).
inline std::uint8_t float_to_unorm8(float value) {
    const float clamped = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
    return static_cast<std::uint8_t>(clamped * 255.0f + 0.5f);
}

inline float unorm8_to_float(std::uint8_t value) { return static_cast<float>(value) / 255.0f; }

/// Converts `count` values from `pixels` to floats. `pixels` has the alignment of its type: 1, 2 or
/// 4 bytes.
inline void pixels_to_floats(DType dtype, const std::byte* pixels, std::size_t count, float* to) {
    if (dtype == DType::uint8) {
        const auto* from = reinterpret_cast<const std::uint8_t*>(pixels);
        for (std::size_t i = 0; i < count; ++i) to[i] = unorm8_to_float(from[i]);
    } else if (dtype == DType::float16) {
        const auto* from = reinterpret_cast<const std::uint16_t*>(pixels);
        for (std::size_t i = 0; i < count; ++i) to[i] = half_to_float(from[i]);
    } else {
        const auto* from = reinterpret_cast<const float*>(pixels);
        for (std::size_t i = 0; i < count; ++i) to[i] = from[i];
    }
}

/// Converts `count` floats to pixels of a type; the inverse of pixels_to_floats except for
/// rounding.
inline void floats_to_pixels(DType dtype, const float* from, std::size_t count, std::byte* pixels) {
    if (dtype == DType::uint8) {
        auto* to = reinterpret_cast<std::uint8_t*>(pixels);
        for (std::size_t i = 0; i < count; ++i) to[i] = float_to_unorm8(from[i]);
    } else if (dtype == DType::float16) {
        auto* to = reinterpret_cast<std::uint16_t*>(pixels);
        for (std::size_t i = 0; i < count; ++i) to[i] = float_to_half(from[i]);
    } else {
        auto* to = reinterpret_cast<float*>(pixels);
        for (std::size_t i = 0; i < count; ++i) to[i] = from[i];
    }
}

}  // namespace cubecam
