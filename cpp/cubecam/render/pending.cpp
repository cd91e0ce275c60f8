#include "cubecam/render/pending.hpp"

#include "cubecam/render/renderer.hpp"
#include "cubecam/render/requested_outputs.hpp"
#include "cubecam/render/stereo.hpp"

#include <span>
#include <stdexcept>

namespace cubecam {
namespace {

std::size_t check_request(const RendererInfo& info, const TargetRequest& request) {
    check_limits(info.limits, info.renderer, request);
    return result_bytes(described(request));
}

std::size_t check_views(const RendererInfo& info, const SceneSnapshot& scene,
                        std::span<const CameraValue> cameras, const FrameOptions& options) {
    check_buffers(options);
    check_effects(scene, options);
    const std::size_t bytes = check_request(info, frame_request(scene, options, cameras.size()));
    const double aspect = static_cast<double>(options.width) / static_cast<double>(options.height);
    for (const CameraValue& camera : cameras) (void)matrices(camera, aspect);
    return bytes;
}

}  // namespace

void check_effects(const SceneSnapshot& scene, const FrameOptions& options) {
    if (options.color || scene.effects.empty()) return;
    throw std::invalid_argument("effects: expected none without a colour, got format None");
}

std::size_t check_call(const RendererInfo& info, const SceneSnapshot& scene,
                       const CameraValue& camera, const FrameOptions& options) {
    return check_views(info, scene, {&camera, 1}, options);
}

std::size_t check_call(const RendererInfo& info, const SceneSnapshot& scene,
                       const StereoValue& camera, const FrameOptions& options) {
    const CameraValue eyes[] = {camera.eyes.left, camera.eyes.right};
    return check_views(info, scene, eyes, eye_options(options, camera.layout));
}

std::size_t check_call(const RendererInfo& info, const SceneSnapshot& scene,
                       const CaptureOptions& options) {
    check(options);
    check_buffers(options);
    return check_request(info, capture_request(scene, options, TargetShape::cube()));
}

}  // namespace cubecam
