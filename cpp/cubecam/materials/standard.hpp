#pragma once

#include "cubecam/core/parse_name.hpp"
#include "cubecam/materials/material.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

namespace cubecam {

/// How the light of the environment that a surface reflects is found.
enum class SpecularMode : std::uint8_t {
    levels,   ///< one lookup in an environment that is filtered by roughness
    sampled,  ///< many lookups, in directions of the whole reflection model
};

inline constexpr std::array<std::pair<std::string_view, SpecularMode>, 2> specular_mode_names{
    {{"levels", SpecularMode::levels}, {"sampled", SpecularMode::sampled}}};

/// The metallic-roughness material of glTF 2.0 (section 3.9, appendix B) with the KHR_materials
/// extensions. The shader is shaders/materials/standard.glsl.
struct Standard {
    glm::vec4 color{1.0F};
    float metallic = 1.0F;
    float roughness = 1.0F;
    PlacedMap map;
    PlacedMap metallic_roughness_map;
    PlacedMap normal_map;
    float normal_scale = 1.0F;
    PlacedMap occlusion_map;
    float occlusion_strength = 1.0F;
    glm::vec3 emissive{0.0F};
    PlacedMap emissive_map;
    float emissive_strength = 1.0F;
    bool vertex_colors = true;
    std::optional<AlphaMode> alpha_mode;
    float alpha_cutoff = 0.5F;
    float ior = 1.5F;
    float specular_weight = 1.0F;
    PlacedMap specular_map;
    glm::vec3 specular_color{1.0F};
    PlacedMap specular_color_map;
    float clearcoat = 0.0F;
    PlacedMap clearcoat_map;
    float clearcoat_roughness = 0.0F;
    PlacedMap clearcoat_roughness_map;
    PlacedMap clearcoat_normal_map;
    float clearcoat_normal_scale = 1.0F;
    glm::vec3 sheen_color{0.0F};
    PlacedMap sheen_color_map;
    float sheen_roughness = 0.0F;
    PlacedMap sheen_roughness_map;
    float iridescence = 0.0F;
    PlacedMap iridescence_map;
    float iridescence_ior = 1.3F;
    float iridescence_thickness_min = 100.0F;
    float iridescence_thickness_max = 400.0F;
    PlacedMap iridescence_thickness_map;
    float anisotropy = 0.0F;
    float anisotropy_rotation = 0.0F;  ///< degrees
    PlacedMap anisotropy_map;
    float transmission = 0.0F;
    PlacedMap transmission_map;
    float thickness = 0.0F;
    PlacedMap thickness_map;
    float attenuation_distance = std::numeric_limits<float>::infinity();
    glm::vec3 attenuation_color{1.0F};
    float dispersion = 0.0F;
    bool unlit = false;
    SpecularMode specular = SpecularMode::levels;
    int specular_samples = 16;
    bool multiple_scattering = true;

    static constexpr int most_samples = 1024;

