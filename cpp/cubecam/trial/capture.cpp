#include "cubecam/trial/capture.hpp"

#include <bit>

namespace cubecam::trial {
namespace {

std::uint32_t get(const GladGLContext& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return static_cast<std::uint32_t>(value);
}

std::uint32_t texture_parameter(const GladGLContext& gl, GLuint texture, GLenum name) {
    GLint value = 0;
    gl.GetTextureParameteriv(texture, name, &value);
    return static_cast<std::uint32_t>(value);
}

std::uint32_t level_parameter(const GladGLContext& gl, GLuint texture, GLenum name) {
    GLint value = 0;
    gl.GetTextureLevelParameteriv(texture, 0, name, &value);
    return static_cast<std::uint32_t>(value);
}

/// Returns the texture at an attachment point, or 0.
GLuint attached(const GladGLContext& gl, GLuint framebuffer, GLenum point, State& state) {
    const auto parameter = [&](GLenum name) {
        GLint value = 0;
        gl.GetNamedFramebufferAttachmentParameteriv(framebuffer, point, name, &value);
        return static_cast<GLuint>(value);
    };
    if (parameter(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_TYPE) != GL_TEXTURE) return 0;
    const GLuint texture = parameter(GL_FRAMEBUFFER_ATTACHMENT_OBJECT_NAME);
    state.layered = parameter(GL_FRAMEBUFFER_ATTACHMENT_LAYERED);
    state.target = texture_parameter(gl, texture, GL_TEXTURE_TARGET);
    state.samples = level_parameter(gl, texture, GL_TEXTURE_SAMPLES);
    return texture;
}

void capture_framebuffer(const GladGLContext& gl, State& state) {
    const GLuint framebuffer = get(gl, GL_DRAW_FRAMEBUFFER_BINDING);
    for (GLuint i = 0; i < most_outputs; ++i) {
        const GLenum buffer = get(gl, GL_DRAW_BUFFER0 + i);
        if (buffer == GL_NONE) continue;
        const GLuint texture = attached(gl, framebuffer, buffer, state);
        if (texture == 0) continue;
        state.color_formats[i] = level_parameter(gl, texture, GL_TEXTURE_INTERNAL_FORMAT);
        GLboolean mask[4] = {};
        gl.GetBooleani_v(GL_COLOR_WRITEMASK, i, mask);
        for (std::uint32_t c = 0; c < 4; ++c) {
            state.color_masks[i] |= mask[c] == GL_TRUE ? 1U << c : 0U;
        }
    }
    for (const GLenum point : {GL_DEPTH_ATTACHMENT, GL_STENCIL_ATTACHMENT}) {
        const GLuint texture = attached(gl, framebuffer, point, state);
        if (texture == 0) continue;
        state.depth_format = level_parameter(gl, texture, GL_TEXTURE_INTERNAL_FORMAT);
    }
}

void capture_blending(const GladGLContext& gl, State& state) {
    GLboolean blend = GL_FALSE;
    gl.GetBooleani_v(GL_BLEND, 0, &blend);
    state.blend = blend == GL_TRUE ? 1 : 0;
    if (state.blend == 0) return;
    state.blend_source = get(gl, GL_BLEND_SRC_RGB);
    state.blend_target = get(gl, GL_BLEND_DST_RGB);
    state.blend_source_alpha = get(gl, GL_BLEND_SRC_ALPHA);
    state.blend_target_alpha = get(gl, GL_BLEND_DST_ALPHA);
    state.blend_equation = get(gl, GL_BLEND_EQUATION_RGB);
    state.blend_equation_alpha = get(gl, GL_BLEND_EQUATION_ALPHA);
}

void capture_tests(const GladGLContext& gl, State& state) {
    state.depth_test = gl.IsEnabled(GL_DEPTH_TEST);
    if (state.depth_test != 0) {
        state.depth_func = get(gl, GL_DEPTH_FUNC);
        state.depth_mask = get(gl, GL_DEPTH_WRITEMASK);
    }
    state.stencil_test = gl.IsEnabled(GL_STENCIL_TEST);
    if (state.stencil_test == 0) return;
    state.stencil_func = get(gl, GL_STENCIL_FUNC);
    state.stencil_reference = get(gl, GL_STENCIL_REF);
    state.stencil_read_mask = get(gl, GL_STENCIL_VALUE_MASK);
    state.stencil_write_mask = get(gl, GL_STENCIL_WRITEMASK);
    state.stencil_fail = get(gl, GL_STENCIL_FAIL);
    state.stencil_depth_fail = get(gl, GL_STENCIL_PASS_DEPTH_FAIL);
    state.stencil_depth_pass = get(gl, GL_STENCIL_PASS_DEPTH_PASS);
}

void capture_attributes(const GladGLContext& gl, State& state) {
    const GLuint array = get(gl, GL_VERTEX_ARRAY_BINDING);
    if (array == 0) return;
    for (GLuint i = 0; i < most_attributes; ++i) {
        const auto parameter = [&](GLenum name) {
            GLint value = 0;
            gl.GetVertexArrayIndexediv(array, i, name, &value);
            return static_cast<std::uint32_t>(value);
        };
        if (parameter(GL_VERTEX_ATTRIB_ARRAY_ENABLED) == 0) continue;
        GLint binding = 0;
        GLint stride = 0;
        gl.GetVertexAttribiv(i, GL_VERTEX_ATTRIB_BINDING, &binding);
        gl.GetIntegeri_v(GL_VERTEX_BINDING_STRIDE, static_cast<GLuint>(binding), &stride);
        Attribute& attribute = state.attributes[i];
        attribute.components = parameter(GL_VERTEX_ATTRIB_ARRAY_SIZE);
        attribute.type = parameter(GL_VERTEX_ATTRIB_ARRAY_TYPE);
        attribute.integer = parameter(GL_VERTEX_ATTRIB_ARRAY_INTEGER);
        attribute.divisor = parameter(GL_VERTEX_ATTRIB_ARRAY_DIVISOR);
        attribute.binding = static_cast<std::uint32_t>(binding);
        attribute.offset = parameter(GL_VERTEX_ATTRIB_RELATIVE_OFFSET);
        attribute.stride = static_cast<std::uint32_t>(stride);
    }
}

}  // namespace

State capture_state(const GladGLContext& gl) {
    State state;
    capture_framebuffer(gl, state);
    capture_blending(gl, state);
    capture_tests(gl, state);
    state.clip_distance = gl.IsEnabled(GL_CLIP_DISTANCE0);
    capture_attributes(gl, state);
    return state;
}

Texture capture_texture(const GladGLContext& gl, GLuint unit, GLuint texture) {
    const auto parameter = [&](GLenum name) { return texture_parameter(gl, texture, name); };
    const auto level = [&](GLenum name) { return level_parameter(gl, texture, name); };
    Texture found;
    found.unit = unit;
    found.target = parameter(GL_TEXTURE_TARGET);
    found.format = level(GL_TEXTURE_INTERNAL_FORMAT);
    found.min_filter = parameter(GL_TEXTURE_MIN_FILTER);
    found.mag_filter = parameter(GL_TEXTURE_MAG_FILTER);
    found.wrap = {parameter(GL_TEXTURE_WRAP_S), parameter(GL_TEXTURE_WRAP_T),
                  parameter(GL_TEXTURE_WRAP_R)};
    found.swizzle = {parameter(GL_TEXTURE_SWIZZLE_R), parameter(GL_TEXTURE_SWIZZLE_G),
                     parameter(GL_TEXTURE_SWIZZLE_B), parameter(GL_TEXTURE_SWIZZLE_A)};
    found.compare = parameter(GL_TEXTURE_COMPARE_MODE);
    found.levels = parameter(GL_TEXTURE_IMMUTABLE_LEVELS) > 1 ? 2 : 1;
    found.sides = (std::has_single_bit(level(GL_TEXTURE_WIDTH)) ? 0U : 1U) |
                  (std::has_single_bit(level(GL_TEXTURE_HEIGHT)) ? 0U : 2U);
    return found;
}

}  // namespace cubecam::trial
