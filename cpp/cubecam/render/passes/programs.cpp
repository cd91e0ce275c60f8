#include "cubecam/render/passes/programs.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/render/passes/environment_text.hpp"
#include "cubecam/render/passes/output_declarations.hpp"
#include "cubecam/render/passes/shadow_block.hpp"
#include "cubecam/render/passes/texture_units.hpp"
#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/node_record.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam {
namespace {

/// How many lights are flat inputs of the fragment shader (docs/adr/0004): as many as the driver
/// has room for in addition to the other inputs in shaders/include/surface.glsl.
int flat_lights(const SurfaceVariant& variant, const MaterialTraits& material, int room) {
    if (variant.dense || variant.lights <= 0) return 0;
    int taken = 3;  // position, normal, eye
    if (material.constants <= most_flat_constants) taken += static_cast<int>(material.constants);
    taken += material.textures.empty() ? 0 : 2;  // uv, the object's own position
    taken += variant.uvs1 ? 1 : 0;
    taken += variant.tangents ? 1 : 0;
    const bool by_pixel =
        variant.behind == BehindLookup::flat || variant.planar == BehindLookup::flat;
    taken += by_pixel || variant.screen ? 4 : 0;  // rows of a matrix; layer
    taken += variant.screen ? 2 : 0;              // a row of it; the node's id
    taken += variant.body ? 4 : 0;                // a place; rows of a matrix
    taken += variant.clipped ? 1 : 0;
    taken += variant.vertex_colors ? 1 : 0;
    taken += variant.shadows > 0 ? 1 : 0;
    taken += variant.blend == Blend::opaque ? 0 : 1;
    taken += variant.outputs.any() ? 4 : 0;
    const int each = variant.cone ? 3 : 2;
    return std::clamp((room - taken) / each, 0, variant.lights);
}

/// The file that the material's own file replaces in shaders/passes/surface.frag.
constexpr std::string_view material_include = "include/material.glsl";

constexpr std::string_view user_fragment = "include/user_fragment.glsl";
constexpr std::string_view user_vertex = "include/user_vertex.glsl";

std::string upper(std::string_view name) {
    std::string text(name);
    std::transform(text.begin(), text.end(), text.begin(), [](char c) {
        return static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    });
    return text;
}

/// Returns GLSL that includes a material's file.
UserSource include_of(const KindInfo& kind) {
    return {"#include \"" + std::string(kind.shader) + "\"\n", {}};
}

/// Adds the defines for the material's textures.
void add_textures(gl::ShaderOptions& options, const SurfaceVariant& variant,
                  const MaterialTraits& material) {
    if (material.user_code) return;  // the user declares the samplers
    bool uv = false;
    bool position = false;
    GLuint unit = texture_unit::first_of_material;
    for (std::size_t i = 0; i < material.textures.size(); ++i) {
        if ((variant.textures >> i & 1U) == 0) continue;
        const NamedTexture& texture = material.textures[i];
        const std::string name = upper(texture.name);
        options.defines.emplace_back("HAS_" + name, "1");
        options.defines.emplace_back("UNIT_" + name, std::to_string(unit++));
        const bool second = (variant.second_uvs >> i & 1U) != 0;
        if (second) options.defines.emplace_back("UV1_" + name, "1");
        if (texture.source.index() != 0) {
            position = true;
        } else if (!second) {
            uv = true;
        }
    }
    if (uv) options.defines.emplace_back("USES_UV", "1");
    if (position) options.defines.emplace_back("USES_POSITION_OBJECT", "1");
}

/// `suffix` is that of the names of one of several environments.
void add_environment(gl::ShaderOptions& options, const EnvironmentVariant& variant,
                     const std::string& suffix = "") {
    const auto define = [&](bool wanted, const char* name) {
        if (wanted) options.defines.emplace_back(name + suffix, "1");
    };
    define(variant.block, "ENVIRONMENT_BLOCK");
    define(variant.turned, "ENVIRONMENT_TURNED");
    define(variant.filtered, "ENVIRONMENT_FILTERED");
    define(variant.uneven, "ENVIRONMENT_UNEVEN");
    define(variant.parallax == Parallax::box, "ENVIRONMENT_BOX");
    define(variant.parallax == Parallax::sphere, "ENVIRONMENT_SPHERE");
    define(variant.parallax == Parallax::layers, "ENVIRONMENT_LAYERS");
    if (variant.fetches > 0) {
        options.defines.emplace_back("ENVIRONMENT_FETCHES" + suffix,
                                     std::to_string(variant.fetches));
    }
}

/// The defines for one environment, or for several that are blended.
void add_environments(gl::ShaderOptions& options, const SurfaceVariant& variant) {
    const auto define = [&options](bool wanted, const char* name) {
        if (wanted) options.defines.emplace_back(name, "1");
    };
    const EnvironmentVariant& first = variant.environment;
    define(first.by_roughness, "USES_FILTERED_ENVIRONMENT");
    define(first.box_mipmaps, "USES_ENVIRONMENT_MIPS");
    const bool marches =
        first.fetches > 0 || std::any_of(variant.others.begin(), variant.others.end(),
                                         [](const auto& other) { return other.fetches > 0; });
    if (marches) {
        options.defines.emplace_back("DISTANCE_BLOCKS", std::to_string(distance_blocks));
    }
    if (variant.others.empty()) return add_environment(options, first);
    add_environment(options, first, "_0");
    for (std::size_t i = 0; i < variant.others.size(); ++i) {
        add_environment(options, variant.others[i], "_" + std::to_string(i + 1));
    }
    const std::size_t count = variant.others.size() + 1;
    options.defines.emplace_back("ENVIRONMENT_SOURCES", std::to_string(count));
    options.defines.emplace_back("ENVIRONMENT_PROBES",
                                 std::to_string(count - (variant.has_rest ? 1 : 0)));
}

/// The text that takes the place of include/environment.glsl; empty for one environment.
UserSource environment_source(const SurfaceVariant& variant) {
    if (variant.others.empty()) return {};
    std::vector<EnvironmentUnits> units{EnvironmentUnits()};
    const std::vector<EnvironmentUnits> others = units_of(variant.others);
    units.insert(units.end(), others.begin(), others.end());
    return {blended_environment_text(units), {}};
}

/// Replaces that include, or nothing.
ShaderPart environment_part(const SurfaceVariant& variant, const UserSource& source) {
    return {variant.others.empty() ? "" : environment_include, &source};
}

void add_defines(gl::ShaderOptions& options,
                 const std::vector<std::pair<std::string, std::string>>& defines) {
    options.defines.insert(options.defines.end(), defines.begin(), defines.end());
}

}  // namespace

