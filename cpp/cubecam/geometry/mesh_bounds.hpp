#pragma once

#include "cubecam/geometry/mesh_data.hpp"

#include <glm/glm.hpp>

namespace cubecam {

/// The bounds of nothing: low is +inf and high is -inf, so that uniting it changes no other bounds.
Bounds no_bounds();
bool is_empty(const Bounds& bounds);
Bounds united(const Bounds& a, const Bounds& b);

/// The exact bounds of a mesh's vertices after an affine transform. They lie within the bounds of
/// the transformed box, which `transformed` computes.
Bounds bounds_in_world(const MeshData& mesh, const glm::dmat4& world);

}  // namespace cubecam
