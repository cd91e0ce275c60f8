#pragma once

#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/scene/snapshot.hpp"

namespace cubecam {

/// Finds the outputs of a request in a scene; the materials of visible nodes may declare outputs of
/// their own.
/// @throws std::invalid_argument that lists the known names, for a name that is neither in the
/// table nor declared; also for a name that two materials declare with different types.
Outputs resolve_outputs(const RequestedOutputs& requested, const SceneSnapshot& scene);

}  // namespace cubecam
