// Nodes that turn towards a point.
#include "cubecam/core/checks.hpp"
#include "cubecam/scene/node.hpp"

#include <algorithm>

namespace cubecam {

namespace {

bool along(const glm::dvec3& a, const glm::dvec3& b) {
    return !(glm::length(glm::cross(glm::normalize(a), glm::normalize(b))) > 1e-9);
}

/// Replaces an up direction that lies along the line of sight.
glm::dvec3 usable_up(const glm::dvec3& up, const glm::dvec3& direction) {
    if (!along(up, direction)) return up;
    const glm::dvec3 y(0.0, 1.0, 0.0);
    return along(y, direction) ? glm::dvec3(0.0, 0.0, direction.y > 0.0 ? -1.0 : 1.0) : y;
}

}  // namespace

void Node::look_at(const glm::dvec3& target, const glm::dvec3& up) {
    expect_finite(target, "target");
    expect_finite(up, "up");
    if (!(glm::length(up) > 0.0)) expect(false, "an up vector of some length", describe(up));
    edit_placing([&](Placing& placing) {
        const glm::dmat4 above = parent_ ? parent_->locked_world_matrix() : glm::dmat4(1.0);
        Transform transform = transform_of(placing);
        const glm::dvec3 origin(above * glm::dvec4(transform.position, 1.0));
        const glm::dvec3 direction = target - origin;
        // As for cameras: far from the world's origin, rounding loses short distances.
        if (!(glm::length(direction) > 1e-12 * std::max(1.0, glm::length(origin)))) {
            expect(false, "a target away from the node's origin", "both at " + describe(origin));
        }
        // A direction of the world in the parent's axes: the parent may have any affine matrix, and
        // the plane of direction and up stays a plane.
        const glm::dmat3 to_parent = glm::inverse(glm::dmat3(above));
        const glm::dvec3 z = glm::normalize(to_parent * glm::normalize(direction));
        const glm::dvec3 side = to_parent * glm::normalize(usable_up(up, direction));
        const glm::dvec3 y = glm::normalize(side - glm::dot(side, z) * z);
        // A negative scale mirrors an axis, so the rotation turns that axis the other way round.
        const glm::dvec3 axis_y = transform.scale.y < 0.0 ? -y : y;
        const glm::dvec3 axis_z = transform.scale.z < 0.0 ? -z : z;
        transform.rotation =
            glm::normalize(glm::quat_cast(glm::dmat3(glm::cross(axis_y, axis_z), axis_y, axis_z)));
        placing = transform;
    });
}

}  // namespace cubecam