    static constexpr const char* name = "StandardMaterial";
    static constexpr const char* shader = "materials/standard.glsl";
    static constexpr auto fields = std::tuple{
        Field{"color", &Standard::color,
              "ndarray (4,) float32: linear RGBA of the base, from 0 to 1, read-only."},
        Field{"metallic", &Standard::metallic, "float: 0 is a dielectric, 1 a metal."},
        Field{"roughness", &Standard::roughness,
              "float: from 0 (smooth) to 1; alpha is its square."},
        Field{"map", &Standard::map, MapAlpha::counts, MapEncoding::srgb,
              "Texture, Image, RenderTexture or None: times the colour and its alpha."},
        Field{"metallic_roughness_map", &Standard::metallic_roughness_map, MapAlpha::ignored,
              MapEncoding::linear,
              "Texture, Image, RenderTexture or None: green times the roughness, blue times "
              "metallic."},
        Field{"normal_map", &Standard::normal_map, MapAlpha::ignored, MapEncoding::linear,
              "Texture, Image, RenderTexture or None: normals in the tangent frame, 0..1 for "
              "-1..1."},
        Field{"normal_scale", &Standard::normal_scale,
              "float: factor of the normal map's x and y; negative ones turn bumps into dents."},
        Field{"occlusion_map", &Standard::occlusion_map, MapAlpha::ignored, MapEncoding::linear,
              "Texture, Image, RenderTexture or None: red is the share of the environment that "
              "reaches the surface."},
        Field{"occlusion_strength", &Standard::occlusion_strength,
              "float: how much the occlusion map counts, from 0 to 1."},
        Field{"emissive", &Standard::emissive,
              "ndarray (3,) float32: linear RGB of the light that the surface emits, read-only."},
        Field{"emissive_map", &Standard::emissive_map, MapAlpha::ignored, MapEncoding::srgb,
              "Texture, Image, RenderTexture or None: times emissive."},
        Field{"emissive_strength", &Standard::emissive_strength,
              "float: times emissive, not negative."},
        Field{"vertex_colors", &Standard::vertex_colors,
              "bool: whether the colour is multiplied by the mesh's vertex colours."},
        Field{"alpha_mode", &Standard::alpha_mode,
              "str or None: what alpha does; None blends if anything is translucent."},
        Field{"alpha_cutoff", &Standard::alpha_cutoff,
              "float: with \"mask\", the smallest alpha that shows, not negative."},
        Field{"ior", &Standard::ior,
              "float: index of refraction, at least 1; 0 stands for infinity, where all light is "
              "reflected."},
        Field{"specular_weight", &Standard::specular_weight,
              "float: strength of a dielectric's reflection, from 0 to 1."},
        Field{"specular_map", &Standard::specular_map, MapAlpha::ignored, MapEncoding::linear,
              "Texture, Image, RenderTexture or None: alpha times specular_weight."},
        Field{"specular_color", &Standard::specular_color,
              "ndarray (3,) float32: linear RGB, factor of a dielectric's reflectance seen "
              "head-on, read-only."},
        Field{"specular_color_map", &Standard::specular_color_map, MapAlpha::ignored,
              MapEncoding::srgb, "Texture, Image, RenderTexture or None: times specular_color."},
        Field{"clearcoat", &Standard::clearcoat, "float: share of a clear coat, from 0 to 1."},
        Field{"clearcoat_map", &Standard::clearcoat_map, MapAlpha::ignored, MapEncoding::linear,
              "Texture, Image, RenderTexture or None: red times clearcoat."},
        Field{"clearcoat_roughness", &Standard::clearcoat_roughness,
              "float: roughness of the coat, from 0 to 1."},
        Field{"clearcoat_roughness_map", &Standard::clearcoat_roughness_map, MapAlpha::ignored,
              MapEncoding::linear,
              "Texture, Image, RenderTexture or None: green times clearcoat_roughness."},
        Field{"clearcoat_normal_map", &Standard::clearcoat_normal_map, MapAlpha::ignored,
              MapEncoding::linear,
              "Texture, Image, RenderTexture or None: normals of the coat; None: those of the "
              "mesh."},
        Field{"clearcoat_normal_scale", &Standard::clearcoat_normal_scale,
              "float: factor of x and y in clearcoat_normal_map."},
        Field{"sheen_color", &Standard::sheen_color,
              "ndarray (3,) float32: linear RGB of a layer of fibres, from 0 to 1, read-only."},
        Field{"sheen_color_map", &Standard::sheen_color_map, MapAlpha::ignored, MapEncoding::srgb,
              "Texture, Image, RenderTexture or None: times sheen_color."},
        Field{"sheen_roughness", &Standard::sheen_roughness,
              "float: how much the fibres spread, from 0 to 1."},
        Field{"sheen_roughness_map", &Standard::sheen_roughness_map, MapAlpha::ignored,
              MapEncoding::linear,
              "Texture, Image, RenderTexture or None: alpha times sheen_roughness."},
        Field{"iridescence", &Standard::iridescence, "float: share of a thin film, from 0 to 1."},
        Field{"iridescence_map", &Standard::iridescence_map, MapAlpha::ignored, MapEncoding::linear,
              "Texture, Image, RenderTexture or None: red times iridescence."},
        Field{"iridescence_ior", &Standard::iridescence_ior,
              "float: index of refraction of the film, at least 1."},
        Field{"iridescence_thickness_min", &Standard::iridescence_thickness_min,
              "float: thickness of the film in nanometres where the map is 0."},
        Field{"iridescence_thickness_max", &Standard::iridescence_thickness_max,
              "float: thickness of the film in nanometres where the map is 1, or without one."},
        Field{"iridescence_thickness_map", &Standard::iridescence_thickness_map, MapAlpha::ignored,
              MapEncoding::linear,
              "Texture, Image, RenderTexture or None: green goes from the least to the greatest "
              "thickness."},
        Field{"anisotropy", &Standard::anisotropy,
              "float: how much highlights are stretched, from 0 to 1."},
        Field{"anisotropy_rotation", &Standard::anisotropy_rotation,
              "float: angle of the stretch from the tangent, counter-clockwise, degrees."},
        Field{"anisotropy_map", &Standard::anisotropy_map, MapAlpha::ignored, MapEncoding::linear,
              "Texture, Image, RenderTexture or None: red and green are the direction, 0..1 for "
              "-1..1, blue times anisotropy."},
        Field{"transmission", &Standard::transmission,
              "float: share of the light entering a dielectric that passes through, from 0 to 1."},
        Field{"transmission_map", &Standard::transmission_map, MapAlpha::ignored,
              MapEncoding::linear,
              "Texture, Image, RenderTexture or None: red times transmission."},
        Field{"thickness", &Standard::thickness,
              "float: of the volume behind the surface, in the mesh's units; 0: a thin wall."},
        Field{"thickness_map", &Standard::thickness_map, MapAlpha::ignored, MapEncoding::linear,
              "Texture, Image, RenderTexture or None: green times thickness."},
        Field{"attenuation_distance", &Standard::attenuation_distance,
              "float: world units, above 0, after which white light has the attenuation colour; "
              "inf: never."},
        Field{"attenuation_color", &Standard::attenuation_color,
              "ndarray (3,) float32: linear RGB, from 0 to 1, read-only."},
        Field{"dispersion", &Standard::dispersion,
              "float: 20 divided by the Abbe number, not negative; 0: none."},
        Field{"unlit", &Standard::unlit,
              "bool: whether the colour alone shows, without light or emission."},
        Field{"specular", &Standard::specular,
              "str: \"levels\" looks the reflection up once, in filtered levels; \"sampled\" "
              "takes many samples."},
        Field{"specular_samples", &Standard::specular_samples,
              "int: how many samples \"sampled\" takes, from 1 to 1024."},
        Field{"multiple_scattering", &Standard::multiple_scattering,
              "bool: whether light that rough surfaces scatter several times is added."},
    };

