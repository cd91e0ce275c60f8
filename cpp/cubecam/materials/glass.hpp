#pragma once

#include "cubecam/core/checks.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/materials/volume.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>

namespace cubecam {

/// F * environment(R) + (1 - F) * tint * environment(T) with the exact dielectric F; without
/// fresnel, T alone. A rough surface sees the environment filtered. With two surfaces, T goes on to
/// the far side of the body.
struct Glass {
    float ior = 1.5F;  ///< index of refraction: inside over outside
    bool fresnel = true;
    glm::vec4 tint{1.0F};
    float roughness = 0.0F;
    int surfaces = 1;
    float dispersion = 0.0F;
    float attenuation_distance = std::numeric_limits<float>::infinity();
    glm::vec3 attenuation_color{1.0F};

    static constexpr const char* name = "GlassMaterial";
    static constexpr const char* shader = "materials/glass.glsl";
    static constexpr auto fields = std::tuple{
        Field{"ior", &Glass::ior, "float: refractive index inside divided by the one outside."},
        Field{"fresnel", &Glass::fresnel,
              "bool: whether part of the light is reflected; False: all is refracted."},
        Field{"tint", &Glass::tint, "ndarray (4,) float32: linear RGBA, times what is refracted."},
        Field{"roughness", &Glass::roughness, "float: from 0, clear, to 1, frosted."},
        Field{"surfaces", &Glass::surfaces,
              "int: 1, light is refracted where it enters; 2, also where it leaves the body."},
        Field{"dispersion", &Glass::dispersion,
              "float: 20 divided by the Abbe number, not negative; 0: none."},
        Field{
            "attenuation_distance", &Glass::attenuation_distance,
            "float: world units, above 0, after which white light in the body has the attenuation "
            "colour; inf: never."},
        Field{"attenuation_color", &Glass::attenuation_color,
              "ndarray (3,) float32: linear RGB, from 0 to 1, read-only."},
    };

    void check() const {
        // The shader gets 1 / ior, which must be finite, too.
        if (!(ior > 0.0F && std::isfinite(ior) && std::isfinite(1.0F / ior))) {
            expect(false, "ior finite and above 0", describe(ior));
        }
        expect_color(tint, "tint");
        expect_share(roughness, "roughness");
        if (surfaces != 1 && surfaces != 2) {
            expect(false, "surfaces of 1 or 2", std::to_string(surfaces));
        }
        expect_not_negative(dispersion, "dispersion");
        if (!(attenuation_distance > 0.0F)) {
            expect(false, "attenuation_distance above 0, or inf", describe(attenuation_distance));
        }
        for (int i = 0; i < 3; ++i) expect_share(attenuation_color[i], "attenuation_color");
    }
    float alpha() const { return tint.a; }
    std::array<glm::vec4, 4> constants(const glm::vec3&) const {
        // A surface bends rough light the less, the nearer the two indices of refraction are: the
        // rule of glTF's KHR_materials_transmission.
        const float bend = std::clamp(2.0F * std::max(ior, 1.0F / ior) - 2.0F, 0.0F, 1.0F);
        return {glm::vec4(glm::vec3(tint), 1.0F / ior),
                glm::vec4(roughness, bend * roughness, 0.0F, 0.0F),
                glm::vec4(ratios_of_refraction(ior, dispersion), 0.0F),
                glm::vec4(extinction_of(attenuation_color, attenuation_distance), 0.0F)};
    }
    std::size_t constants_read() const { return shows_far_side() || disperses() ? 4 : 2; }
    std::array<Switch, 3> switches() const {
        return {{{"FRESNEL", fresnel}, {"ROUGH", roughness > 0.0F}, {"DISPERSION", disperses()}}};
    }
    EnvironmentParts environment_parts() const { return {.filtered = roughness > 0.0F}; }
    bool uses_environment() const { return true; }
    bool uses_lights() const { return false; }
    VertexColors uses_vertex_colors() const { return VertexColors::ignored; }
    bool shows_far_side() const { return surfaces == 2; }

    bool operator==(const Glass&) const = default;

private:
    bool disperses() const { return dispersion > 0.0F && ior != 1.0F; }
};

using GlassMaterial = MaterialOf<Glass>;

}  // namespace cubecam
