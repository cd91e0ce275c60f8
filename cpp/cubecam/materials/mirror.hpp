#pragma once

#include "cubecam/core/checks.hpp"
#include "cubecam/materials/material.hpp"

namespace cubecam {

/// env_weight * tint * environment(R) + color_weight * color; with `f0`, env_weight is multiplied
/// by Schlick's term.
struct Mirror {
    glm::vec4 tint{1.0F};
    float env_weight = 1.0F;
    glm::vec4 color{0.0F, 0.0F, 0.0F, 1.0F};
    float color_weight = 0.0F;
    std::optional<float> f0;  ///< reflectance seen head-on; none: the mirror reflects evenly

    static constexpr const char* name = "MirrorMaterial";
    static constexpr const char* shader = "materials/mirror.glsl";
    static constexpr auto fields = std::tuple{
        Field{"tint", &Mirror::tint, "ndarray (4,) float32: linear RGBA, times what is reflected."},
        Field{"env_weight", &Mirror::env_weight, "float: weight of what is reflected."},
        Field{"color", &Mirror::color, "ndarray (4,) float32: linear RGBA, read-only."},
        Field{"color_weight", &Mirror::color_weight, "float: weight of the mirror's own colour."},
        Field{"f0", &Mirror::f0,
              "float or None: the reflectance seen head-on, from 0 to 1; None reflects "
              "evenly."},
    };

    void check() const {
        expect_color(tint, "tint");
        expect_not_negative(env_weight, "env_weight");
        expect_color(color, "color");
        expect_not_negative(color_weight, "color_weight");
        if (f0 && !(*f0 >= 0.0F && *f0 <= 1.0F)) {
            expect(false, "f0 None or a reflectance from 0 to 1", describe(*f0));
        }
    }
    float alpha() const { return tint.a * color.a; }
    std::array<glm::vec4, 2> constants(const glm::vec3&) const {
        return {glm::vec4(env_weight * glm::vec3(tint), f0.value_or(0.0F)),
                glm::vec4(color_weight * glm::vec3(color), 0.0F)};
    }
    std::array<Switch, 1> switches() const { return {{{"FRESNEL", f0.has_value()}}}; }
    bool uses_environment() const { return true; }
    bool uses_lights() const { return false; }
    VertexColors uses_vertex_colors() const { return VertexColors::ignored; }

    bool operator==(const Mirror&) const = default;
};

using MirrorMaterial = MaterialOf<Mirror>;

}  // namespace cubecam
