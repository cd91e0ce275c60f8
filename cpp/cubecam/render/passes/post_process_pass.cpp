#include "cubecam/render/passes/post_process_pass.hpp"

#include "cubecam/gl/pace.hpp"
#include "cubecam/render/passes/full_screen_pass.hpp"
#include "cubecam/render/passes/texture_units.hpp"

#include <algorithm>
#include <cstddef>

namespace cubecam {

void add_grading(Key& key, const PostProcess& post_process) {
    key.add(post_process.gain);
    key.add(post_process.tonemap);
    key.add(post_process.encode);
    key.add(post_process.decode);
}

void PostProcessPass::draw(const PostProcess& post_process,
                           const std::vector<std::vector<BoundTexture>>& textures, Target& target,
                           int layer, std::span<const Rect> changed, const gl::Context& context,
                           Stats& stats) {
    const Rect whole{0, 0, target.description().width, target.description().height};
    const std::span<const Rect> all(&whole, 1);
    const Place place{target.description().width, target.description().height, layer, context};
    set_full_screen_state(*gl_);
    gl_->Viewport(0, 0, target.description().width, target.description().height);
    GLuint source = target.color().id();
    for (std::size_t i = 0; i < post_process.effects.size(); ++i) {
        const EffectValue& effect = post_process.effects[i].value;
        const std::size_t to = i % 2;
        const GLuint framebuffer = target.scratch_pass(to).one(layer);
        UserProgram& program = program_of(effect, textures[i], framebuffer, target);
        program.use(effect.inputs, textures[i]);
        draw_quad(framebuffer, source, program.program(), place, all, stats);
        source = target.scratch(to).id();
    }
    const gl::Program& grade =
        programs_->grade(post_process.tonemap, post_process.encode, post_process.decode);
    grade.use();
    grade.set("u_gain", post_process.gain);
    draw_quad(target.post_processed_pass().one(layer), source, grade, place,
              post_process.effects.empty() ? changed : all, stats);
}

UserProgram& PostProcessPass::program_of(const EffectValue& effect,
                                         const std::vector<BoundTexture>& textures,
                                         GLuint framebuffer, const Target& target) {
    DrawConditions conditions;
    if (programs_->tries()) {
        gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl_->BindVertexArray(cache_->views_only().id());
        conditions.add(target.description().shape.kind);
        conditions.textures.push_back({texture_unit::frame, target.color().id(), 0});
        conditions.add_textures(textures);
    }
    return programs_->effect(effect, conditions);
}

void PostProcessPass::draw_quad(GLuint framebuffer, GLuint source, const gl::Program& program,
                                const Place& place, std::span<const Rect> parts, Stats& stats) {
    // llvmpipe waits for the whole source in the first call that looks it up, without looking for
    // signals.
    if (place.context.software()) place.context.pace().finish(*gl_);
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    program.use();
    program.set("u_layer", place.layer);
    gl_->BindTextureUnit(0, source);
    // The scissor test is on since the scene was drawn, and its rectangle is the whole picture.
    const struct WholeScissor {
        const GladGLContext& gl;
        const Place& place;
        ~WholeScissor() { gl.Scissor(0, 0, place.width, place.height); }
    } at_end{*gl_, place};
    for (const Rect& part : parts) {
        const int most = static_cast<int>(gl::Pace::chunk / 2 / part.width());
        const int rows = place.context.software() ? std::max(1, most) : part.height();
        for (int y = part.y0; y < part.y1; y += rows) {
            const int height = std::min(rows, part.y1 - y);
            gl_->Scissor(part.x0, y, part.width(), height);
            draw_full_screen(*gl_, *cache_, {}, stats);
            place.context.pace().submitted(*gl_, static_cast<double>(part.width()) * height);
        }
    }
}

}  // namespace cubecam
