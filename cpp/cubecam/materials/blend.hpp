#pragma once

#include <cstdint>
#include <string_view>

namespace cubecam {

/// How a surface's colour joins what is drawn already; S is the surface, D what is there, a is S's
/// alpha.
enum class Blend : std::uint8_t {
    opaque,         ///< S, with alpha 1
    alpha,          ///< a S + (1 - a) D; alpha a + (1 - a) D
    alpha_keep,     ///< a S + (1 - a) D; alpha D
    additive,       ///< a S + D; alpha a + D (T. Porter and T. Duff's "plus")
    multiply,       ///< (1 - a + a S) D; alpha D
    premultiplied,  ///< S + (1 - a) D, for colours that are multiplied by their alpha already
};

/// @throws std::invalid_argument for any other name.
Blend parse_blend(std::string_view name);
std::string_view to_string(Blend blend);

}  // namespace cubecam
