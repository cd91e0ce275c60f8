#include "cubecam/materials/material.hpp"

#include "cubecam/core/checks.hpp"

#include <utility>

namespace cubecam {

namespace {

void check_parameters(const BasicParameters& p) { expect_color(p.color, "color"); }

void check_parameters(const PhongParameters& p) {
    expect_color(p.color, "color");
    expect_not_negative(p.ka, "ka");
    expect_not_negative(p.kd, "kd");
    expect_not_negative(p.ks, "ks");
    // GLSL leaves pow(0, 0) undefined.
    expect_positive(p.shininess, "shininess");
}

void check_parameters(const MirrorParameters& p) {
    expect_color(p.tint, "tint");
    expect_not_negative(p.env_weight, "env_weight");
    expect_color(p.color, "color");
    expect_not_negative(p.color_weight, "color_weight");
    if (p.fresnel && !(*p.fresnel >= 0.0F && *p.fresnel <= 1.0F)) {
        expect(false, "fresnel None or a reflectance F0 from 0 to 1", describe(*p.fresnel));
    }
}

void check_parameters(const GlassParameters& p) {
    expect_positive(p.eta, "eta");
    expect_color(p.tint, "tint");
}

void check_parameters(const ShaderParameters& p) {
    expect(mentions(p.fragment.text, "shade"),
           "a fragment with a function vec3 shade(Surface surface), or vec4 with an alpha",
           p.fragment.text.empty() ? "an empty one" : "one without the word shade");
    expect(p.vertex.text.empty() || mentions(p.vertex.text, "vertex"),
           "a vertex with a function void vertex(inout Vertex vertex)",
           "one without the word vertex");
    check(p.inputs);
    if (p.displacement) expect_not_negative(*p.displacement, "displacement");
}

/// What the colours' fourth numbers multiply opacity with.
float alpha(const BasicParameters& p) { return p.color.a; }
float alpha(const PhongParameters& p) { return p.color.a; }
float alpha(const MirrorParameters& p) { return p.tint.a * p.color.a; }
float alpha(const GlassParameters& p) { return p.tint.a; }
float alpha(const ShaderParameters&) { return 1.0F; }  // what it gives only a driver knows

}  // namespace

void check(const MaterialValue& value) {
    const float opacity = value.surface.opacity;
    if (!(opacity >= 0.0F && opacity <= 1.0F)) {
        expect(false, "opacity from 0 to 1", describe(opacity));
    }
    std::visit([](const auto& parameters) { check_parameters(parameters); }, value.parameters);
}

Material::Material(MaterialValue value) : value_((cubecam::check(value), std::move(value))) {}

bool ShaderParameters::looks_up_environment() const {
    return mentions(fragment.text, "environment") || mentions(fragment.text, "environment_lod");
}

bool ShaderParameters::uses_lights() const {
    return mentions(fragment.text, "sample_light") || mentions(fragment.text, "phong");
}

bool translucent(const MaterialValue& value) {
    const float own = std::visit([](const auto& p) { return alpha(p); }, value.parameters);
    return value.surface.opacity * own < 1.0F;
}

const MapSource& map_of(const MaterialValue& value) {
    static const MapSource none;
    return std::visit(
        [](const auto& parameters) -> const MapSource& {
            if constexpr (requires { parameters.map; }) return parameters.map;
            return none;
        },
        value.parameters);
}

}  // namespace cubecam
