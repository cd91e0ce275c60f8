#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/objects.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/render/resources/target.hpp"

#include <cstdint>

namespace cubecam {

/// The clip distances with which a cube was drawn.
struct DistanceRange {
    double near = 0.0;
    double far = 0.0;
};

/// How near the surfaces of a captured cube are: for each texel 1 / z, where z is the distance
/// along the axis of its face, and 0 where there is none. Between texels 1 / z is linear where z
/// itself is not, so that planes are exact. Red is the nearest surface, green the farthest one.
///
/// The faces lie as those of FilteredTexture do, with a border of one texel, so that bilinear
/// lookups are seamless and cheap: a lookup in a cube costs llvmpipe several times as much. Below
/// them is how near a surface may be around a direction, for the part of a ray that meets nothing.
class DistanceMap {
public:
    GLuint id() const { return texture_.id(); }
    /// New whenever it was drawn; 0: not drawn yet.
    std::uint64_t revision() const { return revision_; }
    bool has_layers() const { return layers_; }

private:
    friend class DistancePass;

    gl::Texture texture_;
    gl::Framebuffer framebuffer_;
    gl::Texture blocks_;  ///< the nearest surface of each block, for the rows below the faces
    gl::Framebuffer blocks_framebuffer_;
    int size_ = 0;
    bool layers_ = false;
    std::uint64_t revision_ = 0;
    std::uint64_t made_of_ = 0;  ///< `contents` of the last update
};

/// Makes the distances of a cube from the depth buffers with which it was drawn.
class DistancePass {
public:
    DistancePass(const gl::Context& context, const GpuCache& cache, Programs& programs)
        : context_(&context), cache_(&cache), programs_(&programs) {}

    /// Draws the map again if `contents`, the number of the cubes' contents, is another one than
    /// last time. `farthest` may be null.
    void update(DistanceMap& map, const Target& nearest, const Target* farthest,
                const DistanceRange& range, std::uint64_t contents, Stats& stats);

private:
    void make(DistanceMap& map, int size, bool layers);
    void draw(const DistanceMap& map, DistanceStep step, const Rect& to, Stats& stats);

    const gl::Context* context_;
    const GpuCache* cache_;
    Programs* programs_;
};

}  // namespace cubecam
