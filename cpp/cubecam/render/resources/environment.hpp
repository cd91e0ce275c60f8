#pragma once

#include "cubecam/materials/kind.hpp"
#include "cubecam/render/resources/body_lookup.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/filtered_texture.hpp"
#include "cubecam/scene/environment_placing.hpp"
#include "cubecam/scene/influence.hpp"
#include "cubecam/scene/parallax.hpp"
#include "cubecam/scene/probe_blend.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace cubecam {

/// How the levels of an environment's cube were made, except the finest one.
enum class EnvironmentLevels : std::uint8_t { none, mipmaps, filtered };

/// The texture of distances has the faces of a cube with a border of one texel, in three columns
/// and two rows, as FilteredTexture has them. Rows below have the same faces in blocks: the nearest
/// surface of each block and of those around it.
inline constexpr int distance_blocks = 8;  ///< along an edge of a face
constexpr int distances_width(int size) { return 3 * std::max(size + 2, distance_blocks); }
constexpr int distances_height(int size) { return 2 * (size + 2) + 2 * distance_blocks; }

/// How a surface looks up an environment that was captured in its world.
struct LocalLookup {
    Parallax method = Parallax::none;
    int fetches = 0;           ///< ParallaxValue::fetches; 0 without a march
    glm::dmat4 to_proxy{1.0};  ///< ParallaxValue::to_proxy
    BoundTexture distances;    ///< passes/distance_pass.hpp; texture 0: none
    BoundTexture farthest;     ///< a cube of the farthest surfaces; texture 0: none
    int size = 0;              ///< texels along an edge of a face

    bool has_layers() const { return farthest.texture != 0; }
    bool by_distance() const { return distances.texture != 0; }
    bool by_proxy() const { return method == Parallax::box || method == Parallax::sphere; }
};

/// The picture that a planar mirror shows instead of the environment, where a ray does not go
/// through its plane.
struct PlanarReflection {
    BoundTexture picture;    ///< texture 0: none
    glm::dvec3 normal{0.0};  ///< of the plane, unit length
    double distance = 1.0;   ///< PlanarMirrorValue::distance
};

struct EnvironmentBlend;

/// The environment that a surface reflects.
struct Environment {
    BoundTexture cube;  ///< texture 0: none, black
    EnvironmentLevels levels = EnvironmentLevels::none;
    int level_count = 1;                 ///< including the finest one
    std::optional<glm::dvec3> position;  ///< of the capture, world; none: infinitely far away
    EnvironmentPlacing placing;          ///< plain except for the scene's own environment
    EnvironmentParts parts;              ///< what the surface looks up besides the cube
    /// The levels by roughness, and the irradiance; null: not needed, or replaced by mipmaps. It
    /// stays valid for the call.
    const FilteredTexture* filtered = nullptr;
    BoundTexture box_mipmaps;  ///< the cube with box-filtered levels; texture 0: not needed
    LocalLookup local;         ///< its method is none without `position`
    PlanarReflection planar;
    /// Further environments that count besides this one, which is then a probe's; null: none.
    std::shared_ptr<const EnvironmentBlend> blend;

    /// Makes the filtered levels the levels of the environment.
    void filter(const FilteredTexture& by_roughness) {
        filtered = &by_roughness;
        levels = EnvironmentLevels::filtered;
        level_count = by_roughness.level_count();
    }

    /// Adds all values on which a picture depends.
    void add_to(std::vector<std::uint64_t>& key) const;
};

/// What reflections find on the screen.
struct ScreenTextures {
    BoundTexture picture;  ///< texture 0: rays are not looked up there
    GLuint depths = 0;     ///< passes/screen_depth_pass.hpp
};

/// What a surface sees besides its first environment, each fragment by its own place
/// (shaders/include/environment_blend.glsl).
struct EnvironmentBlend {
    std::vector<Influence> influences;  ///< of the first environment, then of those in `others`
    std::vector<Environment> others;
    /// The last of `others` is the scene's environment, which counts where no influence reaches.
    bool has_rest = false;
};

/// All textures that a node looks up.
struct NodeTextures {
    Environment environment;
    std::vector<BoundTexture> textures;  ///< in the order of the material's fields
    BoundTexture behind;  ///< the scene behind a transmissive surface; texture 0: none
    /// The inner side of the mesh, if light goes through it. It depends on the mesh alone.
    BodyLookup body;
    ScreenTextures screen;
};

/// The uniform block `Environment` of shaders/include/environment.glsl, std140.
struct EnvironmentBlock {
    glm::vec4 position{0.0F};  ///< xyz: position of the capture, w: 1; all 0: infinitely far
    glm::ivec4 levels{0};      ///< x: how many levels
    glm::vec4 turn[3];  ///< xyz: rows of the matrix from the world to the cube; [0].w: intensity
    glm::vec4 texel{0.0F};      ///< xy: FilteredTexture::texel
    glm::vec4 proxy[3];         ///< rows of LocalLookup::to_proxy, from relative to the origin
    glm::vec4 distances{0.0F};  ///< xy: a texel of the texture of distances, z: LocalLookup::size
    std::array<glm::vec4, most_filtered_levels> places{};  ///< FilteredTexture::places
    glm::vec4 planar{0.0F};  ///< PlanarReflection: xyz: normal, w: distance
};
static_assert(sizeof(EnvironmentBlock) == 176 + 16 * most_filtered_levels);

/// Whether a surface reads the block, or only the cube. `user_code`: the GLSL is a user's own.
inline bool needs_block(const Environment& environment, bool user_code) {
    return user_code || environment.parts.filtered || !environment.placing.is_plain() ||
           environment.local.method != Parallax::none || environment.planar.picture.texture != 0 ||
           environment.blend != nullptr;
}

/// `origin` is the origin of the shaders' positions.
EnvironmentBlock make_environment_block(const Environment& environment, const glm::dvec3& origin);

/// The uniform block `Influences` of shaders/include/environment_blend.glsl, std140.
struct InfluencesBlock {
    struct One {
        glm::vec4 to_box[3]{};    ///< rows of Influence::to_box, from relative to the origin
        glm::vec4 from_box[3]{};  ///< xyz: rows of Influence::from_box; [0].w: 1 / blend distance
                                  ///< [1].w: 1 for the ellipsoid
    };
    std::array<One, most_blended_probes> influences{};
};
static_assert(sizeof(InfluencesBlock) == 96 * most_blended_probes);

InfluencesBlock make_influences_block(const EnvironmentBlend& blend, const glm::dvec3& origin);

}  // namespace cubecam
