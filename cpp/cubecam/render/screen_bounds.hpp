#pragma once

#include "cubecam/math/rect.hpp"
#include "cubecam/render/view.hpp"
#include "cubecam/scene/mesh.hpp"

namespace cubecam {

/// A rectangle that holds every pixel of a picture of `width` x `height` that what lies within
/// `bounds` (world) can touch. GL's rows: y grows upwards.
Rect screen_bounds(const View& view, const Bounds& bounds, int width, int height);

}  // namespace cubecam
