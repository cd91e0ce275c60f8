#include "cubecam/scene/camera.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/math/transform.hpp"
#include "cubecam/scene/node.hpp"

#include <algorithm>
#include <utility>

namespace cubecam {

namespace {

void check_placement(const Placement& placement) {
    expect_finite(placement.position, "position");
    expect_finite(placement.up, "up");
    if (placement.target) expect_finite(*placement.target, "target");
    const glm::dvec3 forward = forward_of(placement);
    const double distance = glm::length(forward);
    // Far from the origin, rounding loses the difference between the position and a near target.
    const double scale = std::max(1.0, glm::length(placement.position));
    if (!(distance > 1e-12 * scale)) {
        expect(false, "a target away from the position", "both at " + describe(placement.position));
    }
    const double up = glm::length(placement.up);
    expect(up > 0.0, "an up vector of some length", describe(placement.up));
    if (!(glm::length(glm::cross(forward / distance, placement.up / up)) > 1e-9)) {
        expect(false, "an up vector that is not along the line of sight",
               "up " + describe(placement.up) + ", line of sight " + describe(forward));
    }
}

void check_range(double near, double far) {
    expect_finite(near, "near");
    expect_finite(far, "far");
    if (!(near < far)) {
        expect(false, "near < far", "near " + describe(near) + ", far " + describe(far));
    }
}

void check_lens(const PerspectiveLens& lens) {
    if (!(lens.fov > 0.0 && lens.fov < 180.0)) {
        expect(false, "fov above 0 and below 180 degrees", describe(lens.fov));
    }
    expect_positive(lens.near, "near");
    check_range(lens.near, lens.far);
    expect_finite(glm::dvec3(lens.shift, 0.0), "shift");
    expect_positive(lens.pixel_aspect, "pixel_aspect");
}

void check_lens(const OrthographicLens& lens) {
    expect_positive(lens.height, "height");
    check_range(lens.near, lens.far);
}

template <class Lens>
void check_value(const Placed<Lens>& placed) {
    check_placement(placed.placement);
    check_lens(placed.lens);
}

void check_value(const Matrices& given) {
    expect(is_finite(given.view), "a view matrix of finite numbers", "NaN or infinity");
    expect(is_finite(given.projection), "a projection matrix of finite numbers", "NaN or infinity");
    const glm::dmat4& view = given.view;
    const glm::dvec4 last_row(view[0][3], view[1][3], view[2][3], view[3][3]);
    expect(last_row == glm::dvec4(0.0, 0.0, 0.0, 1.0),
           "a view matrix with (0, 0, 0, 1) as its last row", describe(glm::vec4(last_row)));
    expect(!is_singular(glm::dmat3(view)), "a view matrix that can be inverted", "a singular one");
    expect(!is_singular(given.projection), "a projection matrix that can be inverted",
           "a singular one");
}

glm::dmat4 projection_of(const PerspectiveLens& lens, double pixels_aspect) {
    const double aspect = pixels_aspect * lens.pixel_aspect;
    glm::dmat4 projection = perspective(lens.fov, aspect, lens.near, lens.far);
    // The frustum is sheared: points on the axis move relative to the window.
    projection[2][0] = 2.0 * lens.shift.x / aspect;
    projection[2][1] = 2.0 * lens.shift.y;
    return projection;
}

glm::dmat4 projection_of(const OrthographicLens& lens, double aspect) {
    return orthographic(lens.height, aspect, lens.near, lens.far);
}

Matrices matrices_of(const Matrices& given, double) { return given; }

template <class Lens>
Matrices matrices_of(const Placed<Lens>& placed, double aspect) {
    const Placement& p = placed.placement;
    return {look_along(p.position, forward_of(p), p.up), projection_of(placed.lens, aspect)};
}

/// Calls `change` with the placement, if the camera has one.
template <class Change>
void for_placement(CameraValue& value, Change&& change) {
    if (auto* perspective = std::get_if<Placed<PerspectiveLens>>(&value)) {
        change(perspective->placement);
    } else if (auto* parallel = std::get_if<Placed<OrthographicLens>>(&value)) {
        change(parallel->placement);
    }
}

}  // namespace

glm::dvec3 forward_of(const Placement& placement) {
    return placement.target ? *placement.target - placement.position : placement.forward;
}

std::optional<glm::dmat4> parent_matrix(const Placement& placement) {
    const auto parent = placement.parent.lock();
    return parent ? std::optional(parent->world_matrix()) : std::nullopt;
}

Placement in_world(const Placement& placement, const std::optional<glm::dmat4>& parent) {
    Placement world = placement;
    world.parent.reset();
    if (!parent) return world;
    const glm::dmat3 turn(*parent);
    world.position = glm::dvec3(*parent * glm::dvec4(placement.position, 1.0));
    if (placement.target) world.target = glm::dvec3(*parent * glm::dvec4(*placement.target, 1.0));
    world.up = turn * placement.up;
    world.forward = turn * placement.forward;
    return world;
}

CameraValue in_world(CameraValue value) {
    for_placement(value, [](Placement& placement) {
        placement = in_world(placement, parent_matrix(placement));
    });
    return value;
}

void set_in_world(Placement& placement, const Placement& world,
                  const std::optional<glm::dmat4>& parent) {
    placement.position = world.position;
    placement.target = world.target;
    placement.up = world.up;
    if (!parent) return;
    const glm::dmat4 from_world = glm::inverse(*parent);
    placement.position = glm::dvec3(from_world * glm::dvec4(world.position, 1.0));
    if (world.target) {
        placement.target = glm::dvec3(from_world * glm::dvec4(*world.target, 1.0));
    }
    placement.up = glm::dmat3(from_world) * world.up;
}

CameraValue relative_to(const CameraValue& model, CameraValue world) {
    CameraValue copy = model;
    std::weak_ptr<Node> parent;
    for_placement(copy, [&](const Placement& placement) { parent = placement.parent; });
    for_placement(world, [&](Placement& placement) {
        Placement local;
        local.parent = parent;
        set_in_world(local, placement, parent_matrix(local));
        placement = local;
    });
    return world;
}

void check(const CameraValue& value) {
    std::visit([](const auto& kind) { check_value(kind); }, value);
}

Matrices matrices(const CameraValue& value, double aspect) {
    expect_positive(aspect, "aspect");
    return std::visit([aspect](const auto& kind) { return matrices_of(kind, aspect); }, value);
}

Camera::Camera(CameraValue value) : value_((cubecam::check(value), std::move(value))) {}

}  // namespace cubecam
