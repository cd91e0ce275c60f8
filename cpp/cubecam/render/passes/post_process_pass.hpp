#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/passes/tonemap.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/key.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/render/resources/target.hpp"

#include <span>
#include <vector>

namespace cubecam {

/// The steps that follow when a scene is drawn and resolved, in this order: effects, each in linear
/// float over all pixels, then exposure, the tone curve and the transfer function.
struct PostProcess {
    std::vector<EffectSnapshot> effects;
    float gain = 1.0F;  ///< multiplies the light: 2^exposure
    Tonemap tonemap = Tonemap::none;
    Encode encode = Encode::none;
    bool decode = false;  ///< the colour is sRGB-encoded and is decoded first

    bool any() const {
        return !effects.empty() || gain != 1.0F || tonemap != Tonemap::none ||
               encode != Encode::none;
    }
};

/// Adds what determines the pixels, apart from effects.
void add_grading(Key& key, const PostProcess& post_process);

/// The full-screen passes that turn a post-processed target's colour into the picture that is read.
class PostProcessPass {
public:
    PostProcessPass(const GladGLContext& gl, GpuCache& cache, Programs& programs)
        : gl_(&gl), cache_(&cache), programs_(&programs) {}

    /// Processes one layer. `textures` are the textures that each effect looks up; `changed` are
    /// the parts of the colour that are not those of the last time. Without effects the others need
    /// no processing: a pixel of the result depends on the same pixel of the colour alone. Draws
    /// large pictures in bands of rows in software, so that they can be interrupted.
    void draw(const PostProcess& post_process,
              const std::vector<std::vector<BoundTexture>>& textures, Target& target, int layer,
              std::span<const Rect> changed, const gl::Context& context, Stats& stats);

private:
    /// The program of an effect, tried in the state in which draw_quad() will draw.
    UserProgram& program_of(const EffectValue& effect, const std::vector<BoundTexture>& textures,
                            GLuint framebuffer, const Target& target);
    struct Place {
        int width, height, layer;
        const gl::Context& context;
    };
    void draw_quad(GLuint framebuffer, GLuint source, const gl::Program& program,
                   const Place& place, std::span<const Rect> parts, Stats& stats);

    const GladGLContext* gl_;
    GpuCache* cache_;
    Programs* programs_;
};

}  // namespace cubecam
