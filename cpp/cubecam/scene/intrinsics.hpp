#pragma once

#include "cubecam/scene/camera.hpp"

#include <glm/glm.hpp>

namespace cubecam {

/// The matrix K of the pinhole model: a point (x, y, z) in OpenCV's camera axes (x to the right, y
/// down, z forward) is seen at the pixel coordinates (u, v), where (u, v, 1) z = K (x, y, z). u
/// counts from the left edge of the picture and v from its upper edge, so that the middle of the
/// first pixel is at (0.5, 0.5).
/// @throws std::invalid_argument for a projection of parallel rays, or one with another last row
/// than (0, 0, -1, 0).
glm::dmat3 intrinsics(const CameraValue& camera, int width, int height);

/// The lens whose intrinsics are K for a picture of this size; near and far are the defaults.
/// @throws std::invalid_argument for a K with a skew, focal lengths that are not positive, or other
/// numbers than 0, 0, 1 in the last row.
PerspectiveLens lens_of(const glm::dmat3& K, int width, int height);

/// World to camera in OpenCV's axes, from the view matrix, which is in OpenGL's: y and z change
/// their signs. The function is its own inverse.
glm::dmat4 other_camera_axes(const glm::dmat4& view);

/// The placement of a camera from its world-to-camera matrix in OpenGL's axes.
/// @throws std::invalid_argument for a matrix that is not a rotation and a translation.
Placement placement_of(const glm::dmat4& view);

}  // namespace cubecam
