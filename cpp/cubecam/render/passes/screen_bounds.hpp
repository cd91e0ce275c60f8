#pragma once

#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

namespace cubecam {

/// How far off, at most, float arithmetic on the GPU may put a node's vertices in a view's clip
/// space. It is not small where large numbers cancel: a mesh modelled a million units from its own
/// origin.
glm::dvec4 clip_error(const View& view, const NodeSnapshot& node);

/// A rectangle that holds every pixel of a picture of `width` x `height` that a node can touch;
/// `error` is its clip_error. GL's rows: y grows upwards.
Rect screen_bounds(const View& view, const Bounds& world_bounds, const glm::dvec4& error, int width,
                   int height);

}  // namespace cubecam