EnvironmentVariant EnvironmentVariant::of(const Environment& environment,
                                          const MaterialTraits& material) {
    EnvironmentVariant variant;
    variant.by_roughness = environment.parts.filtered || environment.filtered != nullptr;
    if (!material.uses_environment) return variant;
    variant.block = needs_block(environment, material.user_code.has_value());
    variant.turned = !environment.placing.is_plain();
    variant.filtered = environment.filtered != nullptr;
    variant.uneven = variant.filtered && !environment.filtered->is_even();
    variant.box_mipmaps = environment.parts.mipmaps;
    variant.parallax = environment.local.method;
    variant.fetches = environment.local.fetches;
    return variant;
}

std::size_t EnvironmentVariant::texture_count() const {
    return (by_roughness ? 1U : 0U) + (filtered ? 1U : 0U) + (box_mipmaps ? 1U : 0U) +
           (fetches > 0 ? 1U : 0U) + (parallax == Parallax::layers ? 1U : 0U);
}

std::vector<EnvironmentUnits> units_of(std::span<const EnvironmentVariant> others) {
    std::vector<EnvironmentUnits> units;
    GLuint next = texture_unit::last_blended;
    for (const EnvironmentVariant& other : others) {
        EnvironmentUnits& one = units.emplace_back();
        const auto take = [&next](bool needed, GLuint& unit) {
            if (needed) unit = next--;
        };
        take(true, one.cube);
        take(other.filtered, one.filtered);
        take(other.box_mipmaps, one.box_mipmaps);
        take(other.fetches > 0, one.distances);
        take(other.parallax == Parallax::layers, one.farthest);
    }
    return units;
}

Programs::Programs(const GladGLContext& gl, bool layered) : gl_(&gl), layered_(layered) {
    gl.GetIntegerv(GL_MAX_VARYING_VECTORS, &room_);
    GLint units = 16;
    gl.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    most_textures_ = static_cast<std::size_t>(units);
}

