#pragma once

#include "cubecam/gl/handle.hpp"
#include "cubecam/image/image.hpp"

namespace cubecam {

/// For textures that the renderer makes for itself: beyond an edge the last texel counts.
inline constexpr Sampler clamped_linear{{Wrap::clamp, Wrap::clamp}};
inline constexpr Sampler clamped_nearest{
    {Wrap::clamp, Wrap::clamp}, MagFilter::nearest, MinFilter::nearest};

/// Sets how a texture is looked up.
void set_sampler(const GladGLContext& gl, GLuint texture, const Sampler& sampler);

}  // namespace cubecam
