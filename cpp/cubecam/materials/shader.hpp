#pragma once

#include "cubecam/core/checks.hpp"
#include "cubecam/materials/material.hpp"

#include <algorithm>
#include <initializer_list>

namespace cubecam {

/// A material in a user's own GLSL: `shade(Surface)` for every fragment and, optionally,
/// `vertex(inout Vertex)` for every vertex (shaders/include/scene.glsl).
struct Shader {
    UserSource fragment;
    UserSource vertex;  ///< empty: vertices stay where they are
    ShaderInputs inputs;
    /// The largest distance by which `vertex` moves a vertex, in the mesh's units; none: unknown,
    /// so the node is never culled.
    std::optional<float> displacement;

    static constexpr const char* name = "ShaderMaterial";
    static constexpr const char* shader = "materials/shader.glsl";
    static constexpr auto fields = std::tuple{
        Field{"fragment", &Shader::fragment,
              "str: GLSL of every fragment. Setting it, to text or a path, shows in the next "
              "picture."},
        Field{"vertex", &Shader::vertex, "str or None: GLSL of every vertex."},
        Field{"inputs", &Shader::inputs, "What the source looks up by name."},
        Field{"displacement", &Shader::displacement,
              "float or None: how far `vertex` moves a vertex at most, in the mesh's units; None: "
              "unknown, so the node is never culled."},
    };

    void check() const {
        expect(mentions(fragment.text, "shade"),
               "a fragment with a function vec3 shade(Surface surface), or vec4 with an alpha",
               fragment.text.empty() ? "an empty one" : "one without the word shade");
        expect(vertex.text.empty() || mentions(vertex.text, "vertex"),
               "a vertex with a function void vertex(inout Vertex vertex)",
               "one without the word vertex");
        cubecam::check(inputs);
        if (displacement) expect_not_negative(*displacement, "displacement");
    }
    float alpha() const { return 1.0F; }  // the alpha of shade() is known only when it runs
    std::array<glm::vec4, 0> constants(const glm::vec3&) const { return {}; }
    std::array<Switch, 0> switches() const { return {}; }
    bool uses_environment() const {
        for (const char* word :
             {"environment", "environment_at", "environment_lod", "environment_levels",
              "environment_position", "environment_is_local", "environment_filtered",
              "environment_irradiance", "environment_mip", "environment_size"}) {
            if (mentions(fragment.text, word)) return true;
        }
        return false;
    }
    /// The words that need levels by roughness, and those that see such levels only where an
    /// environment has them anyway.
    EnvironmentParts environment_parts() const {
        const auto any = [this](std::initializer_list<const char*> words) {
            return std::any_of(words.begin(), words.end(),
                               [this](const char* word) { return mentions(fragment.text, word); });
        };
        return {.filtered = any({"environment_filtered", "environment_irradiance", "brdf"}),
                .mipmaps = any({"environment_mip", "environment_size"}),
                .filtered_if_made = any({"environment_lod", "environment_levels"})};
    }
    bool uses_lights() const {
        return mentions(fragment.text, "sample_light") || mentions(fragment.text, "phong");
    }
    VertexColors uses_vertex_colors() const { return VertexColors::color; }
    bool uses_tangents() const { return mentions(fragment.text, "tangent"); }
    UserCode user_code() const {
        return {&fragment,
                &vertex,
                &inputs,
                displacement,
                0,
                mentions(fragment.text, "uv1"),
                may_count_triangles(fragment.text)};
    }

    bool operator==(const Shader&) const = default;
};

using ShaderMaterial = MaterialOf<Shader>;

}  // namespace cubecam
