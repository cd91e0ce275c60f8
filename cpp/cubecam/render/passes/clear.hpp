#pragma once

#include "cubecam/render/resources/target.hpp"
#include "cubecam/scene/snapshot.hpp"

namespace cubecam {

/// The contents that a pass starts with: the background if it is a colour, the farthest depth, a
/// stencil of 0, and each output's value for "nothing was hit".
struct ClearValues {
    glm::vec4 color;
    bool with_color;    ///< whether the colour is cleared
    bool with_outputs;  ///< whether the target's outputs are cleared
};

/// Clears all layers of the bound framebuffer, within the scissor.
///
/// It does not use glClearNamedFramebuffer, which binds the framebuffer and restores the old one:
/// on llvmpipe each binding ends a scene, and the third binding waits until the first scene is
/// drawn.
void clear_bound(const GladGLContext& gl, const Target& target, const ClearValues& values);

/// Clears a part of one layer of a cube without multisampling by glClearTexSubImage, which on
/// llvmpipe takes a sixth of glClear's time. The call waits for earlier drawing into the texture,
/// so it is made before all drawing.
void clear_layer(const GladGLContext& gl, const Target& target, int layer, const Rect& rect,
                 const ClearValues& values);

/// Clears all layers of a target, for pictures that share it.
void clear_all(const GladGLContext& gl, Target& target, const SceneSnapshot& scene);

}  // namespace cubecam
