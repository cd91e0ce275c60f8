#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/scene/depth_format.hpp"
#include "cubecam/scene/format.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cubecam {

/// What a picture holds besides its colour. Only opaque nodes write the shaded ones; depth and
/// stencil are what those buffers hold in the end.
struct Outputs {
    bool distance = false;  ///< length of the ray, world units
    bool z = false;         ///< along the camera's axis, world units
    bool normal = false;    ///< world shading normal, towards the viewer
    bool position = false;  ///< world
    bool id = false;        ///< Node::id
    bool depth = false;     ///< window-space z, 0 near to 1 far
    bool stencil = false;

    /// Whether fragment shaders write any.
    bool shaded() const { return distance || z || normal || position || id; }
    /// Whether any is read from the depth and stencil buffer.
    bool buffered() const { return depth || stencil; }
    bool any() const { return shaded() || buffered(); }
    auto operator<=>(const Outputs&) const = default;
};

/// How linear colour is brought into 0..1; `none` leaves it as it is.
enum class Tonemap : std::uint8_t { none, reinhard, aces, neutral };

/// Transfer function applied last; `srgb` is IEC 61966-2-1.
enum class Encode : std::uint8_t { none, srgb };

/// All three throw std::invalid_argument for a name they do not know, listing those they do.
Outputs parse_outputs(const std::vector<std::string>& names);
Tonemap parse_tonemap(std::string_view name);
Encode parse_encode(std::string_view name);

struct RendererOptions {
    gl::DeviceChoice device = std::string("auto");
    /// Draw all views of a mesh at once: yes, no (one pass per view), or nothing: where that is
    /// faster.
    std::optional<bool> layered;
    std::size_t cache_bytes = std::size_t{256} << 20;  ///< kept for targets of frames and captures
    bool debug = false;                                ///< errors quote the driver's messages
};

struct FrameOptions {
    std::int64_t width = 0;   ///< pixels
    std::int64_t height = 0;  ///< pixels
    Outputs outputs;
    Format format = Format::rgba8;
    std::int64_t samples = 1;
    Tonemap tonemap = Tonemap::none;
    Encode encode = Encode::none;
    bool color = true;  ///< false: no colour buffer, only outputs; `format` does not count
    DepthFormat depth_format = DepthFormat::depth_component32f;
};

struct CaptureOptions {
    glm::dvec3 position{0.0};
    std::int64_t size = 256;  ///< pixels along an edge of a face
    double near = 0.05;
    double far = 1000.0;
    std::vector<std::int32_t> exclude;  ///< ids of nodes left out, with all below them
    Outputs outputs;
    Format format = Format::rgba32f;
    std::int64_t samples = 1;
    std::optional<glm::dvec3> eye;  ///< none: `position`
    DepthFormat depth_format = DepthFormat::depth_component32f;
};

/// Both throw std::invalid_argument for what cannot be drawn or read together: outputs that the
/// depth format lacks what they need for, tone mapping without a colour, a picture of nothing.
void check_buffers(const FrameOptions& options);
void check_buffers(const CaptureOptions& options);

/// What the last call did.
struct Stats {
    std::int64_t views_drawn =
        0;  ///< pictures drawn: frames, faces of captures and probes, textures
    std::int64_t views_skipped = 0;  ///< pictures that were still true
    std::int64_t draw_calls = 0;
    std::int64_t triangles = 0;         ///< sent to the GPU, each view counted
    std::int64_t probes_updated = 0;    ///< probes of which at least one face was drawn
    std::int64_t textures_updated = 0;  ///< render textures that were drawn
    double milliseconds = 0.0;          ///< the whole call, reading back included
};

}  // namespace cubecam
