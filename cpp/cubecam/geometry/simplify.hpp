#pragma once

#include "cubecam/geometry/mesh_data.hpp"

#include <vector>

namespace cubecam {

/// Levels of detail of a mesh, from fine to coarse. Each has about `ratio` of the triangles of the
/// one before, between vertices of the mesh; they end where nothing can be left out without a tear
/// or a fold. Polls for interrupts.
///
/// Edges are contracted to one of their ends, in the order of the least quadric error (M. Garland
/// and P. Heckbert, "Surface Simplification Using Quadric Error Metrics", SIGGRAPH 1997), which
/// counts normals, texture coordinates and colours, too (H. Hoppe, "New Quadric Metric for
/// Simplifying Meshes with Appearance Attributes", IEEE Visualization 1999). Borders keep to
/// borders. Vertices at one place, with other attributes on either side, move along their seam
/// together.
///
/// The error of a level is the greater of two: an upper bound for the distance of the surfaces
/// (surface_distance.hpp), and the greatest root of a mean square by which attributes differ. For
/// the latter a difference of 1 of normals, texture coordinates or colours counts as the length on
/// the surface over which these change by 1 on average, at most a quarter of the mesh's extent.
///
/// @throws std::invalid_argument for a ratio that is not from 0.1 to 0.9.
std::vector<MeshLevel> simplified_levels(const MeshData& mesh, double ratio);

}  // namespace cubecam
