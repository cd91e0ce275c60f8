#include "cubecam/scene/camera_fit.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/geometry/mesh_bounds.hpp"
#include "cubecam/math/transform.hpp"

#include <algorithm>
#include <array>

namespace cubecam {

namespace {

/// Of the diagonal of the bounds: no corner comes nearer to the camera.
constexpr double least_depth = 1e-3;

/// The corners of the bounds in a camera's axes, with the world's origin as origin: x to the right,
/// y up, z the depth along the line of sight.
struct Corners {
    std::array<glm::dvec3, 8> all;
    glm::dvec3 low;
    glm::dvec3 high;
    glm::dvec3 center;
    glm::dmat3 to_world;
    double diagonal;

    /// Places a camera at a point of these axes.
    void place(Placement& placement, const glm::dvec3& at) const {
        placement.position = to_world * at;
        placement.target = to_world * glm::dvec3(at.x, at.y, center.z);
    }

    /// Extends a range of depths so that a camera at depth `at` draws every corner.
    template <class Lens>
    void extend(Lens& lens, double at) const {
        const double nearest = low.z - at;
        const double farthest = high.z - at;
        // Rounding may move a surface at the very edge of the range out of it.
        if (lens.near > nearest * (1.0 - 1e-6)) lens.near = 0.5 * nearest;
        if (lens.far < farthest * (1.0 + 1e-6)) lens.far = 2.0 * farthest;
    }
};

Corners corners_of(const Placement& placement, const Bounds& bounds, double aspect, double margin) {
    expect_positive(aspect, "aspect");
    if (!(margin >= 0.0 && margin < 0.5)) {
        expect(false, "a margin of at least 0 and below 0.5", describe(margin));
    }
    expect(!is_empty(bounds), "bounds of some extent", "nothing that is visible");
    expect_finite(bounds.low, "bounds");
    expect_finite(bounds.high, "bounds");
    Corners corners;
    corners.diagonal = glm::length(bounds.extent());
    if (!(corners.diagonal > 0.0)) {
        expect(false, "bounds of some extent", "one point, " + describe(bounds.low));
    }
    const glm::dmat3 view(look_along(glm::dvec3(0.0), forward_of(placement), placement.up));
    glm::dmat3 flip(1.0);
    flip[2][2] = -1.0;
    corners.to_world = glm::transpose(flip * view);
    const Bounds empty = no_bounds();
    corners.low = empty.low;
    corners.high = empty.high;
    for (std::size_t i = 0; i < corners.all.size(); ++i) {
        const glm::dvec3 corner(i & 1U ? bounds.high.x : bounds.low.x,
                                i & 2U ? bounds.high.y : bounds.low.y,
                                i & 4U ? bounds.high.z : bounds.low.z);
        corners.all[i] = flip * (view * corner);
        corners.low = glm::min(corners.low, corners.all[i]);
        corners.high = glm::max(corners.high, corners.all[i]);
    }
    corners.center = flip * (view * bounds.center());
    return corners;
}

/// The places of a camera along one axis of the picture. A corner with coordinates (x, z) is inside
/// if low <= (x - at) / (z - depth) <= high: the camera is right of one line, and left of another.
struct Wedge {
    double low;
    double high;
    double right_of;
    double left_of;

    Wedge(const Corners& corners, int axis, double low_slope, double high_slope)
        : low(low_slope), high(high_slope) {
        const auto crossing = [axis](const glm::dvec3& corner, double slope) {
            return corner[axis] - slope * corner.z;
        };
        right_of = crossing(corners.all[0], high);
        left_of = crossing(corners.all[0], low);
        for (const glm::dvec3& corner : corners.all) {
            right_of = std::max(right_of, crossing(corner, high));
            left_of = std::min(left_of, crossing(corner, low));
        }
    }

    /// The greatest depth at which there is a place between the two lines.
    double depth() const { return (left_of - right_of) / (high - low); }
    /// The middle of the places at a depth.
    double middle(double depth) const { return 0.5 * (right_of + left_of + (high + low) * depth); }
};

}  // namespace

void fit(Placed<PerspectiveLens>& camera, const Bounds& bounds, double aspect, double margin) {
    const Corners corners = corners_of(camera.placement, bounds, aspect, margin);
    PerspectiveLens& lens = camera.lens;
    const double half = 1.0 / perspective(lens.fov, 1.0, lens.near, lens.far)[1][1];
    const double shown = 1.0 - 2.0 * margin;
    const double width = aspect * lens.pixel_aspect;
    const Wedge x(corners, 0, half * (2.0 * lens.shift.x - shown * width),
                  half * (2.0 * lens.shift.x + shown * width));
    const Wedge y(corners, 1, half * (2.0 * lens.shift.y - shown),
                  half * (2.0 * lens.shift.y + shown));
    const double depth =
        std::min({x.depth(), y.depth(), corners.low.z - least_depth * corners.diagonal});
    corners.place(camera.placement, {x.middle(depth), y.middle(depth), depth});
    corners.extend(lens, depth);
}

void fit(Placed<OrthographicLens>& camera, const Bounds& bounds, double aspect, double margin) {
    const Corners corners = corners_of(camera.placement, bounds, aspect, margin);
    OrthographicLens& lens = camera.lens;
    const glm::dvec3 extent = corners.high - corners.low;
    // A line along the view has no extent in the picture.
    lens.height = std::max({extent.y, extent.x / aspect, least_depth * corners.diagonal}) /
                  (1.0 - 2.0 * margin);
    // The camera stays at its depth if all corners are in front of it.
    const glm::dmat3 from_world = glm::transpose(corners.to_world);
    const double least = std::max(lens.near, 0.0) + least_depth * corners.diagonal;
    const double depth =
        std::min((from_world * camera.placement.position).z, corners.low.z - least);
    corners.place(camera.placement, {corners.center.x, corners.center.y, depth});
    corners.extend(lens, depth);
}

}  // namespace cubecam
