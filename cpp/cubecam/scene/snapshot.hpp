#pragma once

#include "cubecam/core/revision.hpp"
#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/geometry/mesh.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/image_effect.hpp"
#include "cubecam/scene/light.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/render_texture.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

namespace cubecam {

/// A fixed cubemap as it was at the moment of the snapshot; `object` names the GPU's copy of it.
struct CubeSnapshot {
    std::shared_ptr<CubeMap> object;
    std::shared_ptr<const CubeMapData> data;
};

/// A cube lookup in a snapshot: none, a fixed cubemap, or the index of a probe in
/// SceneSnapshot::probes.
using CubeSourceSnapshot = std::variant<std::monostate, CubeSnapshot, std::size_t>;

/// A picture that a surface shows: none, a fixed one, or the index of a render texture in the
/// `textures` of the scene that was asked for.
using MapSnapshot = std::variant<std::monostate, std::shared_ptr<const Image>, std::size_t>;

/// What one texture of a material or an effect shows.
using TextureSourceSnapshot = std::variant<MapSnapshot, CubeSourceSnapshot>;

/// Whether the texture shows nothing.
inline bool is_none(const TextureSourceSnapshot& texture) {
    return std::visit([](const auto& source) { return source.index() == 0; }, texture);
}

struct NodeSnapshot {
    std::int32_t id;
    std::uint64_t revision;  ///< of all below: nodes of one revision are equal
    glm::dmat4 world;
    Bounds bounds;  ///< of all that its vertices may reach, in the mesh's own space
    Bounds world_bounds;
    /// How far a vertex can be from the node's origin along each axis of the world, every term of
    /// the matrix product taken as positive: what rounding errors grow with.
    glm::dvec3 reach;
    std::shared_ptr<const MeshData> mesh;  ///< never null: groups are left out
    Material::State material;
    CubeSourceSnapshot environment;  ///< the node's own; none: the scene's
    /// What the material's textures show, in their order (MaterialTraits::textures); empty if none
    /// shows anything. A map is none as well if the mesh has no uvs to place it by.
    std::vector<TextureSourceSnapshot> textures;
    bool unbounded;    ///< its vertices may go anywhere: it is not culled
    bool in_captures;  ///< of the node and all above it
    bool translucent;  ///< blended over what is behind it
    Blend blend;       ///< as it is drawn
    bool depth_write;
    std::vector<std::int32_t> ancestors;  ///< ids of the nodes above it, nearest first
    bool cast_shadow;                     ///< opaque, and so are it and all above it set
    bool receive_shadow;
    std::int32_t render_order = 0;
    /// Opaque nodes of one crowd look the same to the renderer, their matrices and their materials'
    /// numbers aside: they are drawn together. From 1 in order of the first id; 0: in none.
    std::uint32_t crowd = 0;
    bool turned = false;  ///< its matrix turns the winding of its triangles

    /// After the opaque nodes and the background, far to near. So is what is opaque and leaves no
    /// depth: the background, and all that is farther, would be drawn over it.
    /// Not so a mask that leaves no colour either: it is there for what is drawn after it.
    bool drawn_as_transparent() const {
        return translucent || (!depth_write && glm::any(material.value.surface.color_write));
    }
};

/// A light as it was at the moment of the snapshot; `object` names its shadow map.
struct LightSnapshot {
    std::shared_ptr<Light> object;
    LightValue value;
};

/// An image effect as a call sees it.
struct EffectSnapshot {
    EffectValue value;
    std::uint64_t revision;
    std::vector<TextureSourceSnapshot> textures;  ///< in the order of its inputs
};

struct ProbeSnapshot {
    std::shared_ptr<Probe> object;
    ProbeValue value;
    glm::dvec3 position;                 ///< world
    std::vector<std::int32_t> excluded;  ///< ids; whole subtrees
};

struct RenderTextureSnapshot {
    std::shared_ptr<RenderTexture> object;
    RenderTextureValue value;
    CameraValue camera;
    std::size_t scene;                   ///< for SceneSnapshot::scene
    std::vector<std::int32_t> excluded;  ///< ids; whole subtrees
    std::vector<EffectSnapshot> effects;
};

/// What a call draws: values copied, meshes and images shared. Nothing in it changes any more while
/// somebody holds it.
struct SceneSnapshot {
    std::uint64_t revision = 0;  ///< two snapshots of one revision are equal
    CubeSourceSnapshot environment;
    std::variant<glm::vec4, CubeSnapshot> background;
    std::vector<NodeSnapshot> nodes;  ///< the visible ones, in order of id
    std::vector<LightSnapshot> lights;
    std::vector<ProbeSnapshot>
        probes;  ///< those that `nodes` use, in the order of their first user

    // Of the scene that was asked for; the others have none of their own.

    std::vector<EffectSnapshot> effects;  ///< of the frame

    /// Render textures that any of the scenes shows, each once, in the order of their first user.
    std::vector<RenderTextureSnapshot> textures;
    /// The other scenes that those are drawn from, each once and as it was at one moment.
    std::vector<SceneSnapshot> others;

    /// The objects, nodes aside, that it was read from, as they were.
    std::vector<SeenRevision> seen;
    /// Whether a probe follows a node of another scene, of which nothing is seen here.
    bool follows_others = false;

    /// By number: 0 is this one, then the others.
    const SceneSnapshot& scene(std::size_t number) const {
        return number == 0 ? *this : others[number - 1];
    }
};

}  // namespace cubecam
