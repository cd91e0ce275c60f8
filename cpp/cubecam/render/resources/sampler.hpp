#pragma once

#include "cubecam/gl/handle.hpp"
#include "cubecam/image/image.hpp"

namespace cubecam {

/// Sets how a texture is looked up.
void set_sampler(const GladGLContext& gl, GLuint texture, const Sampler& sampler);

}  // namespace cubecam
