#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/image/pixels.hpp"
#include "cubecam/render/passes/draw_plan.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/passes/shadow_block.hpp"
#include "cubecam/render/passes/triangle_picker.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/render/resources/target.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace cubecam {

/// The depths that a light sees: an array of one or six layers.
struct ShadowMap {
    int size = 0;
    gl::Texture depth;
    std::optional<Layers> layers;
};

/// The casters of a light and its views.
struct ShadowInput {
    const SceneSnapshot& scene;
    const ShadowView& view;
    const DrawPlan& plan;  ///< of all casters, for the view's layers; all of it is drawn
    /// Returns the textures on which a caster's shadow depends, in the order of its inputs.
    std::function<std::vector<BoundTexture>(const NodeSnapshot&)> look_up;
};

/// Draws the depth of all casters as a light sees them.
class ShadowPass {
public:
    ShadowPass(const gl::Context& context, GpuCache& cache, Programs& programs);

    /// Checks that the lights' shadows are within the driver's limits.
    /// @throws std::invalid_argument that names the limit.
    void check(const SceneSnapshot& scene) const;

    /// Makes a map with undefined contents.
    ShadowMap make_map(int size, int layers) const;

    /// Draws one layer of a map.
    void draw(const ShadowInput& input, std::size_t layer, ShadowMap& map, Stats& stats);

    /// See Renderer::shadow_map.
    Buffer<float> read(const ShadowUse& use);

private:
    /// Binds the program that draws a caster, and what it reads: for a surface with holes its map.
    void bind_program(const NodeSnapshot& node, const ShadowInput& input);
    /// Draws a caster whose vertices a user's source moves.
    void draw_moved(const NodeSnapshot& node, const ShadowInput& input, std::size_t layer,
                    Stats& stats);

    const gl::Context* context_;
    const GladGLContext* gl_;
    GpuCache* cache_;
    Programs* programs_;
    int largest_;
    std::size_t most_;
    TrianglePicker picker_;
    gl::Buffer instances_, block_, indices_;
};

}  // namespace cubecam
