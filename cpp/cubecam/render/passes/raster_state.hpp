#pragma once

#include "cubecam/render/resources/depth_order.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glad/gl.h>

namespace cubecam {

/// Sets what a node's material says of culling, depth, colour channels, blending and the stencil
/// for the next draw call. `mirror`: the view shows the world mirrored.
void set_raster_state(const GladGLContext& gl, const NodeSnapshot& node, bool mirror,
                      const DepthState& depth);

/// What drawing starts from, and clears and full-screen passes count on: every channel and depth
/// written, no blending, no stencil test.
void reset_raster_state(const GladGLContext& gl, const DepthState& depth);

}  // namespace cubecam
