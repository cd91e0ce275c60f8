#pragma once

#include "cubecam/core/parse_name.hpp"
#include "cubecam/image/encoding.hpp"
#include "cubecam/image/pixels.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

namespace cubecam {

/// How a lookup outside 0..1 is treated; glTF's names are REPEAT, CLAMP_TO_EDGE and
/// MIRRORED_REPEAT.
enum class Wrap : std::uint8_t { repeat, clamp, mirror };

inline constexpr NameTable<Wrap, 3> wrap_names{
    {{"repeat", Wrap::repeat}, {"clamp", Wrap::clamp}, {"mirror", Wrap::mirror}}};

/// Which texels a lookup takes where a texel covers more than a pixel (GL 4.6, section 8.15).
enum class MagFilter : std::uint8_t { linear, nearest };

inline constexpr NameTable<MagFilter, 2> mag_filter_names{
    {{"linear", MagFilter::linear}, {"nearest", MagFilter::nearest}}};

/// Which texels a lookup takes where a pixel covers more than a texel (GL 4.6, section 8.14.2). The
/// last four also choose between levels, which are then made.
enum class MinFilter : std::uint8_t {
    linear,
    nearest,
    linear_mipmap_linear,
    linear_mipmap_nearest,
    nearest_mipmap_linear,
    nearest_mipmap_nearest,
};

inline constexpr NameTable<MinFilter, 6> min_filter_names{
    {{"linear", MinFilter::linear},
     {"nearest", MinFilter::nearest},
     {"linear_mipmap_linear", MinFilter::linear_mipmap_linear},
     {"linear_mipmap_nearest", MinFilter::linear_mipmap_nearest},
     {"nearest_mipmap_linear", MinFilter::nearest_mipmap_linear},
     {"nearest_mipmap_nearest", MinFilter::nearest_mipmap_nearest}}};

inline std::string_view to_string(MagFilter filter) {
    return mag_filter_names[static_cast<std::size_t>(filter)].first;
}
inline std::string_view to_string(MinFilter filter) {
    return min_filter_names[static_cast<std::size_t>(filter)].first;
}

/// How a picture is looked up.
struct Sampler {
    std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};  ///< along u and v
    MagFilter mag = MagFilter::linear;
    MinFilter min = MinFilter::linear;

    bool mipmaps() const { return min != MinFilter::linear && min != MinFilter::nearest; }
};

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
    Image(Pixels pixels, int width, int height, int channels, DType dtype,
          const Sampler& sampler = {}, Encoding encoding = Encoding::linear);

    int width() const { return width_; }
    int height() const { return height_; }
    int channels() const { return channels_; }
    DType dtype() const { return dtype_; }
    const Sampler& sampler() const { return sampler_; }
    Encoding encoding() const { return encoding_; }
    /// Whether a map of colours decodes the numbers: those of 8 bits that are sRGB.
    bool decodes() const { return dtype_ == DType::uint8 && encoding_ == Encoding::srgb; }
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
    Sampler sampler_;
    Encoding encoding_;
    bool translucent_;
    std::uint64_t revision_;
};

}  // namespace cubecam
