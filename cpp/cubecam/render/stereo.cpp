#include "cubecam/render/stereo.hpp"

#include "cubecam/core/interrupts.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {
namespace {

std::int64_t half_of(std::int64_t length, const char* name, StereoLayout layout) {
    if (length % 2 == 0) return length / 2;
    throw std::invalid_argument("size: expected an even " + std::string(name) + " for layout '" +
                                std::string(to_string(layout)) + "', got " +
                                std::to_string(length));
}

/// Puts the upper half of a picture to the left of its lower half.
void put_side_by_side(std::shared_ptr<PixelBuffer>& stacked, std::size_t rows) {
    if (stacked == nullptr) return;
    const std::size_t row = stacked->size() / (2 * rows);  // bytes of a row of one eye
    auto pair = std::make_shared<PixelBuffer>(stacked->size());
    for (std::size_t y = 0; y < rows; ++y) {
        poll_interrupts();
        for (std::size_t eye = 0; eye < 2; ++eye) {
            std::memcpy(pair->data() + (2 * y + eye) * row,
                        stacked->data() + (eye * rows + y) * row, row);
        }
    }
    stacked = std::move(pair);
}

template <class Value>
Value greater(Value a, Value b) {
    return a < b ? b : a;
}

std::uint16_t greater_half(std::uint16_t a, std::uint16_t b) {
    return half_to_float(a) < half_to_float(b) ? b : a;
}

/// Mixes red of the left eye with green and blue of the right one, and the greater alpha.
template <class Channel, class Greater>
PixelBuffer mix(const PixelBuffer& stacked, Greater&& most) {
    const std::size_t bytes = stacked.size() / 2;
    PixelBuffer mixed(bytes);
    const auto* left = reinterpret_cast<const Channel*>(stacked.data());
    const auto* right = reinterpret_cast<const Channel*>(stacked.data() + bytes);
    auto* to = reinterpret_cast<Channel*>(mixed.data());
    for (std::size_t i = 0; i < bytes / sizeof(Channel); i += 4) {
        poll_interrupts(i / 4);
        to[i] = left[i];
        to[i + 1] = right[i + 1];
        to[i + 2] = right[i + 2];
        to[i + 3] = most(left[i + 3], right[i + 3]);
    }
    return mixed;
}

PixelBuffer mix_eyes(const PixelBuffer& stacked, DType dtype) {
    switch (dtype) {
        case DType::uint8: return mix<std::uint8_t>(stacked, greater<std::uint8_t>);
        case DType::float16: return mix<std::uint16_t>(stacked, greater_half);
        case DType::float32: return mix<float>(stacked, greater<float>);
    }
    return {};
}

}  // namespace

FrameOptions eye_options(const FrameOptions& whole, StereoLayout layout) {
    FrameOptions eye = whole;
    switch (layout) {
        case StereoLayout::side_by_side: eye.width = half_of(whole.width, "width", layout); break;
        case StereoLayout::top_bottom: eye.height = half_of(whole.height, "height", layout); break;
        case StereoLayout::anaglyph:
            if (whole.outputs.any()) {
                throw std::invalid_argument("outputs: expected none for layout 'anaglyph', where "
                                            "two pictures share a pixel; render camera.left and "
                                            "camera.right, or choose another layout");
            }
            if (!whole.color) {
                throw std::invalid_argument(
                    "format: expected a colour for layout 'anaglyph', got None");
            }
            break;
    }
    return eye;
}

Frame combine_eyes(Frame stacked, StereoLayout layout) {
    if (layout == StereoLayout::top_bottom) return stacked;
    const int height = stacked.height / 2;
    Frame frame = std::move(stacked);
    frame.height = height;
    if (layout == StereoLayout::anaglyph) {
        frame.color = std::make_shared<PixelBuffer>(mix_eyes(*frame.color, dtype_of(frame.format)));
        return frame;
    }
    frame.width *= 2;
    const auto rows = static_cast<std::size_t>(height);
    put_side_by_side(frame.color, rows);
    for (OutputValues& output : frame.outputs) put_side_by_side(output.values, rows);
    return frame;
}

}  // namespace cubecam
