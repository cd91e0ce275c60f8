#pragma once

#include "cubecam/trial/job.hpp"

#include <glad/gl.h>

namespace cubecam::trial {

/// Reads the state of the current context that a draw call would use: the framebuffer, blending,
/// depth, stencil and the vertex array.
State capture_state(const GladGLContext& gl);

/// Reads what machine code depends on in a texture that is bound to a unit.
Texture capture_texture(const GladGLContext& gl, GLuint unit, GLuint texture);

}  // namespace cubecam::trial
