#pragma once

#include "cubecam/render/resources/view.hpp"

#include <glm/glm.hpp>

namespace cubecam {

/// The rays of the pixels of a view's picture, which a skybox shows. The ray of the pixel whose
/// centre is at (x, y), counted from the bottom-left corner of the picture, has the world direction
/// m[0] + (x - m[3].x) m[1] + (y - m[3].y) m[2]; its length is arbitrary.
///
/// The rays come from the rows x, y and w of the projection, so that neither near nor far matters.
/// A point p of the ray of (X, Y) in clip space fulfils x.p = X w.p and y.p = Y w.p, so the ray is
/// the cross product of x - X w and y - Y w, which is linear in X and Y.
///
/// m[3] is the multiple of half a pixel that is nearest to the axis of the view. There m[1] and
/// m[2] are perpendicular to m[0], and floats lose nothing by the sum, whatever the field of view.
glm::dmat4 sky_rays(const View& view, int width, int height);

}  // namespace cubecam
