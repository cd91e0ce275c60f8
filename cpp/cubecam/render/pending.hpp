#pragma once

#include "cubecam/image/encoding.hpp"
#include "cubecam/render/options.hpp"
#include "cubecam/render/readback.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/snapshot.hpp"
#include "cubecam/scene/stereo_camera.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cubecam {

struct RendererInfo;

/// A picture that a renderer has drawn, and whose pixels may still be on their way.
template <class Result>
struct Pending {
    Reading<Result> reading;
    std::uint64_t context = 0;           ///< the number of the context that drew it
    std::optional<StereoLayout> layout;  ///< of the two pictures that make the result; none: one
};

/// @throws std::invalid_argument for effects without a colour.
void check_effects(const SceneSnapshot& scene, const FrameOptions& options);

/// What can be said of a call before anything is drawn. A call that is drawn later is refused at
/// once for its arguments; what depends on a format of the driver is found when it is drawn.
/// @returns the bytes of main memory that the result will take.
/// @throws std::invalid_argument as Renderer::render() and capture() do.
std::size_t check_call(const RendererInfo& info, const SceneSnapshot& scene,
                       const CameraValue& camera, const FrameOptions& options);
std::size_t check_call(const RendererInfo& info, const SceneSnapshot& scene,
                       const StereoValue& camera, const FrameOptions& options);
std::size_t check_call(const RendererInfo& info, const SceneSnapshot& scene,
                       const CaptureOptions& options);

/// What a frame will hold besides its size.
struct FrameShape {
    std::vector<OutputKind> outputs;
    Encoding encoding = Encoding::linear;
};
/// Of a frame whose arguments check_call has found right. Nothing is drawn.
FrameShape frame_shape(const SceneSnapshot& scene, const FrameOptions& options);

}  // namespace cubecam
