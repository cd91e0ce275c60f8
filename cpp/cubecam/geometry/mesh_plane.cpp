#include "cubecam/geometry/mesh_plane.hpp"

#include "cubecam/core/checks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cubecam {

Plane plane_of(const MeshData& mesh) {
    const auto& positions = *mesh.positions();
    const glm::dvec3 middle = mesh.bounds().center();
    const auto at = [&](unsigned vertex) { return glm::dvec3(positions[vertex]) - middle; };
    const auto area = [&](const glm::uvec3& t) {  // twice the area, along the normal
        return glm::cross(at(t[1]) - at(t[0]), at(t[2]) - at(t[0]));
    };
    glm::dvec3 largest(0.0);
    for (const glm::uvec3& triangle : *mesh.triangles()) {
        const glm::dvec3 normal = area(triangle);
        if (glm::dot(normal, normal) > glm::dot(largest, largest)) largest = normal;
    }
    expect(glm::dot(largest, largest) > 0.0, "a PlanarMirror on a flat mesh with an area",
           "one whose triangles have no area");
    // Triangles that face the other way count as if they faced the same way.
    glm::dvec3 sum(0.0);
    glm::dvec3 center(0.0);
    double weights = 0.0;
    for (const glm::uvec3& triangle : *mesh.triangles()) {
        const glm::dvec3 normal = area(triangle);
        const double weight = glm::length(normal);
        sum += glm::dot(normal, largest) < 0.0 ? -normal : normal;
        center += weight * (at(triangle[0]) + at(triangle[1]) + at(triangle[2])) / 3.0;
        weights += weight;
    }
    const Plane plane{middle + center / weights, glm::normalize(sum)};

    const double size = glm::length(mesh.bounds().extent());
    // Vertices are floats: far from the mesh's origin their own steps count.
    const glm::dvec3 most = glm::max(glm::abs(mesh.bounds().low), glm::abs(mesh.bounds().high));
    const double step =
        4.0 * std::numeric_limits<float>::epsilon() * std::max({most.x, most.y, most.z});
    double off = 0.0;
    for (const glm::uvec3& triangle : *mesh.triangles()) {
        for (int corner = 0; corner < 3; ++corner) {
            off = std::max(off, std::abs(plane.height(glm::dvec3(positions[triangle[corner]]))));
        }
    }
    if (off > most_uneven * size + step) {
        expect(false,
               "a PlanarMirror on a flat mesh, all vertices within " + describe(most_uneven) +
                   " of its size from one plane",
               "one of size " + describe(static_cast<float>(size)) + " with a vertex " +
                   describe(static_cast<float>(off)) + " off the plane");
    }
    return plane;
}

}  // namespace cubecam
