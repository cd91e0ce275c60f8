#pragma once

#include "cubecam/geometry/mesh_data.hpp"
#include "cubecam/scene/camera.hpp"

namespace cubecam {

/// Moves a camera of the world, without turning it, so that the corners of `bounds` fill a picture
/// of `aspect` = width / height and none is outside.
///
/// `margin` is the share of the picture's width and height that stays free at each border. The
/// target becomes the point on the camera's axis nearest to the middle of the bounds. An
/// orthographic camera gets another height. The range from near to far grows until it holds the
/// corners. Only for bounds that would need a viewpoint at one of their corners, such as a line
/// along the view, is the camera farther away.
/// @throws std::invalid_argument for bounds that are empty, not finite or a single point, a margin
/// outside 0 <= margin < 0.5, and an aspect that is not above 0.
void fit(Placed<PerspectiveLens>& camera, const Bounds& bounds, double aspect, double margin);
void fit(Placed<OrthographicLens>& camera, const Bounds& bounds, double aspect, double margin);

}  // namespace cubecam
