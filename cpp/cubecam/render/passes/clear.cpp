#include "cubecam/render/passes/clear.hpp"

#include "cubecam/image/depth_format.hpp"

#include <limits>

namespace cubecam {
namespace {

constexpr GLint no_id[4] = {0, 0, 0, 0};
constexpr float far_depth = 0.0F;  // depth is reversed
constexpr GLint no_stencil = 0;

/// Calls `put(slot, four floats)` for colour and every output that holds floats.
template <class Put>
void for_each_float(const Target& target, const ClearValues& values, Put&& put) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    if (values.with_color && target.description().color) put(Slot::color, values.color);
    if (!values.with_outputs) return;
    const Outputs& outputs = target.description().outputs;
    if (outputs.distance) put(Slot::distance, glm::vec4(infinity));
    if (outputs.z) put(Slot::z, glm::vec4(infinity));
    if (outputs.normal) put(Slot::normal, glm::vec4(0.0F));
    if (outputs.position) put(Slot::position, glm::vec4(nan));
}

bool clears_id(const Target& target, const ClearValues& values) {
    return values.with_outputs && target.description().outputs.id;
}

}  // namespace

void clear_bound(const GladGLContext& gl, const Target& target, const ClearValues& values) {
    gl.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    gl.DepthMask(GL_TRUE);
    for_each_float(target, values, [&gl](Slot slot, const glm::vec4& value) {
        gl.ClearBufferfv(GL_COLOR, static_cast<GLint>(slot), &value.x);
    });
    if (clears_id(target, values)) {
        gl.ClearBufferiv(GL_COLOR, static_cast<GLint>(Slot::id), no_id);
    }
    const DepthFormat depth = target.description().depth_format;
    gl.StencilMask(0xFF);
    if (has_depth(depth) && has_stencil(depth)) {
        gl.ClearBufferfi(GL_DEPTH_STENCIL, 0, far_depth, no_stencil);
    } else if (has_depth(depth)) {
        gl.ClearBufferfv(GL_DEPTH, 0, &far_depth);
    } else if (has_stencil(depth)) {
        gl.ClearBufferiv(GL_STENCIL, 0, &no_stencil);
    }
}

void clear_layer(const GladGLContext& gl, const Target& target, int layer, const Rect& rect,
                 const ClearValues& values) {
    const auto clear = [&](const gl::Texture& texture, GLenum format, GLenum type,
                           const void* value) {
        gl.ClearTexSubImage(texture.id(), 0, rect.x0, rect.y0, layer, rect.width(), rect.height(),
                            1, format, type, value);
    };
    for_each_float(target, values, [&](Slot slot, const glm::vec4& value) {
        const bool color = slot == Slot::color;
        clear(color ? target.color() : target.output(slot), GL_RGBA, GL_FLOAT, &value.x);
    });
    if (clears_id(target, values)) {
        clear(target.output(Slot::id), GL_RED_INTEGER, GL_INT, no_id);
    }
    const DepthFormat depth = target.description().depth_format;
    if (has_depth(depth) && has_stencil(depth)) {
        const struct {
            float depth;
            GLuint stencil;
        } both{far_depth, no_stencil};
        clear(target.depth(), GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, &both);
    } else if (has_depth(depth)) {
        clear(target.depth(), GL_DEPTH_COMPONENT, GL_FLOAT, &far_depth);
    } else if (has_stencil(depth)) {
        clear(target.depth(), GL_STENCIL_INDEX, GL_INT, &no_stencil);
    }
}

}  // namespace cubecam
