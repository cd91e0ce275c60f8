#pragma once

#include "cubecam/core/versioned.hpp"
#include "cubecam/scene/weak_nodes.hpp"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <variant>

namespace cubecam {

/// The position of a camera, its target and its up direction: in the world, or in the coordinates
/// of the parent if there is one.
struct Placement {
    glm::dvec3 position{0.0, 0.0, 0.0};
    std::optional<glm::dvec3> target;  ///< none: the camera looks along `forward`
    glm::dvec3 up{0.0, 1.0, 0.0};
    std::weak_ptr<Node> parent{};
    glm::dvec3 forward{0.0, 0.0, -1.0};  ///< of another value only where in_world() gives it

    bool operator==(const Placement& other) const {
        return position == other.position && target == other.target && up == other.up &&
               same_node(parent, other.parent) && forward == other.forward;
    }
};

struct PerspectiveLens {
    double fov = 60.0;  ///< vertical, degrees
    double near = 0.1;
    double far = 1000.0;
    /// How far the window lies to the right of and above the camera's axis, in heights of the
    /// picture.
    glm::dvec2 shift{0.0};
    double pixel_aspect = 1.0;  ///< the width of a pixel over its height

    bool operator==(const PerspectiveLens&) const = default;
};

struct OrthographicLens {
    double height = 2.0;  ///< world units from the bottom to the top of the picture
    double near = 0.1;
    double far = 1000.0;

    bool operator==(const OrthographicLens&) const = default;
};

/// View and projection of a user; they do not depend on the shape of the picture.
struct Matrices {
    glm::dmat4 view{1.0};
    glm::dmat4 projection{1.0};

    bool operator==(const Matrices&) const = default;
};

template <class Lens>
struct Placed {
    Placement placement;
    Lens lens;

    bool operator==(const Placed&) const = default;
};

using CameraValue = std::variant<Matrices, Placed<PerspectiveLens>, Placed<OrthographicLens>>;

/// Throws std::invalid_argument for matrices that are singular or not finite, a target at the
/// position, an up direction along the line of sight, fov outside (0, 180), near >= far, and near
/// <= 0 or a pixel aspect <= 0 for a perspective.
void check(const CameraValue& value);

/// Returns the matrices for a picture of `aspect` = width / height. Clip space is GL's: -1..1 in x,
/// y and z.
Matrices matrices(const CameraValue& value, double aspect);

/// The direction in which a camera looks, of any length, in the coordinates of the placement.
glm::dvec3 forward_of(const Placement& placement);

/// The world matrix of a camera's parent; none without a parent. Locks the parent's scene, whose
/// lock the caller must not hold.
std::optional<glm::dmat4> parent_matrix(const Placement& placement);
/// The same camera in the coordinates of the world, without a parent. A scale of the parent moves
/// its points, but changes neither the lens nor the lengths that the camera sees.
Placement in_world(const Placement& placement, const std::optional<glm::dmat4>& parent);
CameraValue in_world(CameraValue value);
/// Moves a placement so that in_world() gives the position, target and up of `world`. The parent of
/// `placement` stays.
void set_in_world(Placement& placement, const Placement& world,
                  const std::optional<glm::dmat4>& parent);
/// Returns the placed camera `world` in the coordinates of the parent of `model`, as its child.
CameraValue relative_to(const CameraValue& model, CameraValue world);

class Camera {
public:
    explicit Camera(CameraValue value);
    explicit Camera(Matrices given) : Camera(CameraValue(given)) {}
    virtual ~Camera() = default;
    Camera(const Camera&) = delete;
    Camera& operator=(const Camera&) = delete;

    /// The camera as it was set: relative to its parent if it has one.
    CameraValue value() const { return value_.value(); }
    /// The camera in the world, as pictures see it at this moment.
    CameraValue world_value() const { return in_world(value()); }
    Matrices matrices(double aspect) const { return cubecam::matrices(world_value(), aspect); }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](CameraValue& value) {
            change(value);
            check(value);
        });
    }

private:
    Versioned<CameraValue> value_;
};

template <class Lens>
class CameraOf : public Camera {
public:
    explicit CameraOf(Lens lens = {}, Placement placement = {})
        : Camera(CameraValue(Placed<Lens>{placement, lens})) {}

    Placed<Lens> placed() const { return std::get<Placed<Lens>>(value()); }

    template <class Change>
    void edit_placed(Change&& change) {
        edit([&](CameraValue& value) { change(std::get<Placed<Lens>>(value)); });
    }

    /// Like edit_placed, for the camera in the coordinates of the world.
    template <class Change>
    void edit_in_world(Change&& change) {
        // The parent's scene is locked before the camera, never while the camera is.
        const std::optional<glm::dmat4> parent = parent_matrix(placed().placement);
        edit_placed([&](Placed<Lens>& placed) {
            Placed<Lens> world{in_world(placed.placement, parent), placed.lens};
            change(world);
            placed.lens = world.lens;
            set_in_world(placed.placement, world.placement, parent);
        });
    }

    /// Turns the camera towards a point of the world; `up` is a direction of the world. No `up`:
    /// the camera keeps its own.
    /// @throws std::invalid_argument for a target at the position or an up along the line of sight.
    void look_at(const glm::dvec3& target, const std::optional<glm::dvec3>& up = std::nullopt) {
        edit_in_world([&](Placed<Lens>& placed) {
            placed.placement.target = target;
            if (up) placed.placement.up = *up;
        });
    }
};

using PerspectiveCamera = CameraOf<PerspectiveLens>;
using OrthographicCamera = CameraOf<OrthographicLens>;

}  // namespace cubecam
