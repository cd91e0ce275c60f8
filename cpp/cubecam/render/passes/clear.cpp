#include "cubecam/render/passes/clear.hpp"

#include "cubecam/image/depth_format.hpp"

#include <cstddef>
#include <variant>

namespace cubecam {
namespace {

constexpr GLint no_stencil = 0;

/// Calls `put(slot, type, numbers)` for colour and every output; the four numbers are the clear
/// value.
template <class Put>
void for_each_color(const Target& target, const ClearValues& values, Put&& put) {
    if (values.with_color && target.description().color) {
        put(std::size_t{0}, OutputType::float32, values.color);
    }
    if (!values.with_outputs) return;
    for (const ShadedOutput& output : target.description().outputs.by_slot()) {
        put(output.slot, output.type, glm::vec4(output.clear));
    }
}

}  // namespace

void clear_bound(const GladGLContext& gl, const Target& target, const ClearValues& values) {
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    for_each_color(target, values, [&gl](std::size_t slot, OutputType type, const auto& value) {
        if (type == OutputType::float32) {
            gl.ClearBufferfv(GL_COLOR, static_cast<GLint>(slot), &value.x);
        } else {
            const glm::ivec4 whole(value);
            gl.ClearBufferiv(GL_COLOR, static_cast<GLint>(slot), &whole.x);
        }
    });
    const float last = depth_state(target.description().depth_order).clear;
    const DepthFormat depth = target.description().depth_format;
    gl.StencilMask(0xFF);
    if (has_depth(depth) && has_stencil(depth)) {
        gl.ClearBufferfi(GL_DEPTH_STENCIL, 0, last, no_stencil);
    } else if (has_depth(depth)) {
        gl.ClearBufferfv(GL_DEPTH, 0, &last);
    } else if (has_stencil(depth)) {
        gl.ClearBufferiv(GL_STENCIL, 0, &no_stencil);
    }
}

void clear_all(const GladGLContext& gl, Target& target, const SceneSnapshot& scene) {
    const auto* plain = std::get_if<glm::vec4>(&scene.background);
    const glm::vec4 color = plain != nullptr ? *plain : glm::vec4(0.0F);
    const TargetDescription& description = target.description();
    const bool shaded = description.outputs.shaded();
    gl.Enable(GL_SCISSOR_TEST);
    gl.Scissor(0, 0, description.width, description.height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.color_pass().all());
    clear_bound(gl, target, {color, description.color, shaded && !target.multisampled()});
    if (!description.outputs.any() || !target.multisampled()) return;
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.output_pass().all());
    clear_bound(gl, target, {color, false, shaded});
}

void clear_layer(const GladGLContext& gl, const Target& target, int layer, const Rect& rect,
                 const ClearValues& values) {
    const auto clear = [&](const gl::Texture& texture, GLenum format, GLenum type,
                           const void* value) {
        gl.ClearTexSubImage(texture.id(), 0, rect.x0, rect.y0, layer, rect.width(), rect.height(),
                            1, format, type, value);
    };
    for_each_color(target, values, [&](std::size_t slot, OutputType type, const auto& value) {
        const gl::Texture& texture = slot == 0 ? target.color() : target.output(slot);
        if (type == OutputType::float32) {
            clear(texture, GL_RGBA, GL_FLOAT, &value.x);
        } else {
            const glm::ivec4 whole(value);
            clear(texture, GL_RGBA_INTEGER, GL_INT, &whole.x);
        }
    });
    const float last = depth_state(target.description().depth_order).clear;
    const DepthFormat depth = target.description().depth_format;
    if (has_depth(depth) && has_stencil(depth)) {
        const struct {
            float depth;
            GLuint stencil;
        } both{last, no_stencil};
        clear(target.depth(), GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, &both);
    } else if (has_depth(depth)) {
        clear(target.depth(), GL_DEPTH_COMPONENT, GL_FLOAT, &last);
    } else if (has_stencil(depth)) {
        clear(target.depth(), GL_STENCIL_INDEX, GL_INT, &no_stencil);
    }
}

}  // namespace cubecam
