/// The panorama that docs/conventions.md calls "equirect". It is not mirrored: objects to the right
/// of the center are to the right in the picture. Row 0 is at +Y, and `Center` names the axis in
/// the middle column.
///
/// u = 1/2 + longitude / (2 pi), v = 1/2 - latitude / pi; longitude counts from the center to the
/// right, latitude from the horizon up. Texel (row, col) of a (H, W) picture is the direction with
/// u = (col + .5)/W, v = (row + .5)/H.
#pragma once

#include "cubecam/math/cube_face.hpp"

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <numbers>

namespace cubecam {

/// The world axis at the center of the panorama. neg_z: camera forward, the default; pos_z:
/// OpenEXR, Mitsuba, OpenImageIO (y up); pos_x: three.js.
enum class Center : int { neg_z, pos_z, pos_x, neg_x };

template <typename T>
constexpr glm::vec<3, T> center_forward(Center center) {
    switch (center) {
        case Center::neg_z: return {0, 0, -1};
        case Center::pos_z: return {0, 0, 1};
        case Center::pos_x: return {1, 0, 0};
        case Center::neg_x: return {-1, 0, 0};
    }
    return {0, 0, -1};
}

/// The world axis a quarter turn to the right of the center: forward x up.
template <typename T>
constexpr glm::vec<3, T> center_right(Center center) {
    const glm::vec<3, T> forward = center_forward<T>(center);
    return {-forward.z, 0, forward.x};
}

/// Converts a direction (from the viewer outwards, of any length except 0) to (u, v), both within
/// [0, 1].
template <typename T>
glm::vec<2, T> direction_to_equirect_uv(const glm::vec<3, T>& direction, Center center) {
    const T pi = std::numbers::pi_v<T>;
    const T right = glm::dot(direction, center_right<T>(center));
    const T forward = glm::dot(direction, center_forward<T>(center));
    return {T(0.5) + std::atan2(right, forward) / (2 * pi),
            T(0.5) - std::atan2(direction.y, std::hypot(right, forward)) / pi};
}

/// Converts (u, v) to the unit direction from the viewer outwards.
template <typename T>
glm::vec<3, T> equirect_uv_to_direction(T u, T v, Center center) {
    const T pi = std::numbers::pi_v<T>;
    const T longitude = (u - T(0.5)) * 2 * pi;
    const T latitude = (T(0.5) - v) * pi;
    const T level = std::cos(latitude);
    return level * std::sin(longitude) * center_right<T>(center) +
           level * std::cos(longitude) * center_forward<T>(center) +
           glm::vec<3, T>(0, std::sin(latitude), 0);
}

}  // namespace cubecam
