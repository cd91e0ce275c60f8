#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/render/passes/post_process_pass.hpp"
#include "cubecam/render/passes/shadow_pass.hpp"
#include "cubecam/render/passes/surface_pass.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/key.hpp"
#include "cubecam/render/resources/result_pool.hpp"
#include "cubecam/render/resources/target_store.hpp"
#include "cubecam/render/resources/weak_cache.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/render_texture.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cubecam {

/// What a renderer holds of a probe.
struct ProbeState {
    std::unique_ptr<Target> target;  ///< null: not drawn yet
    std::uint64_t revision = 0;      ///< new whenever a face was drawn; 0: not drawn yet
    std::int64_t calls = 0;          ///< that depended on it, for every_n_frames
    std::size_t next_face = 0;       ///< where faces_per_frame goes on
    glm::dvec3 position{0.0};        ///< where it was last drawn from, world
};

/// What a renderer holds of a light's shadow map.
struct ShadowState {
    ShadowMap map;
    std::vector<std::optional<Key>> keys;  ///< of what each layer holds; none: not to be trusted
    std::optional<Key> whole;  ///< of the lens and all casters: where it is equal, so are all keys
    std::uint64_t revision = 0;  ///< new whenever a layer was drawn
};

/// What a renderer holds of an object for each of the scenes that use it in one call: they see
/// other things. Where only one does, as mostly, that is the first.
template <class State>
class StatesByScene {
public:
    State& of(std::size_t rank) {
        while (states_.size() <= rank) states_.push_back(std::make_unique<State>());
        return *states_[rank];
    }

private:
    std::vector<std::unique_ptr<State>> states_;
};

/// What a renderer holds of a render texture.
struct TextureState {
    std::unique_ptr<Target> target;  ///< null: not drawn yet
    gl::Texture view;                ///< its colour, as materials look it up
    Wrap wrap = Wrap::clamp;         ///< of `view`
    std::uint64_t revision = 0;      ///< new whenever lookups may give something else
};

/// All of a renderer that lives and dies with its context.
struct RendererState {
    RendererState(gl::Context& its_context, Layering layering, std::size_t cache_bytes)
        : context(its_context), cache(its_context), surface(its_context, cache, layering),
          post_process(its_context.gl(), cache, surface.programs()),
          shadows(its_context, cache, surface.programs()), targets(cache_bytes),
          results(std::make_shared<ResultPool>(cache_bytes)) {}

    gl::Context& context;
    GpuCache cache;
    SurfacePass surface;
    PostProcessPass post_process;
    ShadowPass shadows;
    TargetStore targets;
    std::shared_ptr<ResultPool> results;  ///< shared: results that outlive the renderer look for it
    WeakCache<Probe, StatesByScene<ProbeState>> probes;
    WeakCache<Light, StatesByScene<ShadowState>> shadow_maps;
    WeakCache<RenderTexture, TextureState> textures;
    /// New whenever a probe, shadow map or render texture may hold something else.
    std::uint64_t contents = 0;
};

}  // namespace cubecam
