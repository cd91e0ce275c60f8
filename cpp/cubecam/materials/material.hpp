#pragma once

#include "cubecam/core/versioned.hpp"
#include "cubecam/image/image.hpp"
#include "cubecam/materials/blend.hpp"
#include "cubecam/materials/stencil.hpp"
#include "cubecam/materials/texture_source.hpp"
#include "cubecam/materials/user_shader.hpp"

#include <glm/glm.hpp>

#include <memory>
#include <optional>
#include <variant>

namespace cubecam {

/// What every material has.
struct SurfaceOptions {
    float opacity = 1.0F;  ///< 0..1, times the colour's alpha
    bool double_sided = false;
    std::optional<Blend> blend;       ///< none: alpha where anything is translucent, else opaque
    std::optional<bool> depth_write;  ///< none: what is opaque writes depth
    bool depth_test = true;           ///< hidden by what is nearer
    glm::bvec4 color_write{true};     ///< channels of the colour that are written
    std::optional<Stencil> stencil;   ///< none: neither tested nor written

    bool operator==(const SurfaceOptions&) const = default;
};

/// Unlit: color * map * vertex colour * cubemap at the object-space position.
struct BasicParameters {
    glm::vec4 color{1.0F};
    MapSource map;
    CubeSource cubemap;
    bool vertex_colors = false;

    bool operator==(const BasicParameters&) const = default;
};

/// Phong's reflection model as lecture 000 writes it: ka * color once, plus over the lights
/// kd * color * max(N.L, 0) + ks * max(R.V, 0)^shininess where N.L > 0, highlights white.
struct PhongParameters {
    glm::vec4 color{1.0F};
    float ka = 0.2F;
    float kd = 0.7F;
    float ks = 1.0F;
    float shininess = 10.0F;
    MapSource map;
    bool vertex_colors = false;

    bool operator==(const PhongParameters&) const = default;
};

/// env_weight * tint * environment(R) + color_weight * color; with `fresnel` = F0, env_weight times
/// Schlick's term.
struct MirrorParameters {
    glm::vec4 tint{1.0F};
    float env_weight = 1.0F;
    glm::vec4 color{0.0F, 0.0F, 0.0F, 1.0F};
    float color_weight = 0.0F;
    std::optional<float> fresnel;

    bool operator==(const MirrorParameters&) const = default;
};

/// F * environment(R) + (1 - F) * tint * environment(T) with the exact dielectric F; without
/// fresnel, T alone.
struct GlassParameters {
    float eta = 1.0F / 1.52F;  ///< n_outside / n_inside
    bool fresnel = true;
    glm::vec4 tint{1.0F};

    bool operator==(const GlassParameters&) const = default;
};

/// What a user's own GLSL says: `shade(Surface)` for every fragment and, if there is one,
/// `vertex(inout Vertex)` for every vertex (shaders/include/scene.glsl).
struct ShaderParameters {
    UserSource fragment;
    UserSource vertex;  ///< empty: vertices stay where they are
    ShaderInputs inputs;
    /// How far `vertex` moves a vertex at most, in the mesh's units; none: nobody knows, so nothing
    /// is culled.
    std::optional<float> displacement;

    bool moves_vertices() const { return !vertex.text.empty(); }
    bool looks_up_environment() const;
    bool uses_lights() const;
    bool operator==(const ShaderParameters&) const = default;
};

using MaterialParameters = std::variant<BasicParameters, PhongParameters, MirrorParameters,
                                        GlassParameters, ShaderParameters>;

struct MaterialValue {
    MaterialParameters parameters;
    SurfaceOptions surface;

    bool operator==(const MaterialValue&) const = default;
};

/// Throws std::invalid_argument for a parameter that is out of its range or not finite.
void check(const MaterialValue& value);

/// How a surface answers light. Shared by any number of nodes; setters are thread-safe and checked.
class Material {
public:
    using State = Versioned<MaterialValue>::State;

    explicit Material(MaterialValue value);
    virtual ~Material() = default;
    Material(const Material&) = delete;
    Material& operator=(const Material&) = delete;

    State state() const { return value_.state(); }
    MaterialValue value() const { return value_.value(); }
    const Revision& revision() const { return value_.revision(); }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](MaterialValue& value) {
            change(value);
            check(value);
        });
    }

private:
    Versioned<MaterialValue> value_;
};

/// One class per kind, so that C++ and Python users name what they mean.
template <class Parameters>
class MaterialOf : public Material {
public:
    explicit MaterialOf(Parameters parameters = {}, SurfaceOptions surface = {})
        : Material({std::move(parameters), surface}) {}

    Parameters parameters() const { return std::get<Parameters>(value().parameters); }

    template <class Change>
    void edit_parameters(Change&& change) {
        edit([&](MaterialValue& value) { change(std::get<Parameters>(value.parameters)); });
    }
};

using BasicMaterial = MaterialOf<BasicParameters>;
using PhongMaterial = MaterialOf<PhongParameters>;
using MirrorMaterial = MaterialOf<MirrorParameters>;
using GlassMaterial = MaterialOf<GlassParameters>;
using ShaderMaterial = MaterialOf<ShaderParameters>;

/// Whether the material alone makes a surface translucent (its map and the mesh's colours can,
/// too).
bool translucent(const MaterialValue& value);

/// The picture that a material shows by a mesh's uvs; none for materials that have none.
const MapSource& map_of(const MaterialValue& value);

}  // namespace cubecam
