/// What cubes made of photographs do with infinite numbers. Only the .cpp files of cubemap/ include
/// this header.
#pragma once

#include "cubecam/cubemap/cube_texels.hpp"
#include "cubecam/image/pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace cubecam {

/// Returns a copy of a picture [...][width][channels] in which each inf is replaced by the largest
/// finite number of the picture, at least that of half floats: a filter would compute inf - inf,
/// which is NaN. It is called only after a result was NaN, since most pictures have no inf.
template <typename Pixel>
Buffer<float> without_infinities(const Pixel* pixels, std::size_t values, int picture_width,
                                 int picture_channels) {
    Buffer<float> finite(values);
    float largest = 65504.0f;
    for (std::size_t i = 0; i < values; ++i) {
        const float value = finite[i] = to_float(pixels[i]);
        if (std::isnan(value)) {
            const auto channels = static_cast<std::size_t>(picture_channels);
            const auto row = channels * static_cast<std::size_t>(picture_width);
            throw std::invalid_argument(
                "image: expected no NaN, got nan at [" + std::to_string(i / row) + ", " +
                std::to_string(i % row / channels) + ", " + std::to_string(i % channels) + "]");
        }
        if (!std::isinf(value)) largest = std::max(largest, std::abs(value));
    }
    for (float& value : finite) {
        if (std::isinf(value)) value = std::copysign(largest, value);
    }
    return finite;
}

}  // namespace cubecam
