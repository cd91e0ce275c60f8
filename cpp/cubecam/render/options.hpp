#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/image/depth_format.hpp"
#include "cubecam/image/format.hpp"
#include "cubecam/render/passes/tonemap.hpp"
#include "cubecam/render/resources/depth_order.hpp"
#include "cubecam/render/resources/outputs.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace cubecam {

struct RendererOptions {
    gl::DeviceChoice device = std::string("auto");
    /// Whether one draw call draws all views of a mesh (true) or each view has its own pass
    /// (false); none: whichever is faster.
    std::optional<bool> layered;
    std::size_t cache_bytes = std::size_t{256} << 20;  ///< limit for targets of frames and captures
    bool debug = false;                                ///< errors quote the driver's messages
    bool trust_shaders = false;  ///< users' GLSL is compiled without a trial (trial/trial.hpp)
};

struct FrameOptions {
    std::int64_t width = 0;   ///< pixels
    std::int64_t height = 0;  ///< pixels
    RequestedOutputs outputs;
    Format format = Format::rgba8;
    std::int64_t samples = 1;
    double exposure = 0.0;  ///< stops: colour is multiplied by 2^exposure before the tone curve
    Tonemap tonemap = Tonemap::none;
    Encode encode = Encode::none;
    bool color = true;  ///< false: no colour buffer, only outputs; `format` is ignored
    DepthFormat depth_format = DepthFormat::depth_component32f;
    /// What surfaces reflect is looked up in a picture of the same views first.
    bool screen_reflections = false;
    double max_lod_error = 0.0;  ///< pixels; see LevelChoice
};

struct CaptureOptions {
    glm::dvec3 position{0.0};
    std::int64_t size = 256;  ///< pixels along an edge of a face
    double near = 0.05;
    double far = 1000.0;
    std::vector<std::int32_t> exclude;  ///< ids of nodes; their subtrees are not drawn
    RequestedOutputs outputs;
    Format format = Format::rgba32f;
    std::int64_t samples = 1;
    std::optional<glm::dvec3> eye;            ///< none: `position`
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< of the cube's axes
    DepthFormat depth_format = DepthFormat::depth_component32f;
    DepthOrder depth_order = DepthOrder::nearest;
    double max_lod_error = 0.0;  ///< pixels; see LevelChoice
};

/// Throws std::invalid_argument for a position that is not finite, or clip distances out of order.
void check(const CaptureOptions& options);

/// One capture of a batch; it takes the place of `position` and `rotation` of its options.
struct CapturePlace {
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< of the cube's axes
};

/// Both functions throw std::invalid_argument for options that do not fit together: outputs that
/// need another depth format, tone mapping without a colour, a picture without any buffer.
void check_buffers(const FrameOptions& options);
void check_buffers(const CaptureOptions& options);

}  // namespace cubecam
