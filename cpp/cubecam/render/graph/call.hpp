#pragma once

#include "cubecam/render/graph/renderer_state.hpp"
#include "cubecam/render/passes/draw_plan.hpp"
#include "cubecam/render/passes/surface_pass.hpp"
#include "cubecam/render/resources/bound_texture.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace cubecam {

class Session;

/// One scene's part of one call of a renderer: draws the pictures whose keys differ from what their
/// target holds, once the probes and render textures that they need are up to date.
class Call {
public:
    /// `number` is the scene's in the session; `ranks[p]` tells how many scenes before it use its
    /// probe p, too; `light_ranks` the same of lights.
    Call(Session& session, const SceneSnapshot& scene, std::size_t number,
         std::vector<std::size_t> ranks, std::vector<std::size_t> light_ranks);

    /// Draws `views` of the nodes that `wanted` lets through into `target`, what they need first.
    void draw(std::span<const View> views, Target& target,
              const std::function<bool(const NodeSnapshot&)>& wanted,
              const PostProcess& post_process = {});

    /// Draws these probes (indices into the snapshot's), due or not, and what they need.
    void force(const std::vector<std::size_t>& probes);

    /// The map of one light (index into the snapshot's), which has a shadow.
    Buffer<float> shadow_map(std::size_t light);

    // For the session.

    /// What the nodes of a plan show, each once, by the session's numbers.
    std::vector<std::size_t> needs_of(const DrawPlan& plan) const;
    /// Decides whether a probe is drawn, and gives what it needs, if so.
    std::vector<std::size_t> find_work(std::size_t probe);
    /// Draws it if it is due.
    void draw_probe(std::size_t probe);
    /// Draws the views whose keys changed; what they need is up to date. Returns how many it drew.
    std::size_t draw_planned(std::span<const View> views, const DrawPlan& plan, Target& target,
                             const PostProcess& post_process = {});

    Stats& stats;  ///< the session's

private:
    /// A probe as this call sees it.
    struct ProbeWork {
        ProbeState* state = nullptr;
        bool due = false;
        bool forced = false;
        std::vector<View> views;
        DrawPlan plan;
    };

    /// How many faces may be drawn, and which comes first.
    struct Budget {
        std::size_t faces;
        std::size_t first;
    };

    ProbeState& state_of(std::size_t probe);
    bool count_and_decide(const ProbeSnapshot& probe, ProbeWork& work);
    BoundTexture look_up(const CubeSourceSnapshot& source, std::optional<std::size_t> in_probe);
    BoundTexture look_up(const TextureSourceSnapshot& texture, std::optional<std::size_t> in_probe);
    NodeTextures look_up(const NodeSnapshot& node, std::optional<std::size_t> in_probe);

    /// Draws the views whose keys changed, at most as many as the budget allows. Returns how many
    /// it drew.
    std::size_t draw_changed(std::span<const View> views, const DrawPlan& plan, Target& target,
                             const std::vector<NodeTextures>& lookups,
                             const PostProcess& post_process, std::optional<Budget> budget);
    std::vector<NodeTextures> look_up_all(const DrawPlan& plan,
                                          std::optional<std::size_t> in_probe);
    std::vector<std::vector<BoundTexture>> look_up_all(const PostProcess& post_process);
    std::vector<PictureKey> keys_of(std::span<const View> views, const DrawPlan& plan,
                                    const std::vector<NodeTextures>& lookups,
                                    const PostProcess& post_process);
    /// Whether a shadow shows on anything planned.
    bool receives_any(const DrawPlan& plan) const;
    /// Brings the maps up to date the first time that a node of some plan receives shadows.
    void need_shadows(const DrawPlan& plan);
    void update_shadows();
    BoundTexture background_lookup();

    Session& session_;
    RendererState& gpu_;
    const SceneSnapshot& scene_;
    std::size_t number_;
    std::vector<std::size_t> ranks_, light_ranks_;
    std::vector<std::optional<ProbeWork>> work_;
    std::optional<std::vector<ShadowUse>> shadows_;  ///< none: not needed so far
};

}  // namespace cubecam
