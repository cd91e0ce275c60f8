#include "cubecam/render/passes/screen_depth_pass.hpp"

#include "cubecam/gl/objects.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/gl/texture_memory.hpp"
#include "cubecam/render/passes/full_screen_pass.hpp"
#include "cubecam/render/resources/sampler.hpp"

#include <string>

namespace cubecam {

void ScreenDepthPass::make(Target::Screen& screen) {
    const GladGLContext& gl = context_->gl();
    const TargetDescription& drawn = screen.target->description();
    check_texture_memory(*context_, static_cast<double>(screen.depth_bytes()), 0.0,
                         "the depths of " + std::to_string(drawn.width) + " x " +
                             std::to_string(drawn.height) + " pixels");
    screen.depths = gl::create_texture_2d_array(gl, GL_RG32F, screen_depths_side(drawn.width),
                                                screen_depths_side(drawn.height), drawn.layers(),
                                                screen_depth_levels);
    const GLuint id = screen.depths.id();
    Sampler sampler = clamped_linear;
    sampler.min = MinFilter::linear_mipmap_nearest;
    set_sampler(gl, id, sampler);
    screen.levels.clear();
    for (int level = 0; level < screen_depth_levels; ++level) {
        screen.levels.emplace_back(gl, std::vector<Layers::Attachment>{{attachment(0), id, level}},
                                   drawn.layers());
    }
}

void ScreenDepthPass::update(Target::Screen& screen, Stats& stats) {
    if (!screen.depths) make(screen);
    const GladGLContext& gl = context_->gl();
    const Target& target = *screen.target;
    // No texel of a texture that is copied is filtered.
    set_sampler(gl, target.depth().id(), clamped_nearest);
    const GLuint ids = target.output(1).id();
    set_sampler(gl, ids, clamped_nearest);
    set_full_screen_state(gl);
    const GLuint depths = screen.depths.id();
    for (int level = 0; level < screen_depth_levels; ++level) {
        if (level == 0) {
            gl.BindTextureUnit(0, target.depth().id());
            gl.BindTextureUnit(1, ids);
        } else {
            // No level is read and written at once.
            gl.TextureParameteri(depths, GL_TEXTURE_BASE_LEVEL, level - 1);
            gl.TextureParameteri(depths, GL_TEXTURE_MAX_LEVEL, level - 1);
            gl.BindTextureUnit(0, depths);
        }
        const int width = screen_depths_side(target.description().width) >> level;
        const int height = screen_depths_side(target.description().height) >> level;
        gl.Viewport(0, 0, width, height);
        gl.Scissor(0, 0, width, height);
        const gl::Program& program =
            programs_->screen_depths(level == 0   ? ScreenDepthStep::pixels
                                     : level == 1 ? ScreenDepthStep::first_cells
                                                  : ScreenDepthStep::cells);
        program.use();
        for (int layer = 0; layer < target.description().layers(); ++layer) {
            gl.BindFramebuffer(GL_FRAMEBUFFER,
                               screen.levels[static_cast<std::size_t>(level)].one(layer));
            program.set("u_layer", layer);
            draw_full_screen(gl, *cache_, {}, stats);
            context_->pace().submitted(gl, static_cast<double>(width) * height);
        }
    }
    gl.TextureParameteri(depths, GL_TEXTURE_BASE_LEVEL, 0);
    gl.TextureParameteri(depths, GL_TEXTURE_MAX_LEVEL, screen_depth_levels - 1);
    gl::check_gl(gl, "making the depths of reflections");
}

}  // namespace cubecam
