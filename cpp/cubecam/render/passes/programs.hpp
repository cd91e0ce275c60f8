#pragma once

#include "cubecam/gl/program.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/render/passes/tonemap.hpp"
#include "cubecam/render/passes/user_program.hpp"
#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/render/resources/stats.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>

namespace cubecam {

/// Which variant of surface.vert/.frag a draw call needs.
struct SurfaceVariant {
    const KindInfo* kind = nullptr;
    bool instanced = false;      ///< the instances are nodes, else they are views
    std::uint32_t switches = 0;  ///< MaterialTraits::switches
    std::uint32_t textures = 0;  ///< bit i: the material's texture i shows something
    bool vertex_colors = false;
    bool double_sided = false;
    Blend blend = Blend::opaque;
    bool dense = false;  ///< many small triangles: constants stay in their blocks
    Outputs outputs;     ///< that it writes; without those read from depth and stencil buffers
    int lights = 0;      ///< unrolled so many times; -1: a loop
    bool decay = false;
    bool moved = false;              ///< by a user's own vertex function
    bool cone = false;               ///< some light is a spot light
    int shadows = 0;                 ///< so many lights, the first ones, have shadows that it shows
    std::uint32_t shadow_kinds = 0;  ///< ShadowView::Kind of each, two bits from the lowest on

    auto operator<=>(const SurfaceVariant&) const = default;
};

/// The unit of a material's first texture; units below belong to the passes.
inline constexpr unsigned first_material_unit = 2;
inline constexpr unsigned most_material_textures = 14;  ///< units from 16 on are for shadows

/// Compiled programs, made when first needed.
class Programs {
public:
    Programs(const GladGLContext& gl, bool layered) : gl_(&gl), layered_(layered) {}

    /// `material` is any of the variant's kind and switches.
    const gl::Program& surface(const SurfaceVariant& variant, const MaterialTraits& material);
    /// With a user's source in it. @throws ShaderError that names the user's own lines.
    UserProgram& user_surface(const SurfaceVariant& variant, const MaterialTraits& material);
    UserProgram& effect(const UserSource& fragment);
    const gl::Program& skybox();
    const gl::Program& shadow();
    UserProgram& user_shadow(const MaterialTraits& material, bool vertex_colors);
    const gl::Program& grade(Tonemap tonemap, Encode encode);

private:
    gl::ShaderOptions layer_options() const;
    gl::ShaderOptions surface_options(const SurfaceVariant& variant,
                                      const MaterialTraits& material) const;

    const GladGLContext* gl_;
    bool layered_;
    std::map<SurfaceVariant, gl::Program> surfaces_;
    std::map<std::pair<Tonemap, Encode>, gl::Program> grades_;
    UserPrograms users_;
    gl::Program skybox_, shadow_;
};

}  // namespace cubecam
