#pragma once

#include "cubecam/geometry/mesh_data.hpp"

#include <glm/glm.hpp>

/// Functions that compute meshes, all but the arrow centred at the origin, with outward normals and
/// texture coordinates. Shapes round the Y axis have their seam at -Z and show the middle of a
/// picture at +Z, unmirrored from outside. All these functions throw std::invalid_argument for a
/// length that is not positive and finite, too few segments, or more than 16,777,216 vertices.
namespace cubecam::primitives {

/// A rectangle in the XZ plane with the normal +Y and uv (0, 0) at (-x, +z): seen from +Y with -Z
/// up, a picture on it is upright.
MeshData plane(double width, double depth);

/// A box of six faces, each with its own normals (24 vertices) and uv 0..1. Pictures on them are
/// upright from outside: +Y is up on the sides, -Z on top (as on the plane), +Z on the bottom.
MeshData box(glm::dvec3 size);

/// A uv sphere: `segments` round the Y axis, `rings` from pole to pole.
MeshData sphere(double radius, int segments = 64, int rings = 32);

/// A subdivided icosahedron: triangles of nearly equal size, 20 * 4^subdivisions of them (0..9).
MeshData icosphere(double radius, int subdivisions = 3);

/// A cylinder round the Y axis from -height/2 to +height/2, with caps.
MeshData cylinder(double radius, double height, int segments = 64);

/// A closed cone round the Y axis, with its base at -height/2 and its apex at +height/2.
MeshData cone(double radius, double height, int segments = 64);

/// A torus round the Y axis. `radius` is the distance from the axis to the center of the tube,
/// `tube` the radius of the tube, which is smaller.
MeshData torus(double radius, double tube, int segments = 64, int sides = 32);

/// A closed arrow from the origin to (0, 0, length): Node::look_at turns +Z towards a point. The
/// shaft is a cylinder of `radius`, the head a cone of `head_length` and `head_radius`. u runs
/// round the shaft and the head as on the cylinder, v along the arrow.
MeshData arrow(double length, double radius, double head_length, double head_radius,
               int segments = 64);

}  // namespace cubecam::primitives
