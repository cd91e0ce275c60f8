#pragma once

#include "cubecam/core/parse_name.hpp"
#include "cubecam/image/pixels.hpp"

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace cubecam {

/// Colour format of a frame, a capture or a probe: four channels of 8-bit unorm, half or float, or
/// GL_RGB565: 5, 6 and 5 bits without alpha, read as rgba8.
enum class Format : std::uint8_t { rgba8, rgba16f, rgba32f, rgb565 };

inline constexpr NameTable<Format, 4> format_names{{{"rgba8", Format::rgba8},
                                                    {"rgba16f", Format::rgba16f},
                                                    {"rgba32f", Format::rgba32f},
                                                    {"rgb565", Format::rgb565}}};

/// @throws std::invalid_argument for any other name.
Format parse_format(std::string_view name);
std::string_view to_string(Format format);

/// The type of one channel in the array that a picture of this format is read into.
constexpr DType dtype_of(Format format) {
    switch (format) {
        case Format::rgba8: return DType::uint8;
        case Format::rgba16f: return DType::float16;
        case Format::rgba32f: return DType::float32;
        case Format::rgb565: return DType::uint8;
    }
    return DType::float32;
}

/// The bytes of a texel on the GPU.
constexpr std::size_t texel_size(Format format) {
    return format == Format::rgb565 ? 2 : 4 * dtype_size(dtype_of(format));
}

}  // namespace cubecam
