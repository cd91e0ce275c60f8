/// Arguments that several calls of a renderer have in common.
#pragma once

#include "formats.hpp"
#include "node_list.hpp"
#include "objects.hpp"
#include "values.hpp"

#include "cubecam/render/options.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/scene.hpp"
#include "cubecam/scene/snapshot.hpp"
#include "cubecam/scene/stereo_camera.hpp"

#include <memory>
#include <optional>
#include <variant>

namespace cubecam::bindings {

using OutputNames = OneOf<py::typing::Iterable<py::str>>;
using FormatOrNone = std::optional<FormatName>;

using SeenBy = OneOf<Camera, StereoCamera>;

std::variant<CameraValue, StereoValue> to_camera(const SeenBy& camera);

/// The scene at the moment of the call. Where much must be calculated first, other threads and
/// signal handlers run meanwhile, and the moment is after that.
std::shared_ptr<const SceneSnapshot> snapshot_of(const Scene& scene,
                                                 const Scene::Effects& effects = {});

/// The arguments of a frame, or of all frames of a batch.
struct FrameArguments {
    const SizeLike& size;
    const OutputNames& outputs;
    const FormatOrNone& format;
    const WholeNumber& samples;
    double exposure;
    const std::optional<Choice<tonemap_names>>& tonemap;
    const std::optional<Choice<encode_names>>& encode;
    const DepthFormatName& depth_format;
    bool screen_reflections;
    double max_lod_error;
};

FrameOptions frame_options(const FrameArguments& given);

/// The arguments of a capture, or of all captures of a batch.
struct CaptureArguments {
    const WholeNumber& size;
    double near;
    double far;
    const Nodes& exclude;
    const OutputNames& outputs;
    const FormatOrNone& format;
    const WholeNumber& samples;
    const OrNone<ArrayLike>& eye;
    const DepthFormatName& depth_format;
    const Choice<depth_order_names>& depth_order;
    double max_lod_error;
};

/// The options without position and rotation.
CaptureOptions capture_options(const Scene& scene, const CaptureArguments& given);

}  // namespace cubecam::bindings
