#include "cubecam/render/resources/sampler.hpp"

namespace cubecam {
namespace {

GLint gl_wrap(Wrap wrap) {
    switch (wrap) {
        case Wrap::repeat: return GL_REPEAT;
        case Wrap::clamp: return GL_CLAMP_TO_EDGE;
        case Wrap::mirror: return GL_MIRRORED_REPEAT;
    }
    return GL_REPEAT;
}

GLint gl_filter(MinFilter filter) {
    switch (filter) {
        case MinFilter::linear: return GL_LINEAR;
        case MinFilter::nearest: return GL_NEAREST;
        case MinFilter::linear_mipmap_linear: return GL_LINEAR_MIPMAP_LINEAR;
        case MinFilter::linear_mipmap_nearest: return GL_LINEAR_MIPMAP_NEAREST;
        case MinFilter::nearest_mipmap_linear: return GL_NEAREST_MIPMAP_LINEAR;
        case MinFilter::nearest_mipmap_nearest: return GL_NEAREST_MIPMAP_NEAREST;
    }
    return GL_LINEAR;
}

}  // namespace

void set_sampler(const GladGLContext& gl, GLuint texture, const Sampler& sampler) {
    gl.TextureParameteri(texture, GL_TEXTURE_MIN_FILTER, gl_filter(sampler.min));
    gl.TextureParameteri(texture, GL_TEXTURE_MAG_FILTER,
                         sampler.mag == MagFilter::nearest ? GL_NEAREST : GL_LINEAR);
    gl.TextureParameteri(texture, GL_TEXTURE_WRAP_S, gl_wrap(sampler.wrap[0]));
    gl.TextureParameteri(texture, GL_TEXTURE_WRAP_T, gl_wrap(sampler.wrap[1]));
}

}  // namespace cubecam
