#pragma once

#include "cubecam/render/resources/target.hpp"

namespace cubecam {

/// What a pass starts from: the background where it is a colour, no depth, a stencil of 0, and each
/// output's "nothing was hit".
struct ClearValues {
    glm::vec4 color;
    bool with_color;    ///< clear the colour, too
    bool with_outputs;  ///< and what the target has of outputs
};

/// Clears the framebuffer that is bound, all of its layers, within the scissor.
///
/// Not by glClearNamedFramebuffer, which binds and puts back: on llvmpipe each binding ends a
/// scene, and the third waits until the first is drawn.
void clear_bound(const GladGLContext& gl, const Target& target, const ClearValues& values);

/// Clears a part of one layer of a cube without multisampling, by glClearTexSubImage: on llvmpipe
/// in a sixth of glClear's time. It waits for what is being drawn there, so it comes before all
/// drawing.
void clear_layer(const GladGLContext& gl, const Target& target, int layer, const Rect& rect,
                 const ClearValues& values);

}  // namespace cubecam
