#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/render/resources/target.hpp"

namespace cubecam {

/// Makes the texture in which reflections on the screen are followed (shaders/include/screen.glsl).
/// Level 0 has each pixel's depth and node id. Level n has cells of 2^n pixels: the greatest depth,
/// which is the nearest, and the least one, of all that a bilinear lookup in the cell may see.
class ScreenDepthPass {
public:
    ScreenDepthPass(const gl::Context& context, const GpuCache& cache, Programs& programs)
        : context_(&context), cache_(&cache), programs_(&programs) {}

    /// Draws `screen.depths` from the depths and ids of `screen.target`.
    void update(Target::Screen& screen, Stats& stats);

private:
    void make(Target::Screen& screen);

    const gl::Context* context_;
    const GpuCache* cache_;
    Programs* programs_;
};

}  // namespace cubecam
