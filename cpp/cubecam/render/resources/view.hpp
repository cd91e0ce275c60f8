#pragma once

#include "cubecam/math/plane.hpp"
#include "cubecam/scene/camera.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <optional>
#include <vector>

namespace cubecam {

/// The viewpoint and the matrices of one picture, which is drawn into one layer of a target. A
/// camera has one view, a cubemap has six.
struct View {
    glm::dmat4 view;             ///< world to camera
    glm::dmat4 projection;       ///< camera to GL's clip space
    glm::dmat4 view_projection;  ///< world to clip space
    glm::dvec3 position;         ///< distances count from here; nodes are sorted by them
    glm::dvec3 eye;              ///< highlights and reflections are seen from here
    glm::dvec3 forward;          ///< unit vector along the camera's axis
    bool parallel = false;       ///< orthographic: all rays have the direction `forward`
    double near = 0.0;           ///< parallel views only: distance along the axis counts from here
    /// Only what lies on the side of this plane's normal is drawn; none: everything.
    std::optional<Plane> clip = std::nullopt;
};

View camera_view(const Matrices& matrices);

/// What a view sees in a mirror in this plane: the view from behind the mirror, through it. A point
/// of the mirror lies at the same pixel in both pictures. The view starts at the eye that
/// reflections are seen from.
View mirrored(const View& view, const Plane& mirror);

/// Whether a view sees the side of a plane to which its normal points.
bool sees_front(const View& view, const Plane& plane);

/// Returns the six views of a cube in the order of its faces, 90 degrees each. They follow GL's
/// face table (math/cube_face.hpp), so that a lookup by world direction needs no sign flip and row
/// 0 of a face is t = 0. `rotation` turns the axes of the cube against the world's.
std::vector<View> cube_views(glm::dvec3 position, double near, double far,
                             std::optional<glm::dvec3> eye = std::nullopt,
                             const glm::dquat& rotation = {1.0, 0.0, 0.0, 0.0});

}  // namespace cubecam
