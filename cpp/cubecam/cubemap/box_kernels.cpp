#include "cubecam/cubemap/box_kernels.hpp"

#include <cstring>

// One object file holds both versions; the loader takes the one that the processor can run. This
// needs GCC, x86 and glibc; elsewhere there is only the plain version, with the same results bit
// for bit. (Sanitizers are not ready yet when the loader chooses.)
#if defined(__GNUC__) && !defined(__clang__) && defined(__x86_64__) && defined(__GLIBC__) &&       \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define CUBECAM_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define CUBECAM_CLONES
#endif

namespace cubecam {

namespace {

/// Two texels side by side. Functions take them by reference: without AVX, passing them by value
/// has no fixed ABI.
typedef float Float8 __attribute__((vector_size(32)));

[[gnu::always_inline]] inline void join(const Float4& a, const Float4& b, Float8& both) {
    both = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
}

[[gnu::always_inline]] inline void join(float a, float b, Float8& both) {
    join(Float4{a, a, a, a}, Float4{b, b, b, b}, both);
}

[[gnu::always_inline]] inline Float4 texel_at(const char* address) {
    Float4 texel;  // `address` is aligned for a float only
    std::memcpy(&texel, address, sizeof texel);
    return texel;
}

/// The weights of two taps.
struct Weights {
    Float8 near;
    Float8 last;

    [[gnu::always_inline]] Weights(const BoundTap& a, const BoundTap& b) {
        join(a.near_weight, b.near_weight, near);
        join(a.last_weight, b.last_weight, last);
    }
};

/// apply_tap's arithmetic on two texels.
template <bool near>
[[gnu::always_inline]] inline void weigh(const Float8& first, const Float8& second,
                                         const Float8& third, const Weights& weights,
                                         Float8& result) {
    if constexpr (near) {
        result = first + ((second - first) * weights.near + (third - first) * weights.last);
    } else {
        result = first + (second - first) * weights.near;
    }
}

template <bool near>
[[gnu::always_inline]] inline void pair_tap(const char* a, const char* b, std::ptrdiff_t step,
                                            std::ptrdiff_t last_a, std::ptrdiff_t last_b,
                                            const Weights& weights, Float8& result) {
    Float8 first;
    Float8 second;
    Float8 third;
    join(texel_at(a), texel_at(b), first);
    join(texel_at(a + step), texel_at(b + step), second);
    if constexpr (near) {
        join(texel_at(a + last_a), texel_at(b + last_b), third);
    } else {
        third = second;
    }
    weigh<near>(first, second, third, weights, result);
}

/// Calls body(i, j, result) for pairs of texels. If one texel is left at the end, the call has it
/// as both i and j.
template <typename Body>
[[gnu::always_inline]] inline void for_pairs(std::size_t count, Float4* to, const Body& body) {
    Float8 result;
    std::size_t i = 0;
    for (; i + 1 < count; i += 2) {
        body(i, i + 1, result);
        std::memcpy(static_cast<void*>(to + i), &result, sizeof result);
    }
    if (i < count) {
        body(i, i, result);
        std::memcpy(static_cast<void*>(to + i), &result, sizeof(Float4));
    }
}

template <bool near>
[[gnu::always_inline]] inline void filter(const void* base, std::ptrdiff_t step,
                                          const BoundTap* taps, std::size_t count, Float4* to) {
    const char* from = static_cast<const char*>(base);
    for_pairs(count, to,
              [=](std::size_t i, std::size_t j, Float8& result) __attribute__((always_inline)) {
                  const BoundTap& a = taps[i];
                  const BoundTap& b = taps[j];
                  pair_tap<near>(from + a.first, from + b.first, step, a.last, b.last,
                                 Weights(a, b), result);
              });
}

template <bool near>
[[gnu::always_inline]] inline void filter_boxes(const Float4* base, std::ptrdiff_t stride,
                                                const BoundTap* down, const BoundTap* across,
                                                std::size_t count, Float4* to) {
    const char* from = reinterpret_cast<const char*>(base);
    constexpr std::ptrdiff_t next = sizeof(Float4);
    for_pairs(count, to,
              [=](std::size_t i, std::size_t j, Float8& result) __attribute__((always_inline)) {
                  const char* a = from + down[i].first + across[i].first;
                  const char* b = from + down[j].first + across[j].first;
                  const std::ptrdiff_t last_a = across[i].last;
                  const std::ptrdiff_t last_b = across[j].last;
                  const Weights weights(across[i], across[j]);
                  Float8 first;
                  Float8 second;
                  Float8 third;
                  pair_tap<near>(a, b, next, last_a, last_b, weights, first);
                  pair_tap<near>(a + stride, b + stride, next, last_a, last_b, weights, second);
                  if constexpr (near) {
                      pair_tap<near>(a + down[i].last, b + down[j].last, next, last_a, last_b,
                                     weights, third);
                  } else {
                      third = second;
                  }
                  weigh<near>(first, second, third, Weights(down[i], down[j]), result);
              });
}

}  // namespace

CUBECAM_CLONES void filter_linear(const void* base, std::ptrdiff_t step, const BoundTap* taps,
                                  std::size_t count, Float4* to) {
    filter<false>(base, step, taps, count, to);
}

CUBECAM_CLONES void filter_near(const void* base, std::ptrdiff_t step, const BoundTap* taps,
                                std::size_t count, Float4* to) {
    filter<true>(base, step, taps, count, to);
}

CUBECAM_CLONES void filter_boxes_linear(const Float4* base, std::ptrdiff_t stride,
                                        const BoundTap* down, const BoundTap* across,
                                        std::size_t count, Float4* to) {
    filter_boxes<false>(base, stride, down, across, count, to);
}

CUBECAM_CLONES void filter_boxes_near(const Float4* base, std::ptrdiff_t stride,
                                      const BoundTap* down, const BoundTap* across,
                                      std::size_t count, Float4* to) {
    filter_boxes<true>(base, stride, down, across, count, to);
}

}  // namespace cubecam
