#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/render/passes/draw_plan.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/passes/shadow_block.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/render/resources/target.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstdint>
#include <optional>
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

/// One set of pictures to draw.
struct PassInput {
    const SceneSnapshot& scene;
    std::span<const View> views;  ///< view i goes to layer i
    const DrawPlan& plan;
    /// By view, ascending, of views that stand in one place; all other pixels stay as they are.
    std::vector<Region> regions;
    BackgroundSource background;
    std::span<const NodeTextures> lookups;  ///< of each node of the scene
    /// Of the lights that have one, in the scene's order; empty: no node of the plan receives any.
    std::span<const ShadowUse> shadows;
};

/// Whether all views of a mesh go into one draw call.
enum class Layering { never, where_faster, always };

/// The one path that draws a scene, into one view or many: opaque nodes near to far, the
/// background, transparent nodes far to near; without a depth buffer the background, then all
/// nodes as planned. A mesh is drawn once for all the views that see it; without layered rendering,
/// once for each.
class SurfacePass {
public:
    SurfacePass(const gl::Context& context, GpuCache& cache, Layering layering);

    void draw(const PassInput& input, Target& target, Stats& stats);

    Programs& programs() { return programs_; }

private:
    /// A planned node and the regions it shows in.
    struct Item {
        const NodeSnapshot* node;
        const GpuMesh* mesh;
        std::vector<std::size_t> regions;  ///< indices into PassInput::regions, ascending
        GLuint first_instance;             ///< record of the first of them
        GLintptr block;                    ///< offset of its uniform block
        GLintptr constants;                ///< offset of the block of its material, if there is one
        const NodeTextures* lookups;
    };

    struct Prepared {
        std::vector<Item> opaque;
        std::vector<Item> transparent;
        GLuint first_skybox = 0;  ///< record of the skybox in the first region
    };

    Prepared prepare(const PassInput& input);
    void draw_layers(const PassInput& input, const Prepared& prepared, Target& target,
                     Layers& layers, bool color, bool outputs, Stats& stats);
    /// Draws everything into the bound framebuffer, in all regions or only in one. `transparent`:
    /// transparent nodes, too.
    void draw_all(const PassInput& input, const Prepared& prepared,
                  std::optional<std::size_t> region, bool color, bool outputs, bool transparent,
                  Stats& stats);
    void draw_background(const PassInput& input, const Prepared& prepared,
                         std::optional<std::size_t> region, Stats& stats);
    void draw_items(std::span<const Item> items, std::optional<std::size_t> region, bool mirror,
                    bool outputs, Stats& stats);
    void set_scissor(const Rect& rect);
    void write_outputs(bool write);
    void draw_skybox(GLuint cube, GLuint first_instance, std::size_t count, Stats& stats);
    bool use_layers(const PassInput& input, const Prepared& prepared, const Rect& whole) const;
    SurfaceVariant variant_of(const NodeSnapshot& node, bool outputs) const;
    const gl::Program& user_program(const SurfaceVariant& variant, const MaterialTraits& material,
                                    const NodeTextures& lookups);
    void bind_textures(const Item& item, const SurfaceVariant& variant);
    void upload_lights(std::span<const LightSnapshot> lights, const glm::dvec3& origin);
    void upload_shadows(std::span<const ShadowUse> shadows, const glm::dvec3& origin);

    const gl::Context* context_;
    const GladGLContext* gl_;
    GpuCache* cache_;
    Programs programs_;
    Layering layering_;
    gl::Texture black_;  ///< a cube of one texel: what is reflected where there is no environment
    gl::Buffer instances_, blocks_, lights_, shadows_;
    glm::vec3 ambient_{1.0F};
    std::size_t light_count_ = 0;
    std::size_t shadow_count_ = 0;    ///< of the lights, which come first
    std::uint32_t shadow_kinds_ = 0;  ///< see SurfaceVariant
    bool light_decay_ = false;
    bool light_cone_ = false;
    Outputs outputs_;               ///< of the target that is drawn into, the shaded ones
    std::size_t output_count_ = 0;  ///< of outputs_
    DepthState depth_ = depth_state(DepthOrder::nearest);  ///< of that target
};

}  // namespace cubecam
