#pragma once

#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/scene/snapshot.hpp"

namespace cubecam {

/// The outputs that a request means in a scene, where the materials of visible nodes may declare
/// some of their own.
/// @throws std::invalid_argument for a name that is neither in the table nor declared, listing the
/// known ones, and for one that two materials declare with different types.
Outputs resolve_outputs(const RequestedOutputs& requested, const SceneSnapshot& scene);

}  // namespace cubecam
