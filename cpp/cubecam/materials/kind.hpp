#pragma once

#include "cubecam/materials/placed_map.hpp"
#include "cubecam/materials/texture_source.hpp"
#include "cubecam/materials/user_shader.hpp"

#include <glm/glm.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

/// A kind of material is a plain struct that declares everything about itself. CONTRIBUTING.md has
/// the recipe; basic.hpp, phong.hpp, mirror.hpp and glass.hpp are examples.
namespace cubecam {

/// Whether the alpha of a map multiplies the alpha of the surface.
enum class MapAlpha : bool { ignored, counts };

/// What the numbers of an 8-bit map are. The renderer decodes sRGB before it filters; maps of
/// floats are always linear.
enum class MapEncoding : bool { linear, srgb };

/// How a material uses the vertex colours of a mesh.
enum class VertexColors : std::uint8_t {
    ignored,
    color,            ///< it reads them; their alpha makes no surface translucent
    color_and_alpha,  ///< it reads them; an alpha below 1 makes the surface translucent
};

/// What the alpha of a material's colours, maps and vertices does (glTF 2.0, section 3.9.4). A kind
/// that has this choice has a function `std::optional<AlphaMode> alpha_use() const`; none: the
/// surface is blended if any alpha is below 1.
enum class AlphaMode : std::uint8_t {
    opaque,  ///< alpha does not count
    mask,    ///< the surface has holes where alpha is below a cutoff
    blend,   ///< the surface is blended, whether any alpha is below 1 or not
};

inline constexpr std::array<std::pair<std::string_view, AlphaMode>, 3> alpha_mode_names{
    {{"opaque", AlphaMode::opaque}, {"mask", AlphaMode::mask}, {"blend", AlphaMode::blend}}};

/// The holes of a surface: where the product of this factor, the alpha of the map whose alpha
/// counts (Field::alpha) and that of the vertices is below the cutoff. A kind that has them has a
/// function `std::optional<AlphaMask> alpha_mask() const`, and shadows then have the holes, too.
struct AlphaMask {
    float factor = 1.0F;  ///< the alpha of its colours
    float cutoff = 0.5F;

    bool operator==(const AlphaMask&) const = default;
};

/// One parameter of a kind: its name in Python and GLSL, the member that holds it, and the
/// docstring of the property.
template <class Kind, class Value>
struct Field {
    using Type = Value;

    const char* name;
    Value Kind::* member;
    const char* doc;
    MapAlpha alpha = MapAlpha::ignored;

    constexpr Field(const char* name_, Value Kind::* member_, const char* doc_)
        : name(name_), member(member_), doc(doc_) {}
};

/// The field of a map, which lies on the surface by its uvs, also says how its alpha is used.
template <class Kind>
struct Field<Kind, MapSource> {
    using Type = MapSource;

    const char* name;
    MapSource Kind::* member;
    const char* doc;
    MapAlpha alpha;

    constexpr Field(const char* name_, MapSource Kind::* member_, MapAlpha alpha_, const char* doc_)
        : name(name_), member(member_), doc(doc_), alpha(alpha_) {}
};

/// The field of one of several maps, each of which has its place.
template <class Kind>
struct Field<Kind, PlacedMap> {
    using Type = PlacedMap;

    const char* name;
    PlacedMap Kind::* member;
    const char* doc;
    MapAlpha alpha;
    MapEncoding encoding;

    constexpr Field(const char* name_, PlacedMap Kind::* member_, MapAlpha alpha_,
                    MapEncoding encoding_, const char* doc_)
        : name(name_), member(member_), doc(doc_), alpha(alpha_), encoding(encoding_) {}
};

template <class Kind, class Value>
Field(const char*, Value Kind::*, const char*) -> Field<Kind, Value>;
template <class Kind>
Field(const char*, PlacedMap Kind::*, MapAlpha, MapEncoding, const char*) -> Field<Kind, PlacedMap>;
template <class Kind>
Field(const char*, MapSource Kind::*, MapAlpha, const char*) -> Field<Kind, MapSource>;

/// A define of the material's shader that is on or off. Each combination of switches is a separate
/// program, since llvmpipe runs both sides of a branch.
struct Switch {
    const char* name;
    bool on;
};

/// What a material looks up of its environment besides the cube itself; see
/// shaders/include/environment.glsl. A kind that needs any of it has a function
/// `EnvironmentParts environment_parts() const`.
struct EnvironmentParts {
    bool filtered = false;  ///< levels by roughness, and irradiance
    bool mipmaps = false;   ///< box-filtered levels, whether the cube has them or not
    /// Levels by roughness if the environment has them anyway: a filtered cubemap, or a probe with
    /// prefilter=True.
    bool filtered_if_made = false;

