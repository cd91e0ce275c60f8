#pragma once

#include "cubecam/render/passes/draw_plan.hpp"
#include "cubecam/render/passes/shadow_block.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/environment.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glad/gl.h>
#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <variant>
#include <vector>

namespace cubecam {

/// The background: a colour, or an environment that is drawn as a skybox.
using BackgroundSource = std::variant<glm::vec4, Environment>;

/// A part of a view's picture that is drawn.
struct Region {
    std::size_t view;
    Rect rect;
};

/// The pictures that SurfacePass draws in one call.
struct SurfaceInput {
    const SceneSnapshot& scene;
    std::span<const View> views;  ///< view i goes to layer first_layer + i
    const DrawPlan& plan;
    /// The parts to draw, ascending by view; all their views have the same position. All other
    /// pixels stay as they are.
    std::vector<Region> regions;
    BackgroundSource background;
    std::span<const NodeTextures> textures;  ///< of each node of the scene
    /// The shadow maps of the lights that have one, in the scene's order; empty if no node of the
    /// plan receives shadows.
    std::span<const ShadowUse> shadows;
    std::size_t first_layer = 0;
    /// The target was cleared, and other pictures are drawn into its other layers: the framebuffer
    /// of all layers stays bound, if shaders can choose a layer.
    bool shared_target = false;

    std::size_t layer(const Region& region) const { return first_layer + region.view; }

    /// The position of the views, which is the origin of the shaders' positions: far from the
    /// world's origin a float would be too coarse for near objects.
    const glm::dvec3& origin() const { return views[regions.front().view].position; }
};

}  // namespace cubecam
