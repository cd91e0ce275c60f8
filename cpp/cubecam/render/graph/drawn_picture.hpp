#pragma once

#include "cubecam/render/graph/renderer_state.hpp"
#include "cubecam/render/graph/texture_lookup.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace cubecam {

/// The largest number of views to draw in one call, and the first of them.
struct Budget {
    std::size_t views;
    std::size_t first;
};

/// Views of a scene that are to be drawn. The pictures that they look up are up to date.
struct DrawnPicture {
    RendererState& gpu;
    const SceneSnapshot& scene;
    std::span<const View> views;  ///< view i goes to layer i
    const DrawPlan& plan;
    TextureLookup& lookup;
    std::span<const ShadowUse> shadows;  ///< empty if no node of the plan receives shadows
    const PostProcess& post_process;
    Stats& stats;

    /// Draws some views whole into a target that other pictures share (SurfaceInput): view i goes
    /// to layer first_layer + i. The target keeps no keys of them.
    void draw_shared(Target& target, std::size_t first_layer, const std::vector<bool>& drawn);

    /// Draws the views whose keys differ from those in the target, at most as many as the budget
    /// allows. Returns how many it drew; with a budget, how many it examined up to the last one
    /// that it drew.
    std::size_t draw_changed(Target& target, std::optional<Budget> budget = std::nullopt);

private:
    std::vector<NodeTextures> look_up_all();
    std::vector<PictureKey> keys_of(const std::vector<NodeTextures>& lookups,
                                    const Outputs& outputs);
    /// Draws the rectangles of each view; view i goes to layer first_layer + i.
    void draw_damaged(Target& target, const std::vector<std::vector<Rect>>& damaged,
                      const std::vector<NodeTextures>& lookups, std::size_t first_layer = 0,
                      bool shared = false);
    void resolve(Target& target, int layer, const std::vector<Rect>& rects);
};

}  // namespace cubecam
