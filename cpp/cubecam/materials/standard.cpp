#include "cubecam/materials/standard.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/materials/volume.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>

namespace cubecam {

namespace {

/// A colour of which no channel reflects more light than there is.
void expect_reflectance(const glm::vec3& color, std::string_view name) {
    for (int i = 0; i < 3; ++i) {
        if (color[i] >= 0.0F && color[i] <= 1.0F) continue;
        expect(false, std::string(name).append(" of 3 numbers from 0 to 1"),
               describe(glm::dvec3(color)));
    }
}

void expect_light(const glm::vec3& color, std::string_view name) {
    for (int i = 0; i < 3; ++i) {
        if (color[i] >= 0.0F && fits_float(color[i])) continue;
        expect(false, std::string(name).append(" of 3 finite numbers that are not negative"),
               describe(glm::dvec3(color)));
    }
}

void expect_index(float ior, std::string_view name) {
    if (!(ior >= 1.0F && fits_float(ior))) {
        expect(false, std::string(name).append(" finite and at least 1"), describe(ior));
    }
}

bool is_set(const PlacedMap& map) { return map.source.index() != 0; }

template <class Visit>
void for_each_map(const Standard& material, Visit&& visit) {
    for_each_field<Standard>([&](const auto& field) {
        using Value = std::remove_cvref_t<decltype(material.*field.member)>;
        if constexpr (std::same_as<Value, PlacedMap>) visit(material.*field.member);
    });
}

}  // namespace

void Standard::check() const {
    expect_color(color, "color");
    expect_reflectance(glm::vec3(color), "color");
    expect_share(metallic, "metallic");
    expect_share(roughness, "roughness");
    expect_finite(normal_scale, "normal_scale");
    expect_share(occlusion_strength, "occlusion_strength");
    expect_light(emissive, "emissive");
    expect_not_negative(emissive_strength, "emissive_strength");
    expect_not_negative(alpha_cutoff, "alpha_cutoff");
    if (!(ior == 0.0F || (ior >= 1.0F && fits_float(ior)))) {
        expect(false, "ior finite and at least 1, or 0", describe(ior));
    }
    expect_share(specular_weight, "specular_weight");
    expect_light(specular_color, "specular_color");
    expect_share(clearcoat, "clearcoat");
    expect_share(clearcoat_roughness, "clearcoat_roughness");
    expect_finite(clearcoat_normal_scale, "clearcoat_normal_scale");
    expect_reflectance(sheen_color, "sheen_color");
    expect_share(sheen_roughness, "sheen_roughness");
    expect_share(iridescence, "iridescence");
    expect_index(iridescence_ior, "iridescence_ior");
    expect_not_negative(iridescence_thickness_min, "iridescence_thickness_min");
    expect_not_negative(iridescence_thickness_max, "iridescence_thickness_max");
    expect_share(anisotropy, "anisotropy");
    expect_finite(anisotropy_rotation, "anisotropy_rotation");
    expect_share(transmission, "transmission");
    expect_not_negative(thickness, "thickness");
    if (!(attenuation_distance > 0.0F)) {
        expect(false, "attenuation_distance above 0, or inf", describe(attenuation_distance));
    }
    expect_reflectance(attenuation_color, "attenuation_color");
    expect_not_negative(dispersion, "dispersion");
    if (specular_samples < 1 || specular_samples > most_samples) {
        expect(false, "specular_samples from 1 to " + std::to_string(most_samples),
               std::to_string(specular_samples));
    }
}

bool Standard::has_dielectric() const { return metallic < 1.0F || is_set(metallic_roughness_map); }

bool Standard::uses_tangents() const {
    if (unlit) return false;
    return is_set(normal_map) || is_anisotropic() ||
           (clearcoat > 0.0F && is_set(clearcoat_normal_map));
}

int Standard::tangent_uv_set() const {
    for (const PlacedMap* map_of_frame : {&normal_map, &anisotropy_map}) {
        if (is_set(*map_of_frame)) return map_of_frame->placing.uv_set;
    }
    return clearcoat_normal_map.placing.uv_set;
}

EnvironmentParts Standard::environment_parts() const {
    if (unlit) return {};
    const bool levels = !is_smooth() && specular == SpecularMode::levels;
    const bool coat = clearcoat > 0.0F && clearcoat_roughness > 0.0F;
    // Irradiance lights every surface except a metal that scatters once.
    const bool irradiance = has_dielectric() || scatters() || has_sheen();
    return {levels || coat || irradiance, samples()};
}

std::array<glm::vec4, 46> Standard::constants(const glm::vec3& ambient) const {
    const float head_on = (ior - 1.0F) / (ior + 1.0F);
    const float turn = glm::radians(anisotropy_rotation);
    // Both microfacets of a thin wall, or the one of a volume, blur what lies behind the less, the
    // less they bend light (KHR_materials_transmission, "Refraction").
    const float blur = ior == 0.0F ? 1.0F : std::clamp(2.0F * ior - 2.0F, 0.0F, 1.0F);
    std::array<glm::vec4, 46> all{
        color,
        glm::vec4(metallic, roughness, normal_scale, alpha_cutoff),
        glm::vec4(emissive * emissive_strength, occlusion_strength),
        glm::vec4(head_on * head_on * specular_color, specular_weight),
        glm::vec4(ambient, static_cast<float>(specular_samples)),
        glm::vec4(clearcoat, clearcoat_roughness, clearcoat_normal_scale, anisotropy),
        glm::vec4(sheen_color, sheen_roughness),
        glm::vec4(iridescence, iridescence_ior, iridescence_thickness_min,
                  iridescence_thickness_max),
        glm::vec4(std::cos(turn), std::sin(turn), transmission, thickness),
        glm::vec4(extinction_of(attenuation_color, attenuation_distance), 0.0F),
        glm::vec4(ratios_of_refraction(ior, dispersion), blur),
        glm::vec4(0.0F),
    };
    std::size_t place = 12;
    for_each_map(*this, [&all, &place](const PlacedMap& one) {
        const glm::mat3x2 to_map = matrix(one.placing);
        const auto set = static_cast<float>(one.placing.uv_set);
        all[place++] = {to_map[0][0], to_map[1][0], to_map[2][0], set};
        all[place++] = {to_map[0][1], to_map[1][1], to_map[2][1], 0.0F};
    });
    return all;
}

std::array<Switch, 19> Standard::switches() const {
    bool placed = false;
    for_each_map(*this, [&placed](const PlacedMap& one) {
        placed = placed || (is_set(one) && one.placing != MapPlacing{});
    });
    const bool coated = !unlit && clearcoat > 0.0F;
    const bool volume = shows_behind() && thickness > 0.0F;
    return {{
        {"UNLIT", unlit},
        {"PLACED", placed},
        {"ALPHA_MASK", alpha_mode == AlphaMode::mask},
        {"ALPHA_OPAQUE", alpha_mode == AlphaMode::opaque},
        {"METAL", !unlit && has_metal()},
        {"DIELECTRIC", !unlit && has_dielectric()},
        {"SMOOTH", is_smooth()},
        {"SAMPLED", samples()},
        {"MULTIPLE_SCATTERING", scatters()},
        {"EMISSION", !unlit && emits()},
        {"CLEARCOAT", coated},
        {"CLEARCOAT_SMOOTH", coated && clearcoat_roughness == 0.0F},
        {"COAT_SCATTERING", coated && multiple_scattering},
        {"SHEEN", !unlit && has_sheen()},
        {"IRIDESCENCE", !unlit && iridescence > 0.0F},
        {"ANISOTROPY", is_anisotropic()},
        {"TRANSMISSION", shows_behind()},
        {"VOLUME", volume},
        {"DISPERSION", volume && dispersion > 0.0F && ior > 1.0F},
    }};
}

}  // namespace cubecam