gl::ShaderOptions Programs::layer_options() const {
    gl::ShaderOptions options;
    if (layered_) {
        options.extensions.emplace_back("GL_ARB_shader_viewport_layer_array");
        options.defines.emplace_back("LAYERED", "1");
    }
    return options;
}

void Programs::check_textures(const SurfaceVariant& variant, const MaterialTraits& material) const {
    const std::size_t maps = material.user_code
                                 ? material.textures.size()
                                 : static_cast<std::size_t>(std::popcount(variant.textures));
    std::size_t blended = 0;
    for (const EnvironmentVariant& other : variant.others) {
        blended += 1 + other.texture_count() - (other.by_roughness ? 1U : 0U);
    }
    const std::size_t environment =
        (material.uses_environment ? 1U : 0U) + variant.environment.texture_count() + blended;
    const auto shadows = static_cast<std::size_t>(variant.shadows);
    const std::size_t behind = variant.behind == BehindLookup::none ? 0U : 1U;
    const std::size_t planar = variant.planar == BehindLookup::none ? 0U : 1U;
    const std::size_t screen = variant.screen ? 2U : 0U;
    const std::size_t body = variant.body ? 2U : 0U;
    const std::size_t grid = variant.grid ? (variant.grid_visibility ? 2U : 1U) : 0U;
    const std::size_t all = maps + environment + shadows + behind + planar + screen + body + grid;
    if (blended > texture_unit::most_blended) {
        throw std::invalid_argument(
            std::string(variant.kind->name) + ": expected at most " +
            std::to_string(texture_unit::most_blended) +
            " textures of the environments after the first one that a ProbeBlend blends, got " +
            std::to_string(blended) +
            ": fewer probes may reach a node, or with a simpler parallax");
    }
    if (all <= most_textures_) return;
    throw std::invalid_argument(
        std::string(variant.kind->name) + ": expected at most " + std::to_string(most_textures_) +
        " textures on a surface (GL_MAX_TEXTURE_IMAGE_UNITS), got " + std::to_string(all) + ": " +
        std::to_string(maps) + " of the material, " + std::to_string(environment) +
        " of the environment, " + std::to_string(shadows) + " of shadows" +
        (behind == 0 ? "" : ", 1 of the scene behind") +
        (planar == 0 ? "" : ", 1 of the planar mirror") +
        (screen == 0 ? "" : ", 2 of screen_reflections") +
        (body == 0 ? "" : ", 2 of the body's far side") +
        (grid == 0 ? "" : ", " + std::to_string(grid) + " of the probe grid"));
}

gl::ShaderOptions Programs::surface_options(const SurfaceVariant& variant,
                                            const MaterialTraits& material) const {
    gl::ShaderOptions options = layer_options();
    const auto define = [&options](bool wanted, const char* name) {
        if (wanted) options.defines.emplace_back(name, "1");
    };
    for (std::size_t i = 0; i < material.switch_names.size(); ++i) {
        define((variant.switches >> i & 1U) != 0, material.switch_names[i]);
    }
    add_textures(options, variant, material);
    define(material.user_code.has_value(), "USER_SOURCE");
    define(material.uses_environment, "USES_ENVIRONMENT");
    add_environments(options, variant);
    define(material.uses_lights, "USES_LIGHTS");
    const std::size_t constants = material.constants;
    options.defines.emplace_back("MATERIAL_SIZE", std::to_string(constants));
    define(constants > 0 && constants <= most_flat_constants && !variant.dense, "FLAT_MATERIAL");
    define(variant.vertex_colors, "HAS_VERTEX_COLORS");
    define(variant.uvs1, "USES_UV1");
    define(variant.tangents, "USES_TANGENT");
    define(variant.behind != BehindLookup::none, "SHOWS_BEHIND");
    define(variant.behind == BehindLookup::cube, "BEHIND_CUBE");
    define(variant.planar != BehindLookup::none, "PLANAR_MIRROR");
    define(variant.planar == BehindLookup::cube, "PLANAR_MIRROR_CUBE");
    define(variant.body, "BODY");
    if (variant.body) options.defines.emplace_back("BODY_SIZE", std::to_string(body_size));
    define(variant.clipped, "CLIPPED");
    if (variant.screen) {
        options.defines.emplace_back("SCREEN_REFLECTIONS", "1");
        options.defines.emplace_back("SCREEN_DEPTH_LEVELS", std::to_string(screen_depth_levels));
    }
    define(variant.grid, "PROBE_GRID");
    define(variant.grid_visibility, "PROBE_GRID_VISIBILITY");
    define(variant.double_sided, "DOUBLE_SIDED");
    define(variant.blend != Blend::opaque, "TRANSLUCENT");
    define(variant.blend == Blend::additive, "BLEND_ADDITIVE");
    define(variant.blend == Blend::multiply, "BLEND_MULTIPLY");
    define(variant.blend == Blend::premultiplied, "BLEND_PREMULTIPLIED");
    define(variant.decay, "LIGHT_DECAY");
    define(variant.cone, "LIGHT_CONE");
    define(variant.range, "LIGHT_RANGE");
    define(variant.dense, "DENSE");
    define(variant.moved, "HAS_USER_VERTEX");
    define(variant.instanced, "INSTANCED");
    if (variant.lights >= 0)
        options.defines.emplace_back("LIGHT_COUNT", std::to_string(variant.lights));
    options.defines.emplace_back("FLAT_LIGHT_COUNT",
                                 std::to_string(flat_lights(variant, material, room_)));
    if (variant.shadows > 0) {
        options.defines.emplace_back("SHADOW_COUNT", std::to_string(variant.shadows));
        options.defines.emplace_back("SHADOW_KINDS", std::to_string(variant.shadow_kinds) + "u");
        options.defines.emplace_back("SHADOW_UNIT", std::to_string(texture_unit::first_shadow));
        options.defines.emplace_back("MAX_SHADOWS", std::to_string(max_shadows));
    }
    return options;
}

