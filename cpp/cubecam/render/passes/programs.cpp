#include "cubecam/render/passes/programs.hpp"

#include "cubecam/render/passes/output_declarations.hpp"
#include "cubecam/render/passes/shadow_block.hpp"

#include <array>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam {
namespace {

/// In the order of MaterialParameters.
constexpr std::array<const char*, std::variant_size_v<MaterialParameters>> material_defines = {
    "MATERIAL_BASIC", "MATERIAL_PHONG", "MATERIAL_MIRROR", "MATERIAL_GLASS", "MATERIAL_SHADER"};

void add_defines(gl::ShaderOptions& options,
                 const std::vector<std::pair<std::string, std::string>>& defines) {
    options.defines.insert(options.defines.end(), defines.begin(), defines.end());
}

}  // namespace

gl::ShaderOptions Programs::layer_options() const {
    gl::ShaderOptions options;
    if (layered_) {
        options.extensions.emplace_back("GL_ARB_shader_viewport_layer_array");
        options.defines.emplace_back("LAYERED", "1");
    }
    return options;
}

gl::ShaderOptions Programs::surface_options(const SurfaceVariant& variant) const {
    gl::ShaderOptions options = layer_options();
    const auto define = [&options](bool wanted, const char* name) {
        if (wanted) options.defines.emplace_back(name, "1");
    };
    define(true, material_defines[variant.material]);
    define(variant.map, "HAS_MAP");
    define(variant.vertex_colors, "HAS_VERTEX_COLORS");
    define(variant.cube, "HAS_CUBE");
    define(variant.double_sided, "DOUBLE_SIDED");
    define(variant.fresnel, "FRESNEL");
    define(variant.blend != Blend::opaque, "TRANSLUCENT");
    define(variant.blend == Blend::additive, "BLEND_ADDITIVE");
    define(variant.blend == Blend::multiply, "BLEND_MULTIPLY");
    define(variant.blend == Blend::premultiplied, "BLEND_PREMULTIPLIED");
    define(variant.decay, "LIGHT_DECAY");
    define(variant.cone, "LIGHT_CONE");
    define(variant.dense, "DENSE");
    define(variant.moved, "HAS_USER_VERTEX");
    if (variant.lights >= 0)
        options.defines.emplace_back("LIGHT_COUNT", std::to_string(variant.lights));
    if (variant.shadows > 0) {
        options.defines.emplace_back("SHADOW_COUNT", std::to_string(variant.shadows));
        options.defines.emplace_back("SHADOW_KINDS", std::to_string(variant.shadow_kinds) + "u");
        options.defines.emplace_back("SHADOW_UNIT", std::to_string(shadow_unit));
        options.defines.emplace_back("MAX_SHADOWS", std::to_string(max_shadows));
    }
    return options;
}

const gl::Program& Programs::surface(const SurfaceVariant& variant) {
    const auto found = surfaces_.find(variant);
    if (found != surfaces_.end()) return found->second;
    gl::ShaderOptions options = surface_options(variant);
    add_defines(options, output_defines(variant.outputs));
    return surfaces_
        .emplace(variant,
                 gl::Program(*gl_, {"passes/surface.vert", "passes/surface.frag"}, options))
        .first->second;
}

UserProgram& Programs::surface(const SurfaceVariant& variant, const ShaderParameters& shader) {
    gl::ShaderOptions options = surface_options(variant);
    const UserSource fragment = place_outputs(shader.fragment, variant.outputs);
    add_defines(options, output_defines(variant.outputs, declared_outputs(shader.fragment)));
    return users_.get(*gl_, {"passes/surface.vert", "passes/surface.frag"}, options,
                      {{"include/user_fragment.glsl", "fragment", &fragment},
                       {"include/user_vertex.glsl", "vertex", &shader.vertex}});
}

UserProgram& Programs::effect(const UserSource& fragment) {
    return users_.get(*gl_, {"passes/full_screen.vert", "passes/effect.frag"}, {},
                      {{"include/user_fragment.glsl", "fragment", &fragment}});
}

const gl::Program& Programs::skybox() {
    if (!skybox_)
        skybox_ = gl::Program(*gl_, {"passes/skybox.vert", "passes/skybox.frag"}, layer_options());
    return skybox_;
}

UserProgram& Programs::shadow(const ShaderParameters& shader, bool vertex_colors) {
    SurfaceVariant variant;
    variant.material = std::variant_size_v<MaterialParameters> - 1;
    variant.vertex_colors = vertex_colors;
    variant.moved = true;
    variant.dense = true;
    gl::ShaderOptions options = surface_options(variant);
    std::erase_if(options.defines, [](const auto& define) { return define.first == "LAYERED"; });
    return users_.get(*gl_, {"passes/surface.vert", "passes/shadow.frag"}, options,
                      {{"include/user_fragment.glsl", "fragment", &shader.fragment},
                       {"include/user_vertex.glsl", "vertex", &shader.vertex}});
}

const gl::Program& Programs::shadow() {
    if (!shadow_) shadow_ = gl::Program(*gl_, {"passes/shadow.vert", "passes/shadow.frag"});
    return shadow_;
}

const gl::Program& Programs::grade(Tonemap tonemap, Encode encode) {
    const auto found = grades_.find({tonemap, encode});
    if (found != grades_.end()) return found->second;

    gl::ShaderOptions options;
    switch (tonemap) {
        case Tonemap::none: break;
        case Tonemap::reinhard: options.defines.emplace_back("TONEMAP_REINHARD", "1"); break;
        case Tonemap::aces: options.defines.emplace_back("TONEMAP_ACES", "1"); break;
        case Tonemap::neutral: options.defines.emplace_back("TONEMAP_NEUTRAL", "1"); break;
    }
    if (encode == Encode::srgb) options.defines.emplace_back("ENCODE_SRGB", "1");
    return grades_
        .emplace(std::pair{tonemap, encode},
                 gl::Program(*gl_, {"passes/full_screen.vert", "passes/tonemap.frag"}, options))
        .first->second;
}

}  // namespace cubecam
