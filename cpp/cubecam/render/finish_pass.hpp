#pragma once

#include "cubecam/render/gpu_cache.hpp"
#include "cubecam/render/lookup.hpp"
#include "cubecam/render/options.hpp"
#include "cubecam/render/programs.hpp"
#include "cubecam/render/target.hpp"

#include <vector>

namespace cubecam {

/// What becomes of a picture once its scene is drawn and resolved, in this order: effects, each in
/// linear float over all pixels, then the tone curve, then the transfer function.
struct Finish {
    std::vector<EffectSnapshot> effects;
    Tonemap tonemap = Tonemap::none;
    Encode encode = Encode::none;

    bool any() const {
        return !effects.empty() || tonemap != Tonemap::none || encode != Encode::none;
    }
};

/// Full-screen passes from a graded target's colour to the picture that is read.
class FinishPass {
public:
    FinishPass(const GladGLContext& gl, GpuCache& cache, Programs& programs)
        : gl_(&gl), cache_(&cache), programs_(&programs) {}

    /// Of one layer. `textures`: what each effect looks up.
    void draw(const Finish& finish, const std::vector<std::vector<Lookup>>& textures,
              Target& target, int layer, Stats& stats);

private:
    void draw_quad(GLuint framebuffer, GLuint source, const gl::Program& program, int layer,
                   Stats& stats);

    const GladGLContext* gl_;
    GpuCache* cache_;
    Programs* programs_;
};

}  // namespace cubecam