const gl::Program& Programs::surface(const SurfaceVariant& variant,
                                     const MaterialTraits& material) {
    const auto found = surfaces_.find(variant);
    if (found != surfaces_.end()) return found->second;
    check_textures(variant, material);
    const UserSource include = include_of(*variant.kind);
    gl::ShaderOptions options = surface_options(variant, material);
    add_defines(options, output_defines(variant.outputs));
    const UserSource environment = environment_source(variant);
    const std::array parts{ShaderPart{material_include, &include},
                           environment_part(variant, environment)};
    return surfaces_
        .emplace(variant, gl::Program(*gl_, {"passes/surface.vert", "passes/surface.frag"}, options,
                                      substituted(parts)))
        .first->second;
}

UserProgram& Programs::user_surface(const SurfaceVariant& variant, const MaterialTraits& material,
                                    DrawConditions& conditions) {
    const UserCode& user = *material.user_code;
    const UserSource include = include_of(*variant.kind);
    gl::ShaderOptions options = surface_options(variant, material);
    const UserSource fragment = place_outputs(*user.fragment, variant.outputs);
    add_defines(options, output_defines(variant.outputs, declared_outputs(*user.fragment)));
    const UserSource environment = environment_source(variant);
    try {
        return users_.get(*gl_, {"passes/surface.vert", "passes/surface.frag"}, options,
                          {{user_fragment, &fragment, UserStage::fragment, user.fragment},
                           {user_vertex, user.vertex, UserStage::vertex},
                           {material_include, &include},
                           environment_part(variant, environment)},
                          conditions, *user.inputs);
    } catch (const ShaderError&) {
        // Only the driver knows which textures the source really looks up.
        check_textures(variant, material);
        throw;
    }
}

UserProgram& Programs::effect(const EffectValue& effect, DrawConditions& conditions) {
    return users_.get(*gl_, {"passes/full_screen.vert", "passes/effect.frag"}, {},
                      {{user_fragment, &effect.fragment, UserStage::effect}}, conditions,
                      effect.inputs);
}

const gl::Program& Programs::skybox(bool turned) {
    gl::Program& program = turned ? turned_skybox_ : skybox_;
    if (!program) {
        gl::ShaderOptions options = layer_options();
        add_environment(options, {.block = turned, .turned = turned});
        program = gl::Program(*gl_, {"passes/skybox.vert", "passes/skybox.frag"}, options);
    }
    return program;
}

UserProgram& Programs::user_shadow(const MaterialTraits& material, bool vertex_colors,
                                   DrawConditions& conditions) {
    SurfaceVariant variant;
    variant.kind = material.kind;
    variant.switches = material.switches;
    variant.vertex_colors = vertex_colors;
    variant.moved = true;
    variant.dense = true;
    gl::ShaderOptions options = surface_options(variant, material);
    std::erase_if(options.defines, [](const auto& define) { return define.first == "LAYERED"; });
    return users_.get(*gl_, {"passes/surface.vert", "passes/shadow.frag"}, options,
                      {{user_fragment, material.user_code->fragment, UserStage::fragment},
                       {user_vertex, material.user_code->vertex, UserStage::vertex}},
                      conditions, *material.user_code->inputs);
}

