#pragma once

#include "cubecam/gl/program.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/render/passes/texture_units.hpp"
#include "cubecam/render/passes/tonemap.hpp"
#include "cubecam/render/passes/user_program.hpp"
#include "cubecam/render/resources/environment.hpp"
#include "cubecam/render/resources/outputs.hpp"
#include "cubecam/render/resources/stats.hpp"
#include "cubecam/scene/image_effect.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace cubecam {

/// How a surface looks up its environment.
struct EnvironmentVariant {
    bool block = false;                  ///< it reads the uniform block `Environment`
    bool turned = false;                 ///< Environment::placing is not plain
    bool by_roughness = false;           ///< EnvironmentParts::filtered
    bool filtered = false;               ///< the environment has filtered levels
    bool uneven = false;                 ///< not FilteredTexture::is_even
    bool box_mipmaps = false;            ///< EnvironmentParts::mipmaps
    Parallax parallax = Parallax::none;  ///< LocalLookup::method
    int fetches = 0;                     ///< LocalLookup::fetches

    static EnvironmentVariant of(const Environment& environment, const MaterialTraits& material);
    /// How many textures the surface looks up for it.
    std::size_t texture_count() const;

    auto operator<=>(const EnvironmentVariant&) const = default;
};

/// The texture units of one environment.
struct EnvironmentUnits {
    GLuint cube = texture_unit::cube;
    GLuint filtered = texture_unit::filtered;
    GLuint box_mipmaps = texture_unit::box_mipmaps;
    GLuint distances = texture_unit::distances;
    GLuint farthest = texture_unit::farthest;
};

/// The units of the environments that a surface blends with its first one, those that are needed
/// counted down from texture_unit::last_blended.
std::vector<EnvironmentUnits> units_of(std::span<const EnvironmentVariant> others);

/// How a surface looks up the scene behind it, or what its planar mirror shows: not at all, in a
/// picture of the same view, or in a cube.
enum class BehindLookup : std::uint8_t { none, flat, cube };

/// The variant of surface.vert and surface.frag that a draw call needs.
struct SurfaceVariant {
    const KindInfo* kind = nullptr;
    bool instanced = false;        ///< whether the instances are nodes; otherwise views
    std::uint64_t switches = 0;    ///< MaterialTraits::switches
    std::uint64_t textures = 0;    ///< bit i: the material's texture i shows something
    std::uint64_t second_uvs = 0;  ///< bit i: that texture is placed by the mesh's uvs1
    bool vertex_colors = false;
    bool uvs1 = false;      ///< a texture, or a user's source, reads the mesh's uvs1
    bool tangents = false;  ///< the material reads the mesh's tangents
    bool double_sided = false;
    Blend blend = Blend::opaque;
    bool dense = false;  ///< many small triangles: constants stay in their blocks
    Outputs outputs;     ///< that it writes, except those read from the depth and stencil buffer
    int lights = 0;      ///< how many, in an unrolled loop; -1: a loop of any length
    bool decay = false;
    bool moved = false;              ///< whether a user's own function moves the vertices
    bool cone = false;               ///< some light is a spot light
    bool range = false;              ///< some light has a range
    int shadows = 0;                 ///< how many lights, the first ones, have a shadow on it
    std::uint32_t shadow_kinds = 0;  ///< ShadowView::Kind of each: two bits, from the lowest on
    EnvironmentVariant environment;
    std::vector<EnvironmentVariant> others;  ///< of EnvironmentBlend::others
    bool has_rest = false;                   ///< EnvironmentBlend::has_rest
    bool grid = false;                       ///< the scene has a probe grid that the surface sees
    bool grid_visibility = false;            ///< ProbeGridValue::visibility
    BehindLookup behind = BehindLookup::none;
    BehindLookup planar = BehindLookup::none;  ///< what its planar mirror shows
    bool clipped = false;                      ///< the view has a clip plane
    bool body = false;                         ///< light goes to the far side of the body
    bool screen = false;                       ///< reflections are looked up on the screen first

    auto operator<=>(const SurfaceVariant&) const = default;
};

/// How the texture of distances is made: from depth buffers; the nearest surface of each block;
/// that of all blocks around.
enum class DistanceStep : std::uint8_t { faces, blocks, around };

/// How the depths are made in which reflections on the screen are followed: from the depth buffer
/// and the ids; cells of 2 pixels; larger cells.
enum class ScreenDepthStep : std::uint8_t { pixels, first_cells, cells };

/// The variant of shadow.vert and shadow.frag that a caster needs.
struct ShadowVariant {
    bool holes = false;          ///< there is nothing where alpha is below a cutoff
    bool map = false;            ///< a map's alpha counts
    bool second_uvs = false;     ///< the mesh's uvs1 place it
    bool vertex_colors = false;  ///< the alpha of the vertices counts

    auto operator<=>(const ShadowVariant&) const = default;
};

/// Compiled programs; each is made when it is first needed.
class Programs {
public:
    Programs(const GladGLContext& gl, bool layered);

    /// From now on users' sources are tried before this process compiles them.
    void set_trial(std::unique_ptr<trial::Trial> trial) { users_.set_trial(std::move(trial)); }
    /// Whether the conditions of draw calls matter.
    bool tries() const { return users_.tries(); }

    /// `material` has the variant's kind and switches.
    const gl::Program& surface(const SurfaceVariant& variant, const MaterialTraits& material);
    /// A variant with a user's source in it. @throws ShaderError that names the user's own lines.
    /// The three functions for users' sources must be called in the state of the draw call:
    /// UserPrograms::get.
    UserProgram& user_surface(const SurfaceVariant& variant, const MaterialTraits& material,
                              DrawConditions& conditions);
    UserProgram& effect(const EffectValue& effect, DrawConditions& conditions);
    /// `turned`: the environment's placing is not plain.
    const gl::Program& skybox(bool turned);
    const gl::Program& shadow(const ShadowVariant& variant);
    UserProgram& user_shadow(const MaterialTraits& material, bool vertex_colors,
                             DrawConditions& conditions);
    /// A step of the texture of distances. `layers`: there are depths of the farthest surfaces,
    /// too.
    const gl::Program& distances(DistanceStep step, bool layers);
    const gl::Program& screen_depths(ScreenDepthStep step);
    const gl::Program& grade(Tonemap tonemap, Encode encode, bool decode);
    const gl::Program& bounce_change();
    /// The inner side of a mesh.
    const gl::Program& body();
    const gl::Program& body_rim();

private:
    gl::ShaderOptions layer_options() const;
    void check_textures(const SurfaceVariant& variant, const MaterialTraits& material) const;
    gl::ShaderOptions surface_options(const SurfaceVariant& variant,
                                      const MaterialTraits& material) const;

    const GladGLContext* gl_;
    bool layered_;
    GLint room_ = 15;  ///< vectors that a vertex shader may pass to the fragment shader
    std::map<SurfaceVariant, gl::Program> surfaces_;
    std::map<std::tuple<Tonemap, Encode, bool>, gl::Program> grades_;
    UserPrograms users_;
    std::map<ShadowVariant, gl::Program> shadows_;
    std::map<std::pair<DistanceStep, bool>, gl::Program> distances_;
    std::map<ScreenDepthStep, gl::Program> screen_depths_;
    gl::Program skybox_, turned_skybox_;
    gl::Program bounce_change_;
    gl::Program body_, body_rim_;
    std::size_t most_textures_ = 16;  ///< that one stage of a program may look up
};

}  // namespace cubecam
