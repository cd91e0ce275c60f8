#pragma once

#include "cubecam/geometry/mesh_data.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/image/result_pool.hpp"
#include "cubecam/math/plane.hpp"
#include "cubecam/render/passes/body_pass.hpp"
#include "cubecam/render/passes/bounce_change_pass.hpp"
#include "cubecam/render/passes/distance_pass.hpp"
#include "cubecam/render/passes/post_process_pass.hpp"
#include "cubecam/render/passes/screen_depth_pass.hpp"
#include "cubecam/render/passes/shadow_pass.hpp"
#include "cubecam/render/passes/surface_pass.hpp"
#include "cubecam/render/resources/filtered_cubes.hpp"
#include "cubecam/render/resources/filtered_faces.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/key.hpp"
#include "cubecam/render/resources/read_ring.hpp"
#include "cubecam/render/resources/target_store.hpp"
#include "cubecam/render/resources/weak_cache.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/render_texture.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cubecam {

/// What remains of a picture that was lost with its context.
struct LostPicture {
    bool lost = false;                 ///< there was one, and it is not drawn again yet
    std::weak_ptr<const Scene> scene;  ///< from which it was drawn last
};

/// A renderer's state of one picture of a probe; most probes have one picture.
struct ProbeState {
    std::unique_ptr<Target> target;  ///< null: not drawn yet
    Target::Behind behind;
    Target::Mirrors mirrors;
    std::uint64_t revision = 0;              ///< new whenever a face was drawn; 0: not drawn yet
    std::size_t next_face = 0;               ///< the next face to draw with faces_per_frame
    glm::dvec3 position{0.0};                ///< the position of the last drawing, world
    Encoding encoding = Encoding::linear;    ///< of the last drawing
    FilteredFaces filtered;                  ///< empty until a surface needs it
    gl::Texture box_mipmaps;                 ///< a copy with levels; null until a surface needs it
    std::uint64_t box_mipmaps_revision = 0;  ///< `revision` when it was made
    std::unique_ptr<Target> farthest;        ///< null: not drawn, since no parallax needs it
    std::uint64_t farthest_mipmaps = 0;      ///< `revision` of which it has levels
    DistanceRange range;                     ///< of the last drawing
    DistanceMap distances;                   ///< empty until a parallax needs it
};

/// A renderer's states of all pictures of a probe (docs/adr/0003-probe-cycles.md).
class ProbeLevels {
public:
    std::int64_t calls = 0;     ///< calls that needed the probe, for every_n_frames
    std::uint64_t counted = 0;  ///< the last of these calls (RendererState::call)
    LostPicture last;

    /// The state of the picture with this PictureId::bounce. It stays valid while its owner lives,
    /// even if it is dropped.
    std::shared_ptr<ProbeState> at(std::size_t bounce) {
        while (states_.size() <= bounce) states_.push_back(std::make_shared<ProbeState>());
        return states_[bounce];
    }

    /// The highest bounce below `end` whose picture was drawn; none: no such picture.
    std::optional<std::size_t> drawn_below(std::size_t end) const {
        for (std::size_t bounce = std::min(end, states_.size()); bounce-- > 0;) {
            if (states_[bounce]->target != nullptr) return bounce;
        }
        return std::nullopt;
    }

    /// The highest bounce whose picture was drawn.
    std::optional<std::size_t> drawn() const { return drawn_below(states_.size()); }

    /// Drops the pictures from this bounce on.
    void drop_from(std::size_t bounce) {
        if (states_.size() > bounce) states_.resize(bounce);
    }

    /// The state in a new context, after this one's context was lost.
    ProbeLevels in_new_context() const {
        ProbeLevels made;
        made.calls = calls;
        made.counted = counted;
        made.last = {drawn() || last.lost, last.scene};
        for (const auto& state : states_) {
            made.states_.push_back(std::make_shared<ProbeState>());
            made.states_.back()->next_face = state->next_face;
        }
        return made;
    }

private:
    std::vector<std::shared_ptr<ProbeState>> states_;
};

