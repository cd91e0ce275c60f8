#pragma once

#include <glm/glm.hpp>

#include <algorithm>
#include <array>

namespace cubecam {

/// One of the eight corners of a box, 0 to 7.
inline glm::dvec4 box_corner(const glm::dvec3& low, const glm::dvec3& high, int corner) {
    return {(corner & 1) != 0 ? high.x : low.x, (corner & 2) != 0 ? high.y : low.y,
            (corner & 4) != 0 ? high.z : low.z, 1.0};
}

/// Whether a box can show in the picture of `view_projection` (GL clip space): false only if all
/// eight corners lie beyond one and the same plane of the frustum (U. Assarsson, T. Moeller,
/// "Optimized View Frustum Culling Algorithms for Bounding Boxes", JGT 5(1), 2000, in clip space).
/// Holds for any matrix, perspective or not.
///
/// `error` is how far off the GPU's float arithmetic may put a corner's clip coordinates: within
/// that of a plane a box counts as inside, so never false for what shows.
inline bool may_show(const glm::dmat4& view_projection, const glm::dvec3& low,
                     const glm::dvec3& high, const glm::dvec4& error) {
    std::array<int, 6> beyond{};
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 clip = view_projection * box_corner(low, high, corner);
        for (int axis = 0; axis < 3; ++axis) {
            const auto plane = static_cast<std::size_t>(2 * axis);
            const double slack = error[axis] + error.w;
            beyond[plane] += clip[axis] < -clip.w - slack;
            beyond[plane + 1] += clip[axis] > clip.w + slack;
        }
    }
    return std::none_of(beyond.begin(), beyond.end(), [](int corners) { return corners == 8; });
}

}  // namespace cubecam
