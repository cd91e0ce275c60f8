#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>

namespace cubecam {

/// How much of a box lies in a space.
enum class Overlap { none, some, all };

/// The six planes that bound the visible space of a matrix to GL's clip space.
class Frustum {
public:
    explicit Frustum(const glm::dmat4& view_projection) {
        const glm::dmat4& m = view_projection;
        const auto row = [&m](int r) { return glm::dvec4(m[0][r], m[1][r], m[2][r], m[3][r]); };
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(2 * axis);
            planes_[i] = make_plane(row(3) + row(axis));
            planes_[i + 1] = make_plane(row(3) - row(axis));
        }
    }

    /// Whether a box can be visible: false only if the whole box lies beyond one plane (U.
    /// Assarsson, T. Moeller, "Optimized View Frustum Culling Algorithms for Bounding Boxes", JGT
    /// 5(1), 2000, in clip space). The test works for any matrix, perspective or not.
    ///
    /// `error()` returns the largest error of the GPU's arithmetic for a vertex in clip space: a
    /// box within this distance of a plane counts as inside. It is called only if the result
    /// depends on it.
    template <class Error>
    bool may_show(const glm::dvec3& center, const glm::dvec3& half, Error&& error) const {
        std::array<double, 6> farthest;  // corner of the box, from each plane inwards
        bool inside = true;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const Plane& plane = planes_[i];
            farthest[i] =
                glm::dot(plane.normal, center) + plane.offset + glm::dot(plane.reach, half);
            inside = inside && farthest[i] >= 0.0;
        }
        if (inside) return true;
        const glm::dvec4 off = error();
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            // NaN never counts as beyond.
            if (farthest[i] < -(off[static_cast<int>(i / 2)] + off.w)) return false;
        }
        return true;
    }

    /// How much of a box can be visible; `error` is that of may_show(). "All" is exact but for
    /// rounding, "none" is certain, and NaN is "some".
    Overlap overlap(const glm::dvec3& center, const glm::dvec3& half,
                    const glm::dvec4& error) const {
        bool all = true;
        for (std::size_t i = 0; i < planes_.size(); ++i) {
            const Plane& plane = planes_[i];
            const double middle = glm::dot(plane.normal, center) + plane.offset;
            const double reach = glm::dot(plane.reach, half);
            if (middle + reach < -(error[static_cast<int>(i / 2)] + error.w)) return Overlap::none;
            all = all && middle - reach >= 0.0;
        }
        return all ? Overlap::all : Overlap::some;
    }

private:
    struct Plane {
        glm::dvec3 normal;  ///< inwards, of any length
        double offset;
        glm::dvec3 reach;  ///< by how much a unit of a box's half extents goes inwards
    };

    static Plane make_plane(const glm::dvec4& plane) {
        return {glm::dvec3(plane), plane.w, glm::abs(glm::dvec3(plane))};
    }

    std::array<Plane, 6> planes_;  ///< -x +x -y +y -z +z of clip space
};

}  // namespace cubecam
