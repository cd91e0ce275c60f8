/// The filter that all resampling uses: the average over a box along one axis. Only the .cpp files
/// of cubemap/ include this header.
#pragma once

#include "cubecam/cubemap/cube_texels.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

namespace cubecam {

/// The width of a box in texels, at least 1, and its inverse.
struct BoxWidth {
    double texels;
    double inverse;

    explicit BoxWidth(double wide) : texels(std::max(wide, 1.0)), inverse(1 / texels) {}
    BoxWidth(double wide, double one_by_wide)
        : texels(std::max(wide, 1.0)), inverse(std::min(one_by_wide, 1.0)) {}
};

/// How many texels a box covers: linear: two (width 1, which is linear interpolation); near: two or
/// three (width up to 2); far: any number. The loops are compiled for each value, since the
/// processor would mispredict a branch between them at every other texel.
enum class Reach : std::uint8_t { linear, near, far };

inline Reach reach_of(double texels) {
    return texels <= 1 ? Reach::linear : texels <= 2 ? Reach::near : Reach::far;
}

/// Calls body(std::integral_constant<Reach, reach>).
template <typename Body>
decltype(auto) with_reach(Reach reach, const Body& body) {
    if (reach == Reach::linear) return body(std::integral_constant<Reach, Reach::linear>{});
    if (reach == Reach::near) return body(std::integral_constant<Reach, Reach::near>{});
    return body(std::integral_constant<Reach, Reach::far>{});
}

/// A box over texels first ... first + inner + 1. The weights add up to 1. If inner is 0, the
/// second texel has the weight `near`; otherwise each inner texel has the weight `near` and the
/// last one has the weight `last`.
struct BoxTap {
    std::int32_t first;
    std::int32_t inner;
    float near;
    float last;

    std::int32_t end() const { return first + inner + 2; }
};

/// Like std::floor, for numbers that an int can hold; without SSE 4.1, std::floor is a call into
/// the library.
inline std::int32_t floor_to_int(double value) {
    const auto towards_zero = static_cast<std::int32_t>(value);
    return towards_zero - (value < towards_zero ? 1 : 0);
}

/// The box round `center`, where texel i covers i - 1/2 to i + 1/2. At width 1 the weights of its
/// two texels are those of linear interpolation.
inline BoxTap box_tap(double center, const BoxWidth& width) {
    // A border this close to a texel's border counts as that border, so that a rounding error does
    // not add a texel.
    constexpr double snap = 1e-7;
    const double begin = center + 0.5 - width.texels / 2;
    const double end = center + 0.5 + width.texels / 2;
    const std::int32_t first = floor_to_int(begin + snap);
    const std::int32_t last = std::max(floor_to_int(end - snap), first + 1);
    const auto rest = static_cast<float>(std::max(end - last, 0.0) * width.inverse);
    const bool two = last == first + 1;
    return {first, last - first - 1, two ? rest : static_cast<float>(width.inverse),
            two ? 0.0f : rest};
}

/// Applies a tap to the texels that `texel(0)`, `texel(1)`, ... return, counted from tap.first. It
/// sums differences, so that equal texels give exactly that texel; long boxes are summed in double.
template <Reach reach, typename Texels>
[[gnu::always_inline]] inline auto apply_tap(const BoxTap& tap, const Texels& texel) {
    const auto first = texel(0);
    if constexpr (reach == Reach::linear) {
        return first + (texel(1) - first) * tap.near;
    } else if constexpr (reach == Reach::near) {
        return first + ((texel(1) - first) * tap.near + (texel(tap.inner + 1) - first) * tap.last);
    } else {
        using Texel = std::remove_cvref_t<decltype(first)>;
        Texel sum = texel(1) - first;
        if (tap.inner == 0) return first + sum * tap.near;
        const Texel end = (texel(tap.inner + 1) - first) * tap.last;
        if (tap.inner <= 8) {
            for (int i = 2; i <= tap.inner; ++i) sum += texel(i) - first;
            return first + (sum * tap.near + end);
        }
        if constexpr (std::is_same_v<Texel, float>) {
            double total = 0;
            for (int i = 1; i <= tap.inner; ++i) {
                total += static_cast<double>(texel(i)) - static_cast<double>(first);
            }
            sum = static_cast<float>(total * static_cast<double>(tap.near));
        } else {
            typedef double Double4 __attribute__((vector_size(32)));
            const Double4 wide_first = __builtin_convertvector(first, Double4);
            Double4 total = {0, 0, 0, 0};
            for (int i = 1; i <= tap.inner; ++i) {
                total += __builtin_convertvector(texel(i), Double4) - wide_first;
            }
            sum = __builtin_convertvector(total * static_cast<double>(tap.near), Float4);
        }
        return first + (sum + end);
    }
}

/// Like apply_tap, but a sum of weighted texels, for boxes whose result apply_tap gives as NaN or
/// infinite. A texel of weight 0 does not count, so infinity beside a box gives no NaN; within a
/// box it gives infinity. A weight that may come from rounding errors alone counts as 0.
template <typename Texels>
auto sum_tap(const BoxTap& tap, const Texels& texel) {
    const auto near = static_cast<double>(tap.near);
    const auto last = static_cast<double>(tap.last);
    std::remove_cvref_t<decltype(texel(0))> sum{};
    // `share` is the weight of a texel that lies in the box as a whole.
    const auto add = [&](int index, double weight, double share) {
        if (weight > share * (1e-6 + 1.2e-7 * tap.inner)) {
            sum += texel(index) * static_cast<float>(weight);
        }
    };
    if (tap.inner == 0) {
        add(0, 1 - near, 1);
        add(1, near, 1);
        return sum;
    }
    add(0, 1 - tap.inner * near - last, near);
    for (int i = 1; i <= tap.inner; ++i) add(i, near, near);
    add(tap.inner + 1, last, near);
    return sum;
}

}  // namespace cubecam
