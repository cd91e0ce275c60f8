#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <numbers>

/// Matrices of views and lenses. The world is right-handed with +Y up, and a camera without
/// rotation looks along -Z; clip space is GL's, -1..1 in x, y and z. All numbers are doubles; only
/// the values for the GPU are rounded to float.
namespace cubecam {

constexpr double radians(double degrees) { return degrees * std::numbers::pi / 180.0; }

/// World to camera. `forward` and `up` need not be unit length, but must not be parallel.
inline glm::dmat4 look_along(glm::dvec3 position, glm::dvec3 forward, glm::dvec3 up) {
    const glm::dvec3 back = -glm::normalize(forward);
    const glm::dvec3 right = glm::normalize(glm::cross(up, back));
    const glm::dvec3 above = glm::cross(back, right);
    glm::dmat4 view(1.0);
    for (int i = 0; i < 3; ++i) {
        view[i][0] = right[i];
        view[i][1] = above[i];
        view[i][2] = back[i];
    }
    view[3] = glm::dvec4(-glm::dot(right, position), -glm::dot(above, position),
                         -glm::dot(back, position), 1.0);
    return view;
}

/// Camera to clip; `fov` is vertical, in degrees (gluPerspective's matrix).
inline glm::dmat4 perspective(double fov, double aspect, double near, double far) {
    // tan(45 degrees) is 1 - 1e-16 in doubles: a cube face must be exactly as wide as it is deep.
    const double half = fov == 90.0 ? 1.0 : std::tan(0.5 * radians(fov));
    glm::dmat4 m(0.0);
    m[0][0] = 1.0 / (half * aspect);
    m[1][1] = 1.0 / half;
    m[2][2] = -(far + near) / (far - near);
    m[2][3] = -1.0;
    m[3][2] = -2.0 * far * near / (far - near);
    return m;
}

/// Camera to clip for a box `height` world units tall, centred on the axis (glOrtho's matrix).
inline glm::dmat4 orthographic(double height, double aspect, double near, double far) {
    glm::dmat4 m(1.0);
    m[0][0] = 2.0 / (height * aspect);
    m[1][1] = 2.0 / height;
    m[2][2] = -2.0 / (far - near);
    m[3][2] = -(far + near) / (far - near);
    return m;
}

/// Whether the fourth row of a projection is (0, 0, 0, 1): parallel rays.
inline bool is_parallel(const glm::dmat4& projection) {
    return projection[0][3] == 0.0 && projection[1][3] == 0.0 && projection[2][3] == 0.0;
}

/// Whether all sixteen numbers are finite.
inline bool is_finite(const glm::dmat4& m) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) {
            if (!std::isfinite(m[column][row])) return false;
        }
    }
    return true;
}

/// Whether a 3x3 matrix is singular: its determinant is tiny compared with the product of the
/// lengths of its columns.
inline bool is_singular(const glm::dmat3& m) {
    const double lengths = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    return !(std::abs(glm::determinant(m)) > 1e-12 * lengths);
}

/// Whether a projection is singular. A determinant is never larger than that product (Hadamard's
/// inequality).
inline bool is_singular(const glm::dmat4& m) {
    double lengths = 1.0;
    for (int column = 0; column < 4; ++column) lengths *= glm::length(m[column]);
    return !(std::abs(glm::determinant(m)) > 1e-12 * lengths);
}

}  // namespace cubecam
