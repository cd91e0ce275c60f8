#include "cubecam/render/passes/raster_state.hpp"

#include "cubecam/render/passes/stencil_state.hpp"

namespace cubecam {
namespace {

void set(const GladGLContext& gl, GLenum capability, bool on) {
    if (on) {
        gl.Enable(capability);
    } else {
        gl.Disable(capability);
    }
}

GLenum gl_factor(BlendFactor factor) {
    switch (factor) {
        case BlendFactor::zero: return GL_ZERO;
        case BlendFactor::one: return GL_ONE;
        case BlendFactor::src_color: return GL_SRC_COLOR;
        case BlendFactor::one_minus_src_color: return GL_ONE_MINUS_SRC_COLOR;
        case BlendFactor::dst_color: return GL_DST_COLOR;
        case BlendFactor::one_minus_dst_color: return GL_ONE_MINUS_DST_COLOR;
        case BlendFactor::src_alpha: return GL_SRC_ALPHA;
        case BlendFactor::one_minus_src_alpha: return GL_ONE_MINUS_SRC_ALPHA;
        case BlendFactor::dst_alpha: return GL_DST_ALPHA;
        case BlendFactor::one_minus_dst_alpha: return GL_ONE_MINUS_DST_ALPHA;
        case BlendFactor::src_alpha_saturate: return GL_SRC_ALPHA_SATURATE;
    }
    return GL_ONE;
}

GLenum gl_equation(BlendEquation equation) {
    switch (equation) {
        case BlendEquation::add: return GL_FUNC_ADD;
        case BlendEquation::subtract: return GL_FUNC_SUBTRACT;
        case BlendEquation::reverse_subtract: return GL_FUNC_REVERSE_SUBTRACT;
        case BlendEquation::min: return GL_MIN;
        case BlendEquation::max: return GL_MAX;
    }
    return GL_FUNC_ADD;
}

/// Sets each mode as documented at Blend; if a mode multiplies its source by alpha, the fragment
/// shader does it (surface.frag).
void set_blending(const GladGLContext& gl, Blend blend, const BlendFactors& factors) {
    if (blend == Blend::opaque) {
        gl.Disablei(GL_BLEND, 0);
        return;
    }
    gl.Enablei(GL_BLEND, 0);
    const bool free = blend == Blend::factors;
    gl.BlendEquation(free ? gl_equation(factors.equation) : GL_FUNC_ADD);
    switch (blend) {
        case Blend::opaque: break;
        case Blend::alpha:
            gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE,
                                 GL_ONE_MINUS_SRC_ALPHA);
            break;
        case Blend::alpha_keep:
            gl.BlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
            break;
        case Blend::additive: gl.BlendFunc(GL_ONE, GL_ONE); break;
        case Blend::multiply: gl.BlendFuncSeparate(GL_ZERO, GL_SRC_COLOR, GL_ZERO, GL_ONE); break;
        case Blend::premultiplied: gl.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA); break;
        case Blend::factors:
            gl.BlendFuncSeparate(gl_factor(factors.src), gl_factor(factors.dst),
                                 gl_factor(factors.src_alpha), gl_factor(factors.dst_alpha));
            break;
    }
}

}  // namespace

void set_raster_state(const GladGLContext& gl, const NodeSnapshot& node, bool mirror,
                      const DepthState& depth) {
    const SurfaceOptions& surface = node.material.value.surface;
    set(gl, GL_CULL_FACE, !surface.double_sided);
    // A node's matrix with a negative determinant reverses the winding, and a mirrored view
    // reverses it again.
    const bool turned = node.turned != mirror;
    gl.FrontFace(turned ? GL_CW : GL_CCW);

    // OpenGL writes depth only while the test is enabled, so no test means GL_ALWAYS.
    gl.DepthFunc(surface.depth_test ? depth.closer : GLenum{GL_ALWAYS});
    gl.DepthMask(node.depth_write ? GL_TRUE : GL_FALSE);
    const glm::bvec4& write = surface.color_write;
    gl.ColorMaski(0, write.r, write.g, write.b, write.a);
    set_blending(gl, node.blend, surface.blend_factors);
    set_stencil(gl, surface.stencil);
}

void reset_raster_state(const GladGLContext& gl, const DepthState& depth) {
    gl.Enable(GL_DEPTH_TEST);
    gl.DepthFunc(depth.closer);
    gl.DepthMask(GL_TRUE);
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.Disable(GL_BLEND);
    gl.Disable(GL_STENCIL_TEST);
    gl.Disable(GL_CLIP_DISTANCE0);
}

}  // namespace cubecam
