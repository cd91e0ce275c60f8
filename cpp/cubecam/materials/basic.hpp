#pragma once

#include "cubecam/core/checks.hpp"
#include "cubecam/materials/material.hpp"

namespace cubecam {

/// An unlit surface: color * map * vertex colour * cubemap at the object-space position.
struct Basic {
    glm::vec4 color{1.0F};
    MapSource map;
    CubeSource cubemap;
    bool vertex_colors = false;

    static constexpr const char* name = "BasicMaterial";
    static constexpr const char* shader = "materials/basic.glsl";
    static constexpr auto fields = std::tuple{
        Field{"color", &Basic::color, "ndarray (4,) float32: linear RGBA, read-only."},
        Field{"map", &Basic::map, MapAlpha::counts,
              "Image, RenderTexture or None: times the colour, by the mesh's uvs. An array "
              "(H, W, C) becomes an Image."},
        Field{"cubemap", &Basic::cubemap,
              "CubeMap, Probe or None: looked up by the object-space position."},
        Field{"vertex_colors", &Basic::vertex_colors,
              "bool: whether the colour is multiplied by the mesh's vertex colours."},
    };

    void check() const { expect_color(color, "color"); }
    float alpha() const { return color.a; }
    std::array<glm::vec4, 1> constants(const glm::vec3&) const { return {color}; }
    std::array<Switch, 0> switches() const { return {}; }
    bool uses_environment() const { return false; }
    bool uses_lights() const { return false; }
    VertexColors uses_vertex_colors() const {
        return vertex_colors ? VertexColors::color_and_alpha : VertexColors::ignored;
    }

    bool operator==(const Basic&) const = default;
};

using BasicMaterial = MaterialOf<Basic>;

}  // namespace cubecam
