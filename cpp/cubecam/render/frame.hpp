#pragma once

#include "cubecam/image/format.hpp"
#include "cubecam/image/pixels.hpp"

#include <cstdint>

namespace cubecam {

/// A rendered picture, row 0 on top. What was not asked for is empty.
struct Frame {
    int width = 0;
    int height = 0;
    Format format = Format::rgba8;
    PixelBuffer color;        ///< [height][width][4]; empty where there is no colour buffer
    Buffer<float> distance;   ///< [height][width] world units, +inf: background
    Buffer<float> z;          ///< [height][width] world units, +inf: background
    Buffer<float> normal;     ///< [height][width][3] world, 0: background
    Buffer<float> position;   ///< [height][width][3] world, NaN: background
    Buffer<std::int32_t> id;  ///< [height][width] node ids, 0: background
    Buffer<float> depth;      ///< [height][width] window-space z, 0 near to 1 far and background
    Buffer<std::uint8_t> stencil;  ///< [height][width]
};

}  // namespace cubecam