const gl::Program& Programs::shadow(const ShadowVariant& variant) {
    const auto found = shadows_.find(variant);
    if (found != shadows_.end()) return found->second;
    gl::ShaderOptions options;
    const auto define = [&options](bool wanted, const char* name, unsigned value) {
        if (wanted) options.defines.emplace_back(name, std::to_string(value));
    };
    define(variant.holes, "HOLES", 1);
    define(variant.map, "UNIT_MASK", texture_unit::first_of_material);
    define(variant.map, "MASK_UV", variant.second_uvs ? attribute::uv1 : attribute::uv);
    define(variant.vertex_colors, "HAS_VERTEX_COLORS", 1);
    return shadows_
        .emplace(variant, gl::Program(*gl_, {"passes/shadow.vert", "passes/shadow.frag"}, options))
        .first->second;
}

const gl::Program& Programs::distances(DistanceStep step, bool layers) {
    gl::Program& program = distances_[{step, layers}];
    if (!program) {
        gl::ShaderOptions options;
        options.defines.emplace_back("DISTANCE_BLOCKS", std::to_string(distance_blocks));
        switch (step) {
            case DistanceStep::faces: options.defines.emplace_back("FACES", "1"); break;
            case DistanceStep::blocks: options.defines.emplace_back("NEAREST_OF_BLOCK", "1"); break;
            case DistanceStep::around: break;
        }
        if (layers) options.defines.emplace_back("LAYERS", "1");
        program = gl::Program(*gl_, {"passes/full_screen.vert", "passes/distances.frag"}, options);
    }
    return program;
}

const gl::Program& Programs::body() {
    if (!body_) body_ = gl::Program(*gl_, {"passes/body.vert", "passes/body.frag"}, {});
    return body_;
}

const gl::Program& Programs::body_rim() {
    if (!body_rim_) {
        gl::ShaderOptions options;
        options.defines.emplace_back("BODY_SIZE", std::to_string(body_size));
        body_rim_ = gl::Program(*gl_, {"passes/full_screen.vert", "passes/body_rim.frag"}, options);
    }
    return body_rim_;
}

const gl::Program& Programs::screen_depths(ScreenDepthStep step) {
    gl::Program& program = screen_depths_[step];
    if (!program) {
        gl::ShaderOptions options;
        switch (step) {
            case ScreenDepthStep::pixels: options.defines.emplace_back("PIXELS", "1"); break;
            case ScreenDepthStep::first_cells: options.defines.emplace_back("FIRST", "1"); break;
            case ScreenDepthStep::cells: break;
        }
        program =
            gl::Program(*gl_, {"passes/full_screen.vert", "passes/screen_depths.frag"}, options);
    }
    return program;
}

const gl::Program& Programs::grade(Tonemap tonemap, Encode encode, bool decode) {
    const auto found = grades_.find({tonemap, encode, decode});
    if (found != grades_.end()) return found->second;

    gl::ShaderOptions options;
    switch (tonemap) {
        case Tonemap::none: break;
        case Tonemap::reinhard: options.defines.emplace_back("TONEMAP_REINHARD", "1"); break;
        case Tonemap::aces: options.defines.emplace_back("TONEMAP_ACES", "1"); break;
        case Tonemap::neutral: options.defines.emplace_back("TONEMAP_NEUTRAL", "1"); break;
    }
    if (encode == Encode::srgb) options.defines.emplace_back("ENCODE_SRGB", "1");
    if (decode) options.defines.emplace_back("DECODE_SRGB", "1");
    return grades_
        .emplace(std::tuple{tonemap, encode, decode},
                 gl::Program(*gl_, {"passes/full_screen.vert", "passes/tonemap.frag"}, options))
        .first->second;
}

const gl::Program& Programs::bounce_change() {
    if (!bounce_change_) {
        bounce_change_ =
            gl::Program(*gl_, {"passes/full_screen.vert", "passes/bounce_change.frag"}, {});
    }
    return bounce_change_;
}

}  // namespace cubecam
