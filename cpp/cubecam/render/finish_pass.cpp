#include "cubecam/render/finish_pass.hpp"

#include <cstddef>

namespace cubecam {

void FinishPass::draw(const Finish& finish, const std::vector<std::vector<Lookup>>& textures,
                      Target& target, int layer, Stats& stats) {
    gl_->Disable(GL_DEPTH_TEST);
    gl_->Disable(GL_CULL_FACE);
    gl_->Disable(GL_BLEND);
    gl_->Viewport(0, 0, target.description().width, target.description().height);
    GLuint source = target.color().id();
    for (std::size_t i = 0; i < finish.effects.size(); ++i) {
        const EffectValue& effect = finish.effects[i].value;
        UserProgram& program = programs_->effect(effect.fragment);
        program.use(effect.inputs, textures[i]);
        const std::size_t to = i % 2;
        draw_quad(target.scratch_pass(to).one(layer), source, program.program(), layer, stats);
        source = target.scratch(to).id();
    }
    draw_quad(target.graded_pass().one(layer), source,
              programs_->grade(finish.tonemap, finish.encode), layer, stats);
}

void FinishPass::draw_quad(GLuint framebuffer, GLuint source, const gl::Program& program, int layer,
                           Stats& stats) {
    gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    program.use();
    program.set("u_layer", layer);
    gl_->BindTextureUnit(0, source);
    gl_->BindVertexArray(cache_->views_only().id());
    gl_->DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    ++stats.draw_calls;
    stats.triangles += 2;
}

}  // namespace cubecam