    void check() const;
    /// With "opaque" no alpha counts; with "mask" the shader compares it with the cutoff.
    float alpha() const { return counts_alpha() ? color.a : 1.0F; }
    std::optional<AlphaMode> alpha_use() const { return alpha_mode; }
    std::optional<AlphaMask> alpha_mask() const {
        if (alpha_mode != AlphaMode::mask) return std::nullopt;
        return AlphaMask{color.a, alpha_cutoff};
    }
    /// As shaders/materials/standard/constants.glsl names them.
    std::array<glm::vec4, 46> constants(const glm::vec3& ambient) const;
    /// Every extension is a switch, so that a plain material costs nothing of the others.
    std::array<Switch, 19> switches() const;
    bool uses_environment() const { return !unlit; }
    EnvironmentParts environment_parts() const;
    bool uses_lights() const { return !unlit; }
    VertexColors uses_vertex_colors() const {
        if (!vertex_colors) return VertexColors::ignored;
        return counts_alpha() ? VertexColors::color_and_alpha : VertexColors::color;
    }
    /// Whether the shader needs the tangent frame.
    bool uses_tangents() const;
    int tangent_uv_set() const;
    /// Whether the scene behind the surface shows through it.
    bool shows_behind() const { return !unlit && transmission > 0.0F && has_dielectric(); }

    bool operator==(const Standard&) const = default;

private:
    bool counts_alpha() const { return !alpha_mode || *alpha_mode == AlphaMode::blend; }
    /// A texture may lower metallic from 1, but cannot raise it from 0.
    bool has_metal() const { return metallic > 0.0F; }
    bool has_dielectric() const;
    bool has_sheen() const { return sheen_color != glm::vec3(0.0F); }
    bool emits() const { return emissive_strength * emissive != glm::vec3(0.0F); }
    bool is_anisotropic() const { return !unlit && anisotropy > 0.0F; }
    bool is_smooth() const { return !unlit && roughness == 0.0F && !is_anisotropic(); }
    /// A smooth surface scatters once; it has one direction to look up, so it needs no samples.
    bool scatters() const { return !unlit && multiple_scattering && !is_smooth(); }
    bool samples() const { return !unlit && specular == SpecularMode::sampled && !is_smooth(); }
};

using StandardMaterial = MaterialOf<Standard>;

}  // namespace cubecam
