#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace cubecam {

/// Tangents of a mesh's vertices, and the vertices that they need.
struct TangentSpace {
    std::vector<glm::vec4> tangents;  ///< of each vertex; see MeshData::tangents
    std::vector<glm::uvec3> triangles;
    /// For each vertex the vertex of the given mesh from which it was made. The first ones are the
    /// given vertices in their order; empty: there are no others.
    std::vector<std::uint32_t> sources;
};

/// The tangents of MikkTSpace: M. Mikkelsen, "Simulation of Wrinkled Surfaces Revisited", 2008,
/// section 3, by which most programs bake normal maps. The four arrays have equal lengths, except
/// that of the triangles.
///
/// Vertices with equal position, normal and uv count as one. The triangles around a vertex that are
/// joined by edges and have the same orientation of their uvs are a group; its tangent is the mean
/// of the triangles' directions of +u in the plane of the vertex's normal, weighted by the angles
/// at the vertex. Triangles without an area of their uvs have no direction and join the group of a
/// neighbour. A vertex that has none gets any tangent, so that every frame is finite.
TangentSpace find_tangents(const std::vector<glm::vec3>& positions,
                           const std::vector<glm::vec3>& normals, const std::vector<glm::vec2>& uvs,
                           const std::vector<glm::uvec3>& triangles);

/// Some unit vector that is perpendicular to a normal.
glm::dvec3 any_tangent(const glm::dvec3& normal);

}  // namespace cubecam
