#include "cubecam/render/passes/distance_pass.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/render/passes/full_screen_pass.hpp"
#include "cubecam/render/resources/environment.hpp"

#include <glm/glm.hpp>

namespace cubecam {

void DistancePass::make(DistanceMap& map, int size, bool layers) {
    const GladGLContext& gl = context_->gl();
    map = {};  // frees the old memory first
    map.texture_ = gl::create_texture_2d(gl, layers ? GL_RG32F : GL_R32F, distances_width(size),
                                         distances_height(size));
    const GLuint id = map.texture_.id();
    gl.TextureParameteri(id, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    gl.TextureParameteri(id, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    gl.TextureParameteri(id, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    gl.TextureParameteri(id, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    map.framebuffer_ = gl::create_framebuffer(gl);
    gl.NamedFramebufferTexture(map.framebuffer_.id(), GL_COLOR_ATTACHMENT0, id, 0);
    gl::check_framebuffer(gl, map.framebuffer_, "making a map of distances");
    map.size_ = size;
    map.layers_ = layers;
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
        gl.TextureParameteri(target->depth().id(), GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl.TextureParameteri(target->depth().id(), GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        gl.BindTextureUnit(unit++, target->depth().id());
    }
    const int width = distances_width(size);
    const int height = distances_height(size);
    set_full_screen_state(gl);
    gl.Scissor(0, 0, width, height);
    gl.Viewport(0, 0, width, height);
    gl.BindFramebuffer(GL_FRAMEBUFFER, map.framebuffer_.id());
    const gl::Program& program = programs_->distances(layers);
    program.use();
    program.set("u_size", size);
    program.set("u_range", glm::vec2(1.0 / range.near, 1.0 / range.far));
    draw_full_screen(gl, *cache_, {}, stats);
    context_->pace().submitted(gl, static_cast<double>(width) * height);
    gl::check_gl(gl, "making a map of distances");
    map.made_of_ = contents;
    map.revision_ = next_revision();
}

}  // namespace cubecam
