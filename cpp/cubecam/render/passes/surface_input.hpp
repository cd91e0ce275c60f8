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

/// What is behind everything: a colour, or a cube texture drawn as skybox.
using BackgroundSource = std::variant<glm::vec4, GLuint>;

/// A part of a view's picture that is drawn.
struct Region {
    std::size_t view;
    Rect rect;
};

/// One set of pictures for SurfacePass to draw.
struct SurfaceInput {
    const SceneSnapshot& scene;
    std::span<const View> views;  ///< view i goes to layer i
    const DrawPlan& plan;
    /// By view, ascending, of views that stand in one place; all other pixels stay as they are.
    std::vector<Region> regions;
    BackgroundSource background;
    std::span<const NodeTextures> textures;  ///< of each node of the scene
    /// Of the lights that have one, in the scene's order; empty: no node of the plan receives any.
    std::span<const ShadowUse> shadows;

    /// Where the views stand. The shaders' positions count from here: far from the world's origin a
    /// float would have no digits left for what is near.
    const glm::dvec3& origin() const { return views[regions.front().view].position; }
};

}  // namespace cubecam
