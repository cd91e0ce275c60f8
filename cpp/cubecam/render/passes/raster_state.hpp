#pragma once

#include "cubecam/render/resources/depth_order.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glad/gl.h>

namespace cubecam {

/// Sets culling, depth, colour channels, blending and the stencil of a node's material for the next
/// draw call. `mirror`: whether the view shows the world mirrored.
void set_raster_state(const GladGLContext& gl, const NodeSnapshot& node, bool mirror,
                      const DepthState& depth);

/// Sets the state that drawing starts with, and on which clears and full-screen passes depend: all
/// channels and depth are written, without blending and stencil test.
void reset_raster_state(const GladGLContext& gl, const DepthState& depth);

}  // namespace cubecam
