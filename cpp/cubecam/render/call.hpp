#pragma once

#include "cubecam/render/draw_plan.hpp"
#include "cubecam/render/gpu_state.hpp"
#include "cubecam/render/probe_order.hpp"
#include "cubecam/render/surface_pass.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace cubecam {

/// Whether a node, or one above it, is among `excluded`.
bool is_excluded(const NodeSnapshot& node, const std::vector<std::int32_t>& excluded);

/// One call of a renderer: brings the probes that its pictures need up to date, then draws the
/// pictures whose keys differ from what their target holds.
class Call {
public:
    Call(GpuState& gpu, const SceneSnapshot& scene);

    /// Draws `views` of the nodes that `wanted` lets through into `target`, their probes first.
    void draw(std::span<const View> views, Target& target,
              const std::function<bool(const NodeSnapshot&)>& wanted,
              Tonemap tonemap = Tonemap::none, Encode encode = Encode::none);

    /// Draws these probes (indices into the snapshot's), due or not, and what they need.
    void force(const std::vector<std::size_t>& probes);

    /// The map of one light (index into the snapshot's), which has a shadow.
    Buffer<float> shadow_map(std::size_t light);

    Stats stats;

private:
    /// What a node's lookup finds in one picture.
    struct Lookup {
        GLuint texture = 0;
        std::uint64_t revision = 0;  ///< of the contents; 0: none
    };

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

    void update_probes(const std::vector<std::size_t>& roots);
    void find_work(std::size_t probe, std::vector<std::vector<std::size_t>>& needs);
    bool count_and_decide(const ProbeSnapshot& probe, ProbeWork& work);
    void draw_probe(std::size_t probe, const ProbeOrder& order);

    /// Probes that the nodes of a plan show, each once, in the order of the scene.
    std::vector<std::size_t> probes_of(const DrawPlan& plan) const;
    const FrozenSource& source_of(const NodeSnapshot& node) const;
    Lookup look_up(const FrozenSource& source, std::optional<std::size_t> in_probe,
                   const ProbeOrder* order);

    /// Draws the views whose keys changed, at most as many as the budget allows. Returns how many
    /// it drew.
    std::size_t draw_changed(std::span<const View> views, const DrawPlan& plan, Target& target,
                             const std::vector<Lookup>& lookups, Tonemap tonemap, Encode encode,
                             std::optional<Budget> budget);
    std::vector<Lookup> look_up_all(const DrawPlan& plan, std::optional<std::size_t> in_probe,
                                    const ProbeOrder* order);
    std::vector<PictureKey> keys_of(std::span<const View> views, const DrawPlan& plan,
                                    const std::vector<Lookup>& lookups, Tonemap tonemap,
                                    Encode encode);
    /// Brings the maps up to date the first time that a node of some plan receives shadows.
    void need_shadows(const DrawPlan& plan);
    void grade(Target& target, Tonemap tonemap, Encode encode);
    Lookup background_lookup();

    GpuState& gpu_;
    const SceneSnapshot& scene_;
    std::vector<std::optional<ProbeWork>> work_;
    std::optional<std::vector<ShadowUse>> shadows_;  ///< none: not needed so far
};

}  // namespace cubecam
