#include "cubecam/scene/stereo_camera.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/parse_name.hpp"
#include "cubecam/math/transform.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

/// A camera's own axes in the world: right, up and back.
glm::dmat3 axes_of(const Placement& placement) {
    return glm::transpose(
        glm::dmat3(look_along(placement.position, forward_of(placement), placement.up)));
}

std::shared_ptr<Camera> checked_eye(std::shared_ptr<Camera> camera) {
    if (!camera) throw std::invalid_argument("expected a camera, got none");
    return camera;
}

void refuse_convergence(const std::optional<double>& convergence) {
    if (!convergence) return;
    expect(false, "convergence None for a camera of parallel rays, which has no frustum to shear",
           describe(*convergence));
}

/// An eye at distance `x` to the right of the camera.
CameraValue shifted(const Placed<PerspectiveLens>& camera, double x,
                    std::optional<double> convergence) {
    Placed<PerspectiveLens> eye = camera;
    const glm::dvec3 step = axes_of(camera.placement)[0] * x;
    eye.placement.position += step;
    if (eye.placement.target) *eye.placement.target += step;
    if (convergence) {
        const PerspectiveLens& lens = camera.lens;
        const double height =
            2.0 * *convergence / perspective(lens.fov, 1.0, lens.near, lens.far)[1][1];
        eye.lens.shift.x -= x / height;
    }
    return eye;
}

CameraValue shifted(const Placed<OrthographicLens>& camera, double x,
                    std::optional<double> convergence) {
    refuse_convergence(convergence);
    Placed<OrthographicLens> eye = camera;
    const glm::dvec3 step = axes_of(camera.placement)[0] * x;
    eye.placement.position += step;
    if (eye.placement.target) *eye.placement.target += step;
    return eye;
}

CameraValue shifted(const Matrices& camera, double x, std::optional<double> convergence) {
    if (is_parallel(camera.projection)) refuse_convergence(convergence);
    // A view may also contain a scale: world units and camera units then differ.
    const glm::dmat4 world = glm::inverse(camera.view);
    const double right = glm::length(glm::dvec3(world[0]));
    Matrices eye = camera;
    eye.view = glm::translate(glm::dmat4(1.0), glm::dvec3(-x / right, 0.0, 0.0)) * camera.view;
    if (convergence) {
        const double back = glm::length(glm::dvec3(world[2]));
        glm::dmat4 shear(1.0);
        shear[2][0] = -(x / right) / (*convergence / back);
        eye.projection = camera.projection * shear;
    }
    return eye;
}

template <class Lens>
CameraValue turned(const Placed<Lens>& camera, double degrees) {
    const Placement& placement = camera.placement;
    if (!placement.target) expect(false, "a camera with a target to turn round", "none");
    const glm::dvec3 up = axes_of(placement)[1];
    const glm::dvec3 arm = placement.position - *placement.target;
    const double angle = radians(degrees);
    Placed<Lens> eye = camera;
    // The arm is at right angles to the axis.
    eye.placement.position =
        *placement.target + arm * std::cos(angle) + glm::cross(up, arm) * std::sin(angle);
    eye.placement.up = up;  // the axis of the turn, so it does not change
    return eye;
}

CameraValue turned(const Matrices&, double) {
    expect(false, "a camera with a target to turn round", "one of matrices");
    return {};
}

}  // namespace

StereoLayout parse_stereo_layout(std::string_view name) {
    const std::size_t place = place_of_name(stereo_layout_names, name);
    if (place < stereo_layout_names.size()) return stereo_layout_names[place].second;
    throw std::invalid_argument("layout: expected " + quoted_names(stereo_layout_names) +
                                ", got '" + shortened(name) + "'");
}

std::string_view to_string(StereoLayout layout) {
    return stereo_layout_names[static_cast<std::size_t>(layout)].first;
}

Eyes off_axis_eyes(const CameraValue& camera, double separation,
                   std::optional<double> convergence) {
    expect_not_negative(separation, "separation");
    if (convergence) expect_positive(*convergence, "convergence");
    const CameraValue world = in_world(camera);
    const auto eye = [&](double x) {
        return relative_to(
            camera,
            std::visit([&](const auto& kind) { return shifted(kind, x, convergence); }, world));
    };
    return {eye(-0.5 * separation), eye(0.5 * separation)};
}

Eyes toe_in_eyes(const CameraValue& camera, double degrees) {
    if (!(degrees >= 0.0 && degrees < 180.0)) {
        expect(false, "degrees from 0 to below 180", describe(degrees));
    }
    const CameraValue world = in_world(camera);
    const auto eye = [&](double angle) {
        return relative_to(
            camera, std::visit([&](const auto& kind) { return turned(kind, angle); }, world));
    };
    return {eye(-0.5 * degrees), eye(0.5 * degrees)};
}

StereoCamera::StereoCamera(std::shared_ptr<Camera> left, std::shared_ptr<Camera> right,
                           StereoLayout layout)
    : left_(checked_eye(std::move(left))), right_(checked_eye(std::move(right))), layout_(layout) {}

std::shared_ptr<Camera> StereoCamera::left() const {
    const std::lock_guard lock(mutex_);
    return left_;
}

std::shared_ptr<Camera> StereoCamera::right() const {
    const std::lock_guard lock(mutex_);
    return right_;
}

StereoLayout StereoCamera::layout() const {
    const std::lock_guard lock(mutex_);
    return layout_;
}

void StereoCamera::set_left(std::shared_ptr<Camera> camera) {
    camera = checked_eye(std::move(camera));
    const std::lock_guard lock(mutex_);
    left_.swap(camera);
}

void StereoCamera::set_right(std::shared_ptr<Camera> camera) {
    camera = checked_eye(std::move(camera));
    const std::lock_guard lock(mutex_);
    right_.swap(camera);
}

void StereoCamera::set_layout(StereoLayout layout) {
    const std::lock_guard lock(mutex_);
    layout_ = layout;
}

StereoValue StereoCamera::value() const {
    const std::lock_guard lock(mutex_);
    return {{left_->world_value(), right_->world_value()}, layout_};
}

}  // namespace cubecam
