#pragma once

#include <glm/glm.hpp>

namespace cubecam {

/// A plane through a point. A point, and not only a distance from the origin, keeps planes far from
/// the world's origin precise.
struct Plane {
    glm::dvec3 point{0.0};
    glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit length

    /// The distance of a place from the plane, positive on the side of the normal.
    double height(const glm::dvec3& place) const { return glm::dot(normal, place - point); }

    bool operator==(const Plane&) const = default;
};

/// The matrix that mirrors the world at a plane: x - 2 (n . (x - p)) n. It is its own inverse.
inline glm::dmat4 reflection(const Plane& plane) {
    const glm::dvec3& n = plane.normal;
    glm::dmat4 made(1.0);
    for (int column = 0; column < 3; ++column) made[column] -= glm::dvec4(2.0 * n[column] * n, 0.0);
    made[3] = glm::dvec4(2.0 * glm::dot(n, plane.point) * n, 1.0);
    return made;
}

/// A plane after an affine transform. As for all surfaces, the front stays the front if the
/// transform mirrors.
inline Plane transformed(const Plane& plane, const glm::dmat4& world) {
    // Normals turn by the inverse transpose: the cofactors over the determinant.
    const glm::dmat3 m(world);
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]),
                               glm::cross(m[0], m[1]));
    const double side = glm::determinant(m) < 0.0 ? -1.0 : 1.0;
    return {glm::dvec3(world * glm::dvec4(plane.point, 1.0)),
            side * glm::normalize(cofactors * plane.normal)};
}

}  // namespace cubecam
