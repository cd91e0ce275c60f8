#include "cubecam/render/options.hpp"

#include <cmath>
#include <stdexcept>
#include <string>

namespace cubecam {
namespace {

void check_outputs_of(const RequestedOutputs& requested, DepthFormat depth_format) {
    const auto refuse = [&](const char* expected) {
        throw std::invalid_argument("outputs: expected " + std::string(expected) +
                                    ", got depth_format " + std::string(to_string(depth_format)));
    };
    const Outputs& outputs = requested.outputs;
    if (outputs.has(OutputSource::stencil) && !has_stencil(depth_format)) {
        refuse("\"stencil\" only with a depth_format that has one, depth24_stencil8, "
               "depth32f_stencil8 or stencil_index8");
    }
    // Without depth no test determines the nearest node.
    const bool shaded = outputs.shaded() || !requested.others.empty();
    if ((shaded || outputs.has(OutputSource::depth)) && !has_depth(depth_format)) {
        refuse(has_stencil(depth_format) ? "at most \"stencil\" without a depth buffer"
                                         : "none without a depth buffer");
    }
}

void check_finite(const glm::dvec3& value, const char* what) {
    if (std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z)) return;
    throw std::invalid_argument(std::string(what) + ": expected 3 finite numbers");
}

void check_lod_error(double pixels) {
    if (pixels >= 0.0 && std::isfinite(pixels)) return;
    throw std::invalid_argument("max_lod_error: expected pixels, finite and not negative, got " +
                                std::to_string(pixels));
}

}  // namespace

void check_buffers(const FrameOptions& options) {
    check_outputs_of(options.outputs, options.depth_format);
    check_lod_error(options.max_lod_error);
    if (!(options.exposure >= -64.0 && options.exposure <= 64.0)) {
        throw std::invalid_argument("exposure: expected -64 to 64 stops, got " +
                                    std::to_string(options.exposure));
    }
    if (options.screen_reflections && !options.color) {
        throw std::invalid_argument(
            "screen_reflections: expected False without a colour, got True and format None");
    }
    if (options.screen_reflections && !has_depth(options.depth_format)) {
        throw std::invalid_argument("screen_reflections: expected False without a depth buffer, "
                                    "got True and depth_format " +
                                    std::string(to_string(options.depth_format)));
    }
    if (options.color) return;
    if (options.tonemap != Tonemap::none || options.encode != Encode::none ||
        options.exposure != 0.0) {
        throw std::invalid_argument("exposure, tonemap, encode: expected 0 and None without a "
                                    "colour, got format None");
    }
    if (options.depth_format == DepthFormat::none) {
        throw std::invalid_argument("format, depth_format: expected at least one, got None twice");
    }
}

void check(const CaptureOptions& options) {
    check_finite(options.position, "position");
    if (options.eye) check_finite(*options.eye, "eye");
    check_lod_error(options.max_lod_error);
    if (!(options.near > 0.0) || !(options.far > options.near) || !std::isfinite(options.far)) {
        throw std::invalid_argument("near, far: expected 0 < near < far, got near " +
                                    std::to_string(options.near) + " and far " +
                                    std::to_string(options.far));
    }
}

void check_buffers(const CaptureOptions& options) {
    check_outputs_of(options.outputs, options.depth_format);
    if (options.depth_order == DepthOrder::farthest && !has_depth(options.depth_format)) {
        throw std::invalid_argument(
            "depth_order: expected \"nearest\" without a depth buffer, got \"farthest\" and "
            "depth_format " +
            std::string(to_string(options.depth_format)));
    }
}

}  // namespace cubecam
