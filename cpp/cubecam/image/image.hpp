#pragma once

#include "cubecam/core/parse_name.hpp"
#include "cubecam/image/encoding.hpp"
#include "cubecam/image/pixels.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace cubecam {

/// How a lookup outside 0..1 is treated; glTF's names are REPEAT and CLAMP_TO_EDGE.
enum class Wrap : std::uint8_t { repeat, clamp };

inline constexpr NameTable<Wrap, 2> wrap_names{{{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}}};

/// @throws std::invalid_argument for any other name.
Wrap parse_wrap(std::string_view name);
std::string_view to_string(Wrap wrap);

/// A picture that a material shows: (height, width, channels), row 0 on top, uv (0, 0) its
/// bottom-left.
///
/// An image never changes: the renderer uploads it once, with its revision as the key, and threads
/// may share it.
class Image {
public:
    using Pixels = std::shared_ptr<const PixelBuffer>;

    /// @throws std::invalid_argument when the pixel count does not match, a side is 0 or channels
    /// is not 1, 3 or 4.
    Image(Pixels pixels, int width, int height, int channels, DType dtype, bool mipmaps, Wrap wrap,
          Encoding encoding = Encoding::linear);

    int width() const { return width_; }
    int height() const { return height_; }
    int channels() const { return channels_; }
    DType dtype() const { return dtype_; }
    bool mipmaps() const { return mipmaps_; }
    Wrap wrap() const { return wrap_; }
    Encoding encoding() const { return encoding_; }
    const Pixels& pixels() const { return pixels_; }
    std::uint64_t revision() const { return revision_; }

    /// Whether any texel has an alpha below one: surfaces that show such an image are drawn as
    /// translucent.
    bool translucent() const { return translucent_; }

private:
    Pixels pixels_;
    int width_;
    int height_;
    int channels_;
    DType dtype_;
    bool mipmaps_;
    Wrap wrap_;
    Encoding encoding_;
    bool translucent_;
    std::uint64_t revision_;
};

}  // namespace cubecam
