#include "cubecam/render/passes/distance_pass.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/render/passes/full_screen_pass.hpp"
#include "cubecam/render/resources/environment.hpp"
#include "cubecam/render/resources/sampler.hpp"

#include <glm/glm.hpp>

namespace cubecam {

namespace {

constexpr Rect blocks_at(int y) { return {0, y, 3 * distance_blocks, y + 2 * distance_blocks}; }

}  // namespace

void DistancePass::make(DistanceMap& map, int size, bool layers) {
    const GladGLContext& gl = context_->gl();
    map = {};  // frees the old memory first
    const auto add = [&](gl::Texture& texture, gl::Framebuffer& framebuffer, GLenum format,
                         int width, int height, const Sampler& sampler) {
        texture = gl::create_texture_2d(gl, format, width, height);
        set_sampler(gl, texture.id(), sampler);
        framebuffer = gl::create_framebuffer(gl);
        gl.NamedFramebufferTexture(framebuffer.id(), GL_COLOR_ATTACHMENT0, texture.id(), 0);
        gl::check_framebuffer(gl, framebuffer, "making a map of distances");
    };
    add(map.texture_, map.framebuffer_, layers ? GL_RG32F : GL_R32F, distances_width(size),
        distances_height(size), clamped_linear);
    add(map.blocks_, map.blocks_framebuffer_, GL_R32F, 3 * distance_blocks, 2 * distance_blocks,
        clamped_nearest);
    map.size_ = size;
    map.layers_ = layers;
}

void DistancePass::draw(const DistanceMap& map, DistanceStep step, const Rect& to, Stats& stats) {
    const GladGLContext& gl = context_->gl();
    const bool blocks = step == DistanceStep::blocks;
    gl.BindFramebuffer(GL_FRAMEBUFFER,
                       blocks ? map.blocks_framebuffer_.id() : map.framebuffer_.id());
    gl.Scissor(to.x0, to.y0, to.width(), to.height());
    gl.Viewport(to.x0, to.y0, to.width(), to.height());
    const gl::Program& program = programs_->distances(step, map.layers_);
    program.use();
    program.set("u_size", map.size_);
    draw_full_screen(gl, *cache_, {}, stats);
    context_->pace().submitted(gl, static_cast<double>(to.area()));
}

void DistancePass::update(DistanceMap& map, const Target& nearest, const Target* farthest,
                          const DistanceRange& range, std::uint64_t contents, Stats& stats) {
    const GladGLContext& gl = context_->gl();
    const int size = nearest.description().width;
    const bool layers = farthest != nullptr;
    if (map.size_ != size || map.layers_ != layers) make(map, size, layers);
    if (map.made_of_ == contents) return;
    GLuint unit = 0;
    for (const Target* target : {&nearest, farthest}) {
        if (target == nullptr) continue;
        // The mean of a surface's depth and the background's is that of no surface.
        set_sampler(gl, target->depth().id(), clamped_nearest);
        gl.BindTextureUnit(unit++, target->depth().id());
    }
    set_full_screen_state(gl);
    const gl::Program& program = programs_->distances(DistanceStep::faces, layers);
    program.set("u_range", glm::vec2(1.0 / range.near, 1.0 / range.far));
    draw(map, DistanceStep::faces, {0, 0, 3 * (size + 2), 2 * (size + 2)}, stats);
    gl.BindTextureUnit(0, map.texture_.id());
    draw(map, DistanceStep::blocks, blocks_at(0), stats);
    gl.BindTextureUnit(0, map.blocks_.id());  // no texture is read and written at once
    draw(map, DistanceStep::around, blocks_at(2 * (size + 2)), stats);
    gl::check_gl(gl, "making a map of distances");
    map.made_of_ = contents;
    map.revision_ = next_revision();
}

}  // namespace cubecam
