#pragma once

#include "cubecam/image/encoding.hpp"
#include "cubecam/materials/kind.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam {

/// The largest number of textures and of switches of one material, except the textures of a user's
/// shader. How many of them may be set at once depends on the driver.
inline constexpr std::size_t most_material_textures = 32;
inline constexpr std::size_t most_material_switches = 64;

/// What all materials of a kind have in common. Each kind has one object, so that pointers
/// distinguish kinds.
struct KindInfo {
    std::string_view name;                ///< in Python: "MirrorMaterial"
    std::string_view shader;              ///< the GLSL file: "materials/mirror.glsl"
    std::size_t constants;                ///< vec4s of its uniform block
    std::span<const char* const> fields;  ///< names of the parameters
};

/// A texture that a material looks up, with the name of its field or of a user's sampler. The
/// pointer points into the material's own model, so that no texture has a second owner
/// (scene/cycle_collector.cpp counts owners).
struct NamedTexture {
    std::string_view name;
    std::variant<const MapSource*, const CubeSource*> source;
    bool placed_by_uv;                    ///< shown only on meshes that have uvs
    bool alpha_counts;                    ///< its alpha, if below 1, makes the surface translucent
    const MapPlacing* placing = nullptr;  ///< null: by the mesh's uvs, as they are
    bool srgb = false;                    ///< if it has 8 bits, it is decoded
};

/// The set of texture coordinates by which a texture is placed.
inline int uv_set_of(const NamedTexture& texture) {
    return texture.placing == nullptr ? 0 : texture.placing->uv_set;
}

/// Everything that drawing needs to know about a material, computed once when the material changes.
struct MaterialTraits {
    const KindInfo* kind;
    float alpha;                            ///< the alpha of its colours, without the opacity
    std::vector<const char*> switch_names;  ///< every switch of the kind, set or not
    std::uint64_t switches = 0;             ///< bit i: switch_names[i] is set
    std::vector<NamedTexture> textures;     ///< all of them, in the order of the fields
    bool textured = false;                  ///< whether any of them is set, or is a user's
    bool uses_environment;
    EnvironmentParts environment_parts;
    bool uses_lights;
    bool zeros_and_ones = false;  ///< all colours are, so sRGB encoding does not change them
    VertexColors vertex_colors;
    std::optional<AlphaMode> alpha_mode;  ///< none: blended if any alpha is below 1
    /// Whether it needs tangents. A kind may say so by `bool uses_tangents() const`; meshes without
    /// tangents then get those of one of their sets of uvs, by `int tangent_uv_set() const`.
    bool uses_tangents = false;
    int tangent_uv_set = 0;
    std::optional<AlphaMask> alpha_mask;
    /// Whether the scene behind shows through the surface, which is not blended: the material calls
    /// scene_behind() (shaders/include/behind.glsl). A kind says so by `bool shows_behind() const`.
    bool shows_behind = false;
    /// Whether light goes through the body to its far side: the material calls through_body()
    /// (shaders/include/body.glsl). A kind says so by `bool shows_far_side() const`.
    bool shows_far_side = false;
    /// How many of the kind's numbers its shader reads with these switches: all of them, unless the
    /// kind says so by `std::size_t constants_read() const`.
    std::size_t constants = 0;
    std::optional<UserCode> user_code;

    bool moves_vertices() const { return user_code && user_code->moves_vertices(); }
};

/// The parameters of a material of any kind. A model never changes, so that any number of scenes
/// and snapshots share it.
class MaterialModel {
public:
    virtual ~MaterialModel() = default;
    MaterialModel(const MaterialModel&) = delete;
    MaterialModel& operator=(const MaterialModel&) = delete;

    const MaterialTraits& traits() const { return traits_; }

    /// Writes the numbers that the shader file reads as material[i]. `ambient` is the sum of the
    /// scene's ambient lights; `to` has `traits().constants` elements.
    virtual void write_constants(const glm::vec3& ambient, std::span<glm::vec4> to) const = 0;

    /// Whether both models have the same kind and equal parameters.
    virtual bool equals(const MaterialModel& other) const = 0;

protected:
    MaterialModel() = default;

    MaterialTraits traits_{};
};

