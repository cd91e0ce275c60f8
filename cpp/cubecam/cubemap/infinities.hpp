/// What cubes made of photographs do with infinite numbers. Only the .cpp files of cubemap/ include
/// this header.
#pragma once

#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/cubemap/pixel_kernels.hpp"
#include "cubecam/image/pixels.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cubecam {

/// Returns a copy of a picture in which each inf is replaced by the largest finite number of the
/// picture, at least that of half floats: a filter would compute inf - inf, which is NaN. It is
/// called only after such a number was found, since most pictures have none.
/// @param before  numbers of other pictures in front of this one
/// @throws FoundNan
inline Buffer<float> without_infinities(DType dtype, const std::byte* pixels, std::size_t values,
                                        std::size_t before) {
    Buffer<float> finite(values);
    row_to_floats(dtype, pixels, values, finite.data());
    float largest = 65504.0f;
    for (std::size_t i = 0; i < values; ++i) {
        if (std::isnan(finite[i])) throw FoundNan(before + i);
        if (!std::isinf(finite[i])) largest = std::max(largest, std::abs(finite[i]));
    }
    for (float& value : finite) {
        if (std::isinf(value)) value = std::copysign(largest, value);
    }
    return finite;
}

}  // namespace cubecam
