#pragma once

#include "cubecam/geometry/mesh_data.hpp"

#include <glm/glm.hpp>

/// Meshes by formula, centred at the origin, with outward normals and texture coordinates. What
/// goes round the Y axis has its seam at -Z and the middle of a picture at +Z, unmirrored seen from
/// outside. All throw std::invalid_argument for a length that is not positive and finite, too few
/// segments, or more than 16,777,216 vertices.
namespace cubecam::primitives {

/// In the XZ plane, normal +Y; uv (0, 0) at (-x, +z): a picture on it is upright seen from +Y, -Z
/// up.
MeshData plane(double width, double depth);

/// Six faces with normals of their own (24 vertices), each with uv 0..1, upright seen from outside:
/// +Y is up on the sides, -Z on top (as on the plane), +Z on the bottom.
MeshData box(glm::dvec3 size);

/// A uv sphere: `segments` round the Y axis, `rings` from pole to pole.
MeshData sphere(double radius, int segments = 64, int rings = 32);

/// A subdivided icosahedron: triangles of nearly equal size, 20 * 4^subdivisions of them (0..9).
MeshData icosphere(double radius, int subdivisions = 3);

/// Round the Y axis, from -height/2 to +height/2, with caps.
MeshData cylinder(double radius, double height, int segments = 64);

/// Round the Y axis, base at -height/2, apex at +height/2, with a base.
MeshData cone(double radius, double height, int segments = 64);

/// Round the Y axis: `radius` to the center of the tube, `tube` the radius of the tube, the
/// smaller.
MeshData torus(double radius, double tube, int segments = 64, int sides = 32);

}  // namespace cubecam::primitives
