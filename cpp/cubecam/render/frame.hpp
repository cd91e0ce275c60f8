#pragma once

#include "cubecam/image/encoding.hpp"
#include "cubecam/image/format.hpp"
#include "cubecam/image/output_values.hpp"
#include "cubecam/image/pixels.hpp"

#include <memory>

namespace cubecam {

/// A rendered picture, row 0 on top.
struct Frame {
    int width = 0;
    int height = 0;
    Format format = Format::rgba8;
    Encoding encoding = Encoding::linear;
    bool tonemapped = false;  ///< a tone curve was applied, and must not be applied again
    std::shared_ptr<PixelBuffer> color;  ///< [height][width][4]; null without a colour buffer
    OutputList outputs;                  ///< [height][width][channels], those that were requested
};

}  // namespace cubecam