/// A renderer's state of a light's shadow map.
struct ShadowState {
    ShadowMap map;
    std::vector<std::optional<Key>> keys;  ///< of the contents of each layer; none: not valid
    std::optional<Key> whole;    ///< of the lens and all casters: if it is equal, all keys are
    std::uint64_t revision = 0;  ///< new whenever a layer was drawn
};

/// A renderer's states of one object, one for each scene that uses the object in a call, since each
/// scene contains other things. Most objects have one user and one state.
template <class State>
class StatesByScene {
public:
    State& of(std::size_t rank) {
        while (states_.size() <= rank) states_.push_back(std::make_unique<State>());
        return *states_[rank];
    }

    StatesByScene in_new_context() const {
        StatesByScene made;
        for (const auto& state : states_) {
            made.states_.push_back(std::make_unique<State>(state->in_new_context()));
        }
        return made;
    }

private:
    std::vector<std::unique_ptr<State>> states_;
};

/// A renderer's state of a render texture.
struct TextureState {
    std::unique_ptr<Target> target;  ///< null: not drawn yet
    Target::Behind behind;
    Target::Mirrors mirrors;
    gl::Texture view;                      ///< its colour, as materials look it up
    Wrap wrap = Wrap::clamp;               ///< of `view`
    std::uint64_t revision = 0;            ///< new whenever lookups may give another result
    Encoding encoding = Encoding::linear;  ///< of the last drawing
    gl::Texture decoded;                   ///< as maps of colours look it up; made when needed
    std::uint64_t decoded_of = 0;          ///< the revision from which `decoded` was made
    LostPicture last;

    TextureState in_new_context() const {
        TextureState state;
        state.last = {target != nullptr || last.lost, last.scene};
        return state;
    }
};

/// The parts of a renderer that live as long as its context.
struct RendererState {
    RendererState(gl::Context& its_context, Layering layering, std::size_t cache_bytes)
        : context(its_context), cache(its_context), surface(its_context, cache, layering),
          post_process(its_context.gl(), cache, surface.programs()),
          shadows(its_context, cache, surface.programs()),
          distances(its_context, cache, surface.programs()),
          screen_depths(its_context, cache, surface.programs()),
          bounce_changes(its_context, cache, surface.programs()),
          bodies(its_context, cache, surface.programs()), targets(cache_bytes),
          results(std::make_shared<ResultPool>(cache_bytes)), read_ring(its_context.gl()) {}

    /// Takes over what was not on the GPU from the state of a lost context. All else is drawn again
    /// when it is needed.
    void take_over(const RendererState& lost) {
        call = lost.call;
        probes.take_over(lost.probes, [](const auto& state) { return state.in_new_context(); });
        textures.take_over(lost.textures, [](const auto& state) { return state.in_new_context(); });
    }

    gl::Context& context;
    GpuCache cache;
    SurfacePass surface;
    PostProcessPass post_process;
    ShadowPass shadows;
    DistancePass distances;
    ScreenDepthPass screen_depths;
    BounceChangePass bounce_changes;
    BodyPass bodies;
    TargetStore targets;
    std::shared_ptr<ResultPool> results;  ///< shared: results may outlive the renderer
    ReadRing read_ring;
    WeakCache<Probe, StatesByScene<ProbeLevels>> probes;
    WeakCache<Light, StatesByScene<ShadowState>> shadow_maps;
    WeakCache<RenderTexture, TextureState> textures;
    WeakCache<const MeshData, Plane> planes;  ///< of meshes that are planar mirrors
    FilteredCubes filtered_cubes;
    /// Numbers the drawings of views. It is no revision: live views look for changes of the newest
    /// revision, and drawing alone changes nothing.
    std::uint64_t views_drawn = 0;
    /// New whenever the contents of a probe, shadow map or render texture may have changed.
    std::uint64_t contents = 0;
    /// Numbers the calls of the renderer. A call that is done again in a new context has one
    /// number.
    std::uint64_t call = 0;
};

}  // namespace cubecam
