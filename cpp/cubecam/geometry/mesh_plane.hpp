#pragma once

#include "cubecam/geometry/mesh_data.hpp"
#include "cubecam/math/plane.hpp"

namespace cubecam {

/// The largest distance of a flat mesh's vertex from its plane, relative to the mesh's size (the
/// diagonal of its bounds).
inline constexpr double most_uneven = 1e-5;

/// The plane in which all vertices of a mesh lie, in the mesh's space. Its normal is that of the
/// triangles' fronts, weighted by their areas; of a mesh that shows its front on both sides, that
/// of its largest triangle.
/// @throws std::invalid_argument for a mesh that is not flat, or has no area.
Plane plane_of(const MeshData& mesh);

}  // namespace cubecam
