#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/objects.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/stats.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace cubecam {

/// Two cubes of one probe: the second shows one bounce more.
struct BouncePair {
    std::size_t bounce;  ///< of the second, from 1
    GLuint less;
    GLuint more;
};

/// Measures how much one more bounce changes what mirrors show. It looks at the cubes in 6144
/// directions, whatever their size, so that it costs little beside the drawing of the cubes.
class BounceChangePass {
public:
    BounceChangePass(const gl::Context& context, const GpuCache& cache, Programs& programs)
        : context_(&context), cache_(&cache), programs_(&programs) {}

    /// For each bounce from 1 to the largest of `pairs`: the root of the mean, over its pairs, the
    /// directions and red, green and blue, of the squared difference. NaN for one without a pair.
    std::vector<double> measure(std::span<const BouncePair> pairs, Stats& stats);

private:
    void make();
    /// Of each pair; there are few enough pairs for the texture.
    std::vector<double> sums_of_squares(std::span<const BouncePair> pairs, Stats& stats);

    const gl::Context* context_;
    const GpuCache* cache_;
    Programs* programs_;
    gl::Texture squares_;
    gl::Framebuffer framebuffer_;
};

}  // namespace cubecam
