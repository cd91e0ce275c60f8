#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/render/gpu_cache.hpp"
#include "cubecam/render/shadow_pass.hpp"
#include "cubecam/render/surface_pass.hpp"
#include "cubecam/render/target_store.hpp"
#include "cubecam/render/weak_cache.hpp"
#include "cubecam/scene/probe.hpp"

#include <cstdint>
#include <memory>

namespace cubecam {

/// What a renderer holds of a probe.
struct ProbeState {
    std::unique_ptr<Target> target;  ///< null: not drawn yet
    std::uint64_t revision = 0;      ///< new whenever a face was drawn; 0: not drawn yet
    std::int64_t calls = 0;          ///< that needed it, for every_n_frames
    std::size_t next_face = 0;       ///< where faces_per_frame goes on
};

/// All of a renderer that lives and dies with its context.
struct GpuState {
    GpuState(gl::Context& its_context, Layering layering, std::size_t cache_bytes)
        : context(its_context), cache(its_context), surface(its_context, cache, layering),
          shadows(its_context, cache, surface.programs()), targets(cache_bytes) {}

    gl::Context& context;
    GpuCache cache;
    SurfacePass surface;
    ShadowPass shadows;
    TargetStore targets;
    WeakCache<Probe, ProbeState> probes;
};

}  // namespace cubecam
