#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/image/pixels.hpp"
#include "cubecam/render/passes/draw_plan.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/passes/shadow_block.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/key.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/render/resources/target.hpp"
#include "cubecam/render/resources/weak_cache.hpp"
#include "cubecam/scene/light.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <vector>

namespace cubecam {

/// Depth alone, of all that casts shadows, as each light sees it.
///
/// A map belongs to the light and to the scene, not to a picture: the same serves frames, captures
/// and probes. A layer is drawn again only when its key differs.
class ShadowPass {
public:
    ShadowPass(const gl::Context& context, GpuCache& cache, Programs& programs);

    /// Whether the lights' shadows are within the driver's limits.
    /// @throws std::invalid_argument naming the limit.
    void check(const SceneSnapshot& scene) const;

    /// What a caster's own vertex function looks up.
    using LookUp = std::function<std::vector<BoundTexture>(const NodeSnapshot&)>;

    /// Brings the maps of all lights that have one up to date, in the scene's order. `ranks` tells
    /// of each light how many scenes of the session before this one have it, too: each has a map of
    /// its own.
    std::vector<ShadowUse> update(const SceneSnapshot& scene, std::span<const std::size_t> ranks,
                                  const LookUp& look_up, Stats& stats);

    /// See Renderer::shadow_map.
    Buffer<float> read(const ShadowUse& use);

    void sweep() { maps_.sweep(); }

private:
    struct Map {
        int size = 0;
        gl::Texture depth;
        std::optional<Layers> layers;
        std::vector<std::optional<Key>>
            keys;                  ///< of what each layer holds; none: not to be trusted
        std::optional<Key> whole;  ///< of the lens and all casters: where it is equal, so are all
        std::uint64_t revision = 0;
    };

    /// Of one light, in each scene of a session that it is in.
    using Maps = std::map<std::size_t, Map>;

    ShadowUse update(const SceneSnapshot& scene, const LightSnapshot& light, std::size_t rank,
                     const LookUp& look_up, Stats& stats);
    Map make_map(int size, std::size_t layers) const;
    /// Draws the layers that differ.
    void draw(const SceneSnapshot& scene, const ShadowView& view, const LookUp& look_up, Map& map,
              Stats& stats);
    void draw_layer(const SceneSnapshot& scene, const ShadowView& view, const DrawPlan& plan,
                    const LookUp& look_up, std::size_t layer, Map& map, Stats& stats);
    /// A caster whose vertices a user's source moves.
    void draw_moved(const NodeSnapshot& node, const View& from, const LookUp& look_up,
                    std::size_t layer, Stats& stats);

    const gl::Context* context_;
    const GladGLContext* gl_;
    GpuCache* cache_;
    Programs* programs_;
    int largest_;
    std::size_t most_;
    gl::Buffer instances_, block_;
    WeakCache<Light, Maps> maps_;
};

}  // namespace cubecam
