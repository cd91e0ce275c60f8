#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cubecam {

/// How a surface's colour is combined with the colour already drawn: S is the surface's colour, D
/// the one already drawn, a is S's alpha.
enum class Blend : std::uint8_t {
    opaque,         ///< S, with alpha 1
    alpha,          ///< a S + (1 - a) D; alpha a + (1 - a) D
    alpha_keep,     ///< a S + (1 - a) D; alpha D
    additive,       ///< a S + D; alpha a + D (T. Porter and T. Duff's "plus")
    multiply,       ///< (1 - a + a S) D; alpha D
    premultiplied,  ///< S + (1 - a) D, for colours that are multiplied by their alpha already
    factors,        ///< by SurfaceOptions::blend_factors
};

/// In the order of Blend; "factors" has no name.
inline constexpr std::array<std::string_view, 6> blend_names = {
    "opaque", "alpha", "alpha_keep", "additive", "multiply", "premultiplied"};

/// @throws std::invalid_argument for any other name, and for "factors", which has no name.
Blend parse_blend(std::string_view name);
std::string_view to_string(Blend blend);

/// The factor of a colour or an alpha before it is blended (GL 4.5, table 17.2).
enum class BlendFactor : std::uint8_t {
    zero,
    one,
    src_color,
    one_minus_src_color,
    dst_color,
    one_minus_dst_color,
    src_alpha,
    one_minus_src_alpha,
    dst_alpha,
    one_minus_dst_alpha,
    src_alpha_saturate,
};

/// How the two products are combined (GL 4.5, table 17.1). min and max take S and D without
/// factors.
enum class BlendEquation : std::uint8_t { add, subtract, reverse_subtract, min, max };

/// In the order of the enums.
inline constexpr std::array<std::string_view, 11> blend_factor_names = {"zero",
                                                                        "one",
                                                                        "src_color",
                                                                        "one_minus_src_color",
                                                                        "dst_color",
                                                                        "one_minus_dst_color",
                                                                        "src_alpha",
                                                                        "one_minus_src_alpha",
                                                                        "dst_alpha",
                                                                        "one_minus_dst_alpha",
                                                                        "src_alpha_saturate"};
inline constexpr std::array<std::string_view, 5> blend_equation_names = {
    "add", "subtract", "reverse_subtract", "min", "max"};

/// `name` is the argument that has this word as its value. @throws std::invalid_argument for any
/// other word.
BlendFactor parse_blend_factor(std::string_view word, std::string_view name);
BlendEquation parse_blend_equation(std::string_view word);
std::string_view to_string(BlendFactor factor);
std::string_view to_string(BlendEquation equation);

/// Blending as in OpenGL: src * S and dst * D, combined by the equation.
struct BlendFactors {
    BlendFactor src = BlendFactor::one;
    BlendFactor dst = BlendFactor::zero;
    BlendFactor src_alpha = BlendFactor::one;
    BlendFactor dst_alpha = BlendFactor::zero;
    BlendEquation equation = BlendEquation::add;

    bool operator==(const BlendFactors&) const = default;
};

}  // namespace cubecam
