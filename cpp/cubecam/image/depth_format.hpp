#pragma once

#include "cubecam/core/parse_name.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cubecam {

/// The format of a picture's depth and stencil buffer, with OpenGL's names. Depth is reversed in
/// every format (docs/adr/0001).
enum class DepthFormat : std::uint8_t {
    none,  ///< neither depth nor stencil
    depth_component16,
    depth_component24,
    depth_component32f,
    depth24_stencil8,
    depth32f_stencil8,
    stencil_index8,  ///< a stencil without depth
};

inline constexpr NameTable<DepthFormat, 6> depth_format_names{
    {{"depth_component16", DepthFormat::depth_component16},
     {"depth_component24", DepthFormat::depth_component24},
     {"depth_component32f", DepthFormat::depth_component32f},
     {"depth24_stencil8", DepthFormat::depth24_stencil8},
     {"depth32f_stencil8", DepthFormat::depth32f_stencil8},
     {"stencil_index8", DepthFormat::stencil_index8}}};

/// @throws std::invalid_argument that lists the known names, for any other name; `none` has no
/// name.
DepthFormat parse_depth_format(std::string_view name);
/// Returns the name of a format, "none" for `none`.
std::string_view to_string(DepthFormat format);

constexpr bool has_depth(DepthFormat format) {
    return format != DepthFormat::none && format != DepthFormat::stencil_index8;
}

constexpr bool has_stencil(DepthFormat format) {
    return format == DepthFormat::depth24_stencil8 || format == DepthFormat::depth32f_stencil8 ||
           format == DepthFormat::stencil_index8;
}

/// The bits of a depth that is stored as a whole number, 0..2^bits - 1 for 0..1; 0 if the depth is
/// a float or does not exist.
constexpr int fixed_depth_bits(DepthFormat format) {
    switch (format) {
        case DepthFormat::depth_component16: return 16;
        case DepthFormat::depth_component24:
        case DepthFormat::depth24_stencil8: return 24;
        default: return 0;
    }
}

/// The bytes of a texel on the GPU, with the padding of drivers.
constexpr std::size_t texel_size(DepthFormat format) {
    switch (format) {
        case DepthFormat::none: return 0;
        case DepthFormat::stencil_index8: return 1;
        case DepthFormat::depth_component16: return 2;
        case DepthFormat::depth32f_stencil8: return 8;
        default: return 4;
    }
}

}  // namespace cubecam
