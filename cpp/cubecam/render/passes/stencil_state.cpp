#include "cubecam/render/passes/stencil_state.hpp"

namespace cubecam {
namespace {

GLenum gl_func(StencilFunc func) {
    switch (func) {
        case StencilFunc::never: return GL_NEVER;
        case StencilFunc::less: return GL_LESS;
        case StencilFunc::equal: return GL_EQUAL;
        case StencilFunc::lequal: return GL_LEQUAL;
        case StencilFunc::greater: return GL_GREATER;
        case StencilFunc::notequal: return GL_NOTEQUAL;
        case StencilFunc::gequal: return GL_GEQUAL;
        case StencilFunc::always: return GL_ALWAYS;
    }
    return GL_ALWAYS;
}

GLenum gl_op(StencilOp op) {
    switch (op) {
        case StencilOp::keep: return GL_KEEP;
        case StencilOp::zero: return GL_ZERO;
        case StencilOp::replace: return GL_REPLACE;
        case StencilOp::incr: return GL_INCR;
        case StencilOp::incr_wrap: return GL_INCR_WRAP;
        case StencilOp::decr: return GL_DECR;
        case StencilOp::decr_wrap: return GL_DECR_WRAP;
        case StencilOp::invert: return GL_INVERT;
    }
    return GL_KEEP;
}

}  // namespace

void set_stencil(const GladGLContext& gl, const std::optional<Stencil>& stencil) {
    if (!stencil) {
        gl.Disable(GL_STENCIL_TEST);
        return;
    }
    gl.Enable(GL_STENCIL_TEST);
    gl.StencilFunc(gl_func(stencil->func), stencil->reference, stencil->read_mask);
    gl.StencilMask(stencil->write_mask);
    gl.StencilOp(gl_op(stencil->fail), gl_op(stencil->depth_fail), gl_op(stencil->depth_pass));
}

}  // namespace cubecam