    bool operator==(const EnvironmentParts&) const = default;
};

/// The GLSL that a user wrote for a material; the pointers point into the material.
struct UserCode {
    const UserSource* fragment = nullptr;
    const UserSource* vertex = nullptr;
    const ShaderInputs* inputs = nullptr;
    /// The largest distance by which `vertex` moves a vertex, in the mesh's units; none: unknown.
    std::optional<float> displacement;
    /// The index of the first texture of `inputs` among the textures of the material.
    std::size_t first_texture = 0;

    bool uses_uvs1 = false;  ///< whether `fragment` reads the second set of uvs

    /// Whether `fragment` may read the number of its triangle, which counts those of the draw call.
    bool counts_triangles = false;

    bool moves_vertices() const { return !vertex->text.empty(); }
};

namespace kinds {

template <class Kind>
concept HasName = requires {
    { Kind::name } -> std::convertible_to<std::string_view>;
};
template <class Kind>
concept HasShader = requires {
    { Kind::shader } -> std::convertible_to<std::string_view>;
};
template <class Kind>
concept HasFields = requires { std::tuple_size<std::remove_cv_t<decltype(Kind::fields)>>::value; };
template <class Kind>
concept HasCheck = requires(const Kind& kind) {
    { kind.check() } -> std::same_as<void>;
};
template <class Kind>
concept HasAlpha = requires(const Kind& kind) {
    { kind.alpha() } -> std::same_as<float>;
};
template <class Value>
struct IsArrayOfVec4 : std::false_type {};
template <std::size_t size>
struct IsArrayOfVec4<std::array<glm::vec4, size>> : std::true_type {};
template <class Kind>
concept HasConstants = requires(const Kind& kind, const glm::vec3& ambient) {
    requires IsArrayOfVec4<decltype(kind.constants(ambient))>::value;
};
template <class Value>
struct IsArrayOfSwitches : std::false_type {};
template <std::size_t size>
struct IsArrayOfSwitches<std::array<Switch, size>> : std::true_type {};
template <class Kind>
concept HasSwitches =
    requires(const Kind& kind) { requires IsArrayOfSwitches<decltype(kind.switches())>::value; };
template <class Kind>
concept HasUsesEnvironment = requires(const Kind& kind) {
    { kind.uses_environment() } -> std::same_as<bool>;
};
template <class Kind>
concept HasUsesLights = requires(const Kind& kind) {
    { kind.uses_lights() } -> std::same_as<bool>;
};
template <class Kind>
concept HasUsesVertexColors = requires(const Kind& kind) {
    { kind.uses_vertex_colors() } -> std::same_as<VertexColors>;
};
template <class Kind>
concept HasEnvironmentParts = requires(const Kind& kind) {
    { kind.environment_parts() } -> std::same_as<EnvironmentParts>;
};
template <class Kind>
concept HasAlphaUse = requires(const Kind& kind) {
    { kind.alpha_use() } -> std::same_as<std::optional<AlphaMode>>;
};
template <class Kind>
concept HasAlphaMask = requires(const Kind& kind) {
    { kind.alpha_mask() } -> std::same_as<std::optional<AlphaMask>>;
};
template <class Kind>
concept HasShowsBehind = requires(const Kind& kind) {
    { kind.shows_behind() } -> std::same_as<bool>;
};
template <class Kind>
concept HasShowsFarSide = requires(const Kind& kind) {
    { kind.shows_far_side() } -> std::same_as<bool>;
};
template <class Kind>
concept HasConstantsRead = requires(const Kind& kind) {
    { kind.constants_read() } -> std::same_as<std::size_t>;
};
template <class Kind>
concept HasUsesTangents = requires(const Kind& kind) {
    { kind.uses_tangents() } -> std::same_as<bool>;
};
template <class Kind>
concept HasTangentUvSet = requires(const Kind& kind) {
    { kind.tangent_uv_set() } -> std::same_as<int>;
};
template <class Kind>
concept HasUserCode = requires(const Kind& kind) {
    { kind.user_code() } -> std::same_as<UserCode>;
};

template <class Kind>
inline constexpr std::size_t field_count =
    std::tuple_size_v<std::remove_cv_t<decltype(Kind::fields)>>;

template <class Kind, std::size_t index>
using FieldType =
    typename std::tuple_element_t<index, std::remove_cv_t<decltype(Kind::fields)>>::Type;

template <class Kind, class Indices>
struct Members;

template <class Kind, std::size_t... index>
struct Members<Kind, std::index_sequence<index...>> {
    /// Whether the fields' values, in their order, initialize the struct.
    static constexpr bool fit = requires { Kind{std::declval<FieldType<Kind, index>>()...}; };
    /// Whether the struct takes one more value, so that some member has no field.
    static constexpr bool more = requires { Kind{std::declval<FieldType<Kind, index>>()..., {}}; };
    static constexpr std::size_t textures =
        ((std::size_t{std::same_as<FieldType<Kind, index>, MapSource> ||
                      std::same_as<FieldType<Kind, index>, PlacedMap> ||
                      std::same_as<FieldType<Kind, index>, CubeSource>}) +
         ... + 0);
    static constexpr bool user_code = ((std::same_as<FieldType<Kind, index>, UserSource> ||
                                        std::same_as<FieldType<Kind, index>, ShaderInputs>) ||
                                       ...);
};

template <class Kind>
using MembersOf = Members<Kind, std::make_index_sequence<field_count<Kind>>>;

/// Whether all fields have different names and different members.
template <class Kind>
constexpr bool fields_differ() {
    return std::apply(
        [](const auto&... all) {
            const auto count_of = [&](const auto& field) {
                const auto same = [&](const auto& other) {
                    if (std::string_view(other.name) == field.name) return 1;
                    if constexpr (std::same_as<decltype(other.member), decltype(field.member)>) {
                        if (other.member == field.member) return 1;
                    }
                    return 0;
                };
                return (same(all) + ... + 0);
            };
            return ((count_of(all) == 1) && ...);
        },
        Kind::fields);
}

template <class Kind>
concept HasEveryField = HasFields<Kind> && std::is_aggregate_v<Kind> && MembersOf<Kind>::fit &&
                        !MembersOf<Kind>::more && fields_differ<Kind>();

template <class Kind>
concept SaysUserCode = !MembersOf<Kind>::user_code || HasUserCode<Kind>;

}  // namespace kinds

/// A complete kind of material. For an incomplete one, `kinds::check_kind` reports what is missing.
template <class Kind>
concept MaterialKind =
    kinds::HasName<Kind> && kinds::HasShader<Kind> && kinds::HasFields<Kind> &&
    kinds::HasEveryField<Kind> && kinds::HasCheck<Kind> && kinds::HasAlpha<Kind> &&
    kinds::HasConstants<Kind> && kinds::HasSwitches<Kind> && kinds::HasUsesEnvironment<Kind> &&
    kinds::HasUsesLights<Kind> && kinds::HasUsesVertexColors<Kind> && kinds::SaysUserCode<Kind> &&
    std::equality_comparable<Kind> && std::default_initializable<Kind>;

namespace kinds {

/// Does not compile unless `Kind` is a MaterialKind; the compiler's message then says what is
/// missing.
template <class Kind>
constexpr bool check_kind() {
    static_assert(HasName<Kind>, "a material kind needs its name in Python: "
                                 "static constexpr const char* name = \"MirrorMaterial\";");
    static_assert(HasShader<Kind>,
                  "a material kind needs its GLSL file: "
                  "static constexpr const char* shader = \"materials/mirror.glsl\";");
    static_assert(HasFields<Kind>,
                  "a material kind needs the list of its parameters: static constexpr auto fields "
                  "= std::tuple{Field{\"tint\", &Mirror::tint, \"docstring\"}};");
    if constexpr (HasFields<Kind>) {
        static_assert(std::is_aggregate_v<Kind>,
                      "a material kind must be a plain struct without constructors or private "
                      "members");
        static_assert(HasEveryField<Kind>,
                      "`fields` of a material kind must list every member of the struct once, in "
                      "the order of the members; a member or field is missing");
        static_assert(SaysUserCode<Kind>,
                      "a material kind with a user's GLSL needs: UserCode user_code() const");
    }
    static_assert(HasCheck<Kind>, "a material kind needs: void check() const, which throws "
                                  "std::invalid_argument for a value out of its range");
    static_assert(HasAlpha<Kind>, "a material kind needs: float alpha() const, the factor of its "
                                  "colours for the opacity");
    static_assert(HasConstants<Kind>,
                  "a material kind needs the numbers of its uniform block: "
                  "std::array<glm::vec4, N> constants(const glm::vec3& ambient) const");
    static_assert(HasSwitches<Kind>, "a material kind needs the defines of its shader: "
                                     "std::array<Switch, N> switches() const");
    static_assert(HasUsesEnvironment<Kind>, "a material kind needs: bool uses_environment() const");
    static_assert(HasUsesLights<Kind>, "a material kind needs: bool uses_lights() const");
    static_assert(HasUsesVertexColors<Kind>,
                  "a material kind needs: VertexColors uses_vertex_colors() const");
    static_assert(std::equality_comparable<Kind>,
                  "a material kind needs: bool operator==(const Mirror&) const = default");
    static_assert(std::default_initializable<Kind>,
                  "every member of a material kind needs a default value");
    return true;
}

}  // namespace kinds

/// Calls `visit` with every field of a kind, in order.
template <MaterialKind Kind, class Visit>
constexpr void for_each_field(Visit&& visit) {
    std::apply([&](const auto&... field) { (visit(field), ...); }, Kind::fields);
}

}  // namespace cubecam
