#pragma once

#include "cubecam/render/options.hpp"
#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/render/resources/target.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>

namespace cubecam {

/// Finds the outputs of a request in a scene; the materials of visible nodes may declare outputs of
/// their own.
/// @throws std::invalid_argument that lists the known names, for a name that is neither in the
/// table nor declared; also for a name that two materials declare with different types.
Outputs resolve_outputs(const RequestedOutputs& requested, const SceneSnapshot& scene);

/// The target that a frame of so many views needs, or a capture; `shape` has faces.
TargetRequest frame_request(const SceneSnapshot& scene, const FrameOptions& options,
                            std::size_t views);
TargetRequest capture_request(const SceneSnapshot& scene, const CaptureOptions& options,
                              const TargetShape& shape);

}  // namespace cubecam