/// The only model class; `Kind` defines everything else.
template <class Kind>
class MaterialModelOf final : public MaterialModel {
    static_assert(kinds::check_kind<Kind>());

public:
    /// @throws std::invalid_argument for a parameter that is out of its range or not finite.
    explicit MaterialModelOf(Kind kind) : kind_((kind.check(), std::move(kind))) {
        traits_.kind = &info;
        traits_.alpha = kind_.alpha();
        for (const Switch& one : kind_.switches()) {
            traits_.switches |= std::uint64_t{one.on} << traits_.switch_names.size();
            traits_.switch_names.push_back(one.name);
        }
        traits_.uses_environment = kind_.uses_environment();
        if constexpr (kinds::HasEnvironmentParts<Kind>) {
            traits_.environment_parts = kind_.environment_parts();
        }
        traits_.uses_lights = kind_.uses_lights();
        traits_.vertex_colors = kind_.uses_vertex_colors();
        if constexpr (kinds::HasAlphaUse<Kind>) traits_.alpha_mode = kind_.alpha_use();
        if constexpr (kinds::HasAlphaMask<Kind>) traits_.alpha_mask = kind_.alpha_mask();
        if constexpr (kinds::HasShowsBehind<Kind>) traits_.shows_behind = kind_.shows_behind();
        if constexpr (kinds::HasShowsFarSide<Kind>) {
            traits_.shows_far_side = kind_.shows_far_side();
        }
        traits_.constants = constant_count;
        if constexpr (kinds::HasConstantsRead<Kind>) traits_.constants = kind_.constants_read();
        if constexpr (kinds::HasUsesTangents<Kind>) traits_.uses_tangents = kind_.uses_tangents();
        if constexpr (kinds::HasTangentUvSet<Kind>) {
            traits_.tangent_uv_set = kind_.tangent_uv_set();
        }
        if constexpr (kinds::HasUserCode<Kind>) traits_.user_code = kind_.user_code();
        for_each_field<Kind>([this](const auto& field) { add_textures(field); });
        const auto shows = [this](const NamedTexture& texture) {
            return traits_.user_code ||
                   std::visit([](const auto* source) { return source->index() != 0; },
                              texture.source);
        };
        traits_.zeros_and_ones = !traits_.user_code && has_zeros_and_ones();
        traits_.textured = std::any_of(traits_.textures.begin(), traits_.textures.end(), shows);
    }

    const Kind& kind() const { return kind_; }

    void write_constants(const glm::vec3& ambient, std::span<glm::vec4> to) const override {
        const auto constants = kind_.constants(ambient);
        std::copy_n(constants.begin(), std::min(to.size(), constants.size()), to.begin());
    }

    bool equals(const MaterialModel& other) const override {
        const auto* same = dynamic_cast<const MaterialModelOf*>(&other);
        return same != nullptr && same->kind_ == kind_;
    }

private:
    bool has_zeros_and_ones() const {
        bool all = true;
        for_each_field<Kind>([&](const auto& field) {
            if constexpr (requires(glm::vec4 color) { color = kind_.*field.member; }) {
                all = all && cubecam::zeros_and_ones(kind_.*field.member);
            } else if constexpr (requires(glm::vec3 color) { color = kind_.*field.member; }) {
                all = all && cubecam::zeros_and_ones(glm::vec4(kind_.*field.member, 1.0F));
            }
        });
        return all;
    }

    template <class Value>
    void add_textures(const Field<Kind, Value>& field) {
        if constexpr (std::same_as<Value, MapSource>) {
            traits_.textures.push_back(
                {field.name, &(kind_.*field.member), true, field.alpha == MapAlpha::counts});
        } else if constexpr (std::same_as<Value, PlacedMap>) {
            const PlacedMap& map = kind_.*field.member;
            traits_.textures.push_back({field.name, &map.source, true,
                                        field.alpha == MapAlpha::counts, &map.placing,
                                        field.encoding == MapEncoding::srgb});
        } else if constexpr (std::same_as<Value, CubeSource>) {
            traits_.textures.push_back({field.name, &(kind_.*field.member), false, false});
        } else if constexpr (std::same_as<Value, ShaderInputs>) {
            traits_.user_code->first_texture = traits_.textures.size();
            for (const auto& [name, source] : (kind_.*field.member).textures) {
                std::visit(
                    [&, &key = name](const auto& texture) {
                        traits_.textures.push_back({key, &texture, false, false});
                    },
                    source);
            }
        }
    }

    static constexpr auto names = std::apply(
        [](const auto&... field) {
            return std::array<const char*, sizeof...(field)>{field.name...};
        },
        Kind::fields);

    static constexpr std::size_t constant_count =
        std::tuple_size_v<decltype(std::declval<const Kind&>().constants(glm::vec3()))>;
    static_assert(constant_count <= 1024,
                  "a material kind has at most 1024 vec4 in its uniform block");
    static_assert(kinds::MembersOf<Kind>::textures <= most_material_textures,
                  "a material kind has at most 32 fields that are textures");
    static_assert(std::tuple_size_v<decltype(std::declval<const Kind&>().switches())> <=
                      most_material_switches,
                  "a material kind has at most 64 switches");

    static constexpr KindInfo info{Kind::name, Kind::shader, constant_count, names};

    Kind kind_;
};

}  // namespace cubecam
