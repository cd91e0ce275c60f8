#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/render/passes/draw_conditions.hpp"
#include "cubecam/render/passes/light_block.hpp"
#include "cubecam/render/passes/programs.hpp"
#include "cubecam/render/passes/surface_calls.hpp"
#include "cubecam/render/passes/surface_input.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/render/resources/target.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cubecam {

/// Whether one draw call draws all views of a mesh.
enum class Layering { never, where_faster, always };

/// Draws a scene into one or more views; nothing else does. The order is: opaque nodes from near to
/// far, the background, transparent nodes from far to near; without a depth buffer the background,
/// then all nodes as planned. In layered drawing one call draws a node for all views that see it;
/// otherwise each view is drawn alone, and one call draws all nodes that look alike.
class SurfacePass {
public:
    SurfacePass(const gl::Context& context, GpuCache& cache, Layering layering);

    void draw(const SurfaceInput& input, Target& target, Stats& stats);

    Programs& programs() { return programs_; }

private:
    /// The parts that are drawn into the bound framebuffer.
    struct Writes {
        bool color;
        bool outputs;      ///< the shaded outputs
        bool transparent;  ///< whether transparent nodes are drawn
        bool mirror;       ///< the view shows the world mirrored
    };

    void upload_shadows(std::span<const ShadowUse> shadows, const glm::dvec3& origin);
    void draw_layers(const SurfaceInput& input, std::span<const SurfaceCalls> calls, Target& target,
                     Layers& layers, bool color, bool outputs, Stats& stats);
    /// Draws everything into the bound framebuffer.
    void draw_all(const SurfaceInput& input, const SurfaceCalls& calls, const Writes& writes,
                  Stats& stats);
    void draw_background(const SurfaceInput& input, const SurfaceCalls& calls, Stats& stats);
    void draw_calls(std::span<const SurfaceCall> calls, bool mirror, bool outputs, Stats& stats);
    void set_scissor(const Rect& rect);
    void write_outputs(bool write);
    void upload_clip_plane(const SurfaceInput& input);
    void upload_probe_grid(const SurfaceInput& input);
    bool use_layers(const SurfaceInput& input, const SurfaceItems& items, const Rect& whole) const;
    SurfaceVariant variant_of(const SurfaceItem& item, bool instanced, bool outputs) const;
    /// Must be called in the state of the draw call (UserPrograms::get).
    const gl::Program& program_of(const SurfaceItem& item, const SurfaceVariant& variant,
                                  bool outputs);
    void find_conditions(const SurfaceItem& item, const SurfaceVariant& variant, bool outputs);
    void bind_textures(const SurfaceItem& item, const SurfaceVariant& variant);
    void bind_environment(const Environment& environment, const SurfaceVariant& variant);
    /// Calls visit(unit, texture, revision) for the textures of an environment, and of those that
    /// it is blended with.
    template <class Visit>
    void each_texture(const Environment& environment, const SurfaceVariant& variant,
                      const Visit& visit) const;
    GLuint brdf_table();

    const gl::Context* context_;
    const GladGLContext* gl_;
    GpuCache* cache_;
    Programs programs_;
    Layering layering_;
    gl::Texture black_;       ///< a cube of one texel, reflected if there is no environment
    gl::Texture brdf_table_;  ///< made when it is first needed
    TrianglePicker picker_;
    gl::Buffer view_records_, node_records_, blocks_, indices_, lights_block_, shadows_, clip_,
        grid_block_;
    ShaderLights lights_;
    DrawConditions pass_;                        ///< what all draw calls of a pass have in common
    DrawConditions conditions_;                  ///< of the present draw call
    std::vector<BoundTexture> shadow_textures_;  ///< of the lights, in their order
    std::uint32_t shadow_kinds_ = 0;             ///< see SurfaceVariant
    Outputs outputs_;                            ///< the shaded outputs of the target
    std::size_t output_count_ = 0;               ///< the length of outputs_
    DepthState depth_ = depth_state(DepthOrder::nearest);  ///< of the target
    BehindLookup behind_ = BehindLookup::none;             ///< of surfaces in the target
    bool clipped_ = false;                                 ///< the views have a clip plane
    const ProbeGridSnapshot* grid_ = nullptr;              ///< of the scene; null: none
    const GpuProbeGrid* grid_textures_ = nullptr;
};

}  // namespace cubecam
