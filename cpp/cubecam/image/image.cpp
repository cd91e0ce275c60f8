#include "cubecam/image/image.hpp"

#include "cubecam/core/parse_name.hpp"
#include "cubecam/core/revision.hpp"

#include <cstring>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

template <class Channel>
Channel channel_at(const std::byte* pixels, std::size_t index) {
    Channel value;
    std::memcpy(&value, pixels + index * sizeof(Channel), sizeof(Channel));
    return value;
}

bool below_one(DType dtype, const std::byte* pixels, std::size_t index) {
    switch (dtype) {
        case DType::uint8: return channel_at<std::uint8_t>(pixels, index) < 255;
        case DType::float16: return half_to_float(channel_at<std::uint16_t>(pixels, index)) < 1.0F;
        case DType::float32: return channel_at<float>(pixels, index) < 1.0F;
    }
    return false;
}

bool any_alpha_below_one(DType dtype, const PixelBuffer& pixels) {
    const std::size_t count = pixels.size() / dtype_size(dtype);
    for (std::size_t alpha = 3; alpha < count; alpha += 4) {
        if (below_one(dtype, pixels.data(), alpha)) return true;
    }
    return false;
}

}  // namespace

Wrap parse_wrap(std::string_view name) {
    const std::size_t place = place_of_name(wrap_names, name);
    if (place < wrap_names.size()) return wrap_names[place].second;
    throw std::invalid_argument("expected wrap " + quoted_names(wrap_names) + ", got '" +
                                shortened(name) + "'");
}

std::string_view to_string(Wrap wrap) { return wrap_names[static_cast<std::size_t>(wrap)].first; }

Image::Image(Pixels pixels, int width, int height, int channels, DType dtype,
             const Sampler& sampler, Encoding encoding)
    : pixels_(std::move(pixels)), width_(width), height_(height), channels_(channels),
      dtype_(dtype), sampler_(sampler), encoding_(encoding), translucent_(false),
      revision_(next_revision()) {
    const std::string shape = "(" + std::to_string(height) + ", " + std::to_string(width) + ", " +
                              std::to_string(channels) + ")";
    if (width < 1 || height < 1) {
        throw std::invalid_argument("expected an image of at least one pixel, got shape " + shape);
    }
    if (channels != 1 && channels != 3 && channels != 4) {
        throw std::invalid_argument("expected an image of 1, 3 or 4 channels, got shape " + shape);
    }
    const std::size_t bytes = static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
                              static_cast<std::size_t>(channels) * dtype_size(dtype);
    if (!pixels_ || pixels_->size() != bytes) {
        throw std::invalid_argument("expected " + std::to_string(bytes) + " bytes for shape " +
                                    shape + " of " + dtype_name(dtype) + ", got " +
                                    std::to_string(pixels_ ? pixels_->size() : 0));
    }
    translucent_ = channels == 4 && any_alpha_below_one(dtype, *pixels_);
}

}  // namespace cubecam
