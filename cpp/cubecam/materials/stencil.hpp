#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace cubecam {

/// How `reference & read_mask` must compare with `stored & read_mask`, in that order, for a pixel
/// to be drawn.
enum class StencilFunc : std::uint8_t {
    never,
    less,
    equal,
    lequal,
    greater,
    notequal,
    gequal,
    always
};

/// How the stored number changes. incr and decr stop at 255 and 0, incr_wrap and decr_wrap wrap
/// around.
enum class StencilOp : std::uint8_t {
    keep,
    zero,
    replace,  ///< the reference is stored
    incr,
    incr_wrap,
    decr,
    decr_wrap,
    invert
};

/// In the order of the enums.
inline constexpr std::array<std::string_view, 8> stencil_func_names = {
    "never", "less", "equal", "lequal", "greater", "notequal", "gequal", "always"};
inline constexpr std::array<std::string_view, 8> stencil_op_names = {
    "keep", "zero", "replace", "incr", "incr_wrap", "decr", "decr_wrap", "invert"};

/// A stencil test, and how drawing changes the stencil buffer; front and back faces are treated
/// alike (OpenGL 4.6, section 17.3.3).
struct Stencil {
    StencilFunc func = StencilFunc::always;
    std::uint8_t reference = 0;
    std::uint8_t read_mask = 255;
    std::uint8_t write_mask = 255;  ///< bits that the operations may change
    StencilOp fail = StencilOp::keep;
    StencilOp depth_fail = StencilOp::keep;
    StencilOp depth_pass = StencilOp::keep;  ///< also without a depth test

    bool operator==(const Stencil&) const = default;
};

/// Both functions throw std::invalid_argument "NAME: expected ..., got ..." for an unknown word.
StencilFunc parse_stencil_func(std::string_view word, std::string_view name);
StencilOp parse_stencil_op(std::string_view word, std::string_view name);
std::string_view to_string(StencilFunc func);
std::string_view to_string(StencilOp op);

}  // namespace cubecam
