#pragma once

#include "cubecam/core/checks.hpp"
#include "cubecam/materials/material.hpp"

namespace cubecam {

/// Phong's reflection model as lecture 000 writes it: ka * color once, plus over the lights
/// kd * color * max(N.L, 0) + ks * max(R.V, 0)^shininess where N.L > 0, highlights white.
struct Phong {
    glm::vec4 color{1.0F};
    float ka = 0.2F;
    float kd = 0.7F;
    float ks = 1.0F;
    float shininess = 10.0F;
    MapSource map;
    bool vertex_colors = false;

    static constexpr const char* name = "PhongMaterial";
    static constexpr const char* shader = "materials/phong.glsl";
    static constexpr auto fields = std::tuple{
        Field{"color", &Phong::color, "ndarray (4,) float32: linear RGBA, read-only."},
        Field{"ka", &Phong::ka, "float: ambient weight."},
        Field{"kd", &Phong::kd, "float: diffuse weight."},
        Field{"ks", &Phong::ks, "float: specular weight; highlights are white."},
        Field{"shininess", &Phong::shininess, "float: Phong's exponent."},
        Field{"map", &Phong::map, MapAlpha::counts,
              "Image, RenderTexture or None: times the colour, by the mesh's uvs. An array "
              "(H, W, C) becomes an Image."},
        Field{"vertex_colors", &Phong::vertex_colors,
              "bool: whether the colour is multiplied by the mesh's vertex colours."},
    };

    void check() const {
        expect_color(color, "color");
        expect_not_negative(ka, "ka");
        expect_not_negative(kd, "kd");
        expect_not_negative(ks, "ks");
        // GLSL leaves pow(0, 0) undefined.
        expect_positive(shininess, "shininess");
    }
    float alpha() const { return color.a; }
    /// The factors that no texture changes are multiplied here once. The model has an ambient light
    /// of its own, with radiance 1.
    std::array<glm::vec4, 2> constants(const glm::vec3& ambient) const {
        const glm::vec3 rgb(color);
        return {glm::vec4(ka * rgb * (1.0F + ambient), shininess), glm::vec4(kd * rgb, ks)};
    }
    std::array<Switch, 0> switches() const { return {}; }
    bool uses_environment() const { return false; }
    bool uses_lights() const { return true; }
    VertexColors uses_vertex_colors() const {
        return vertex_colors ? VertexColors::color_and_alpha : VertexColors::ignored;
    }

    bool operator==(const Phong&) const = default;
};

using PhongMaterial = MaterialOf<Phong>;

}  // namespace cubecam
