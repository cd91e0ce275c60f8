#pragma once

#include "cubecam/core/checks.hpp"
#include "cubecam/materials/material.hpp"

#include <algorithm>
#include <cmath>

namespace cubecam {

/// F * environment(R) + (1 - F) * tint * environment(T) with the exact dielectric F; without
/// fresnel, T alone. A rough surface sees the environment filtered.
struct Glass {
    float ior = 1.5F;  ///< index of refraction: inside over outside
    bool fresnel = true;
    glm::vec4 tint{1.0F};
    float roughness = 0.0F;

    static constexpr const char* name = "GlassMaterial";
    static constexpr const char* shader = "materials/glass.glsl";
    static constexpr auto fields = std::tuple{
        Field{"ior", &Glass::ior, "float: refractive index inside divided by the one outside."},
        Field{"fresnel", &Glass::fresnel,
              "bool: whether part of the light is reflected; False: all is refracted."},
        Field{"tint", &Glass::tint, "ndarray (4,) float32: linear RGBA, times what is refracted."},
        Field{"roughness", &Glass::roughness, "float: from 0, clear, to 1, frosted."},
    };

    void check() const {
        // The shader gets 1 / ior, which must be finite, too.
        if (!(ior > 0.0F && std::isfinite(ior) && std::isfinite(1.0F / ior))) {
            expect(false, "ior finite and above 0", describe(ior));
        }
        expect_color(tint, "tint");
        expect_share(roughness, "roughness");
    }
    float alpha() const { return tint.a; }
    std::array<glm::vec4, 2> constants(const glm::vec3&) const {
        // A surface bends rough light the less, the nearer the two indices of refraction are: the
        // rule of glTF's KHR_materials_transmission.
        const float bend = std::clamp(2.0F * std::max(ior, 1.0F / ior) - 2.0F, 0.0F, 1.0F);
        return {glm::vec4(glm::vec3(tint), 1.0F / ior),
                glm::vec4(roughness, bend * roughness, 0.0F, 0.0F)};
    }
    std::array<Switch, 2> switches() const {
        return {{{"FRESNEL", fresnel}, {"ROUGH", roughness > 0.0F}}};
    }
    EnvironmentParts environment_parts() const { return {.filtered = roughness > 0.0F}; }
    bool uses_environment() const { return true; }
    bool uses_lights() const { return false; }
    VertexColors uses_vertex_colors() const { return VertexColors::ignored; }

    bool operator==(const Glass&) const = default;
};

using GlassMaterial = MaterialOf<Glass>;

}  // namespace cubecam
