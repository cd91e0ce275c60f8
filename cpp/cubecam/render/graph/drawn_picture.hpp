#pragma once

#include "cubecam/render/graph/renderer_state.hpp"
#include "cubecam/render/graph/texture_lookup.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace cubecam {

/// How many views may be drawn in one call, and which comes first.
struct Budget {
    std::size_t views;
    std::size_t first;
};

/// Views of a scene as they are drawn. What they look up is up to date.
struct DrawnPicture {
    RendererState& gpu;
    const SceneSnapshot& scene;
    std::span<const View> views;  ///< view i goes to layer i
    const DrawPlan& plan;
    TextureLookup& lookup;
    std::span<const ShadowUse> shadows;  ///< none if no node of the plan receives any
    const PostProcess& post_process;
    Stats& stats;

    /// Draws the views whose keys differ from what the target holds, at most as many as the budget
    /// allows. Returns how many it drew; with a budget, how many it came past to the last of them.
    std::size_t draw_changed(Target& target, std::optional<Budget> budget = std::nullopt);

private:
    std::vector<NodeTextures> look_up_all();
    std::vector<PictureKey> keys_of(const std::vector<NodeTextures>& lookups);
};

}  // namespace cubecam
