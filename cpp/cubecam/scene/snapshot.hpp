#pragma once

#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/cubemap.hpp"
#include "cubecam/scene/image_effect.hpp"
#include "cubecam/scene/light.hpp"
#include "cubecam/scene/material.hpp"
#include "cubecam/scene/mesh.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/render_texture.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

namespace cubecam {

/// A fixed cubemap as it was at the moment of the snapshot; `object` names the GPU's copy of it.
struct FrozenCube {
    std::shared_ptr<CubeMap> object;
    std::shared_ptr<const CubeMapData> data;
};

/// A cube lookup in a snapshot: none, a fixed cubemap, or the index of a probe in
/// SceneSnapshot::probes.
using FrozenSource = std::variant<std::monostate, FrozenCube, std::size_t>;

/// A picture that a surface shows: none, a fixed one, or the index of a render texture in the
/// `textures` of the scene that was asked for.
using FrozenMap = std::variant<std::monostate, std::shared_ptr<const Image>, std::size_t>;

/// One of the textures of a user's shader.
using FrozenTexture = std::variant<FrozenMap, FrozenSource>;

struct NodeSnapshot {
    std::int32_t id;
    glm::dmat4 world;
    Bounds bounds;  ///< of all that its vertices may reach, in the mesh's own space
    Bounds world_bounds;
    std::shared_ptr<const Mesh> mesh;  ///< never null: groups are left out
    Material::State material;
    FrozenSource environment;             ///< the node's own; none: the scene's
    FrozenSource cubemap;                 ///< what a BasicMaterial shows
    FrozenMap map;                        ///< none as well if the mesh has no uvs to place it by
    std::vector<FrozenTexture> textures;  ///< of a ShaderMaterial, in the order of its inputs
    bool unbounded;                       ///< its vertices may go anywhere: it is not culled
    bool in_probes;                       ///< of the node and all above it
    bool translucent;                     ///< blended over what is behind it
    Blend blend;                          ///< as it is drawn
    bool depth_write;
    std::vector<std::int32_t> ancestors;  ///< ids of the nodes above it, nearest first
    std::int32_t render_order = 0;

    /// After the opaque nodes and the background, far to near. So is what is opaque and leaves no
    /// depth: the background, and all that is farther, would be drawn over it.
    bool drawn_late() const { return translucent || !depth_write; }
};

/// An image effect as a call sees it.
struct EffectSnapshot {
    EffectValue value;
    std::uint64_t revision;
    std::vector<FrozenTexture> textures;  ///< in the order of its inputs
};

struct ProbeSnapshot {
    std::shared_ptr<Probe> object;
    ProbeValue value;
    glm::dvec3 position;                 ///< world
    std::vector<std::int32_t> excluded;  ///< ids; whole subtrees
};

struct TextureSnapshot {
    std::shared_ptr<RenderTexture> object;
    RenderTextureValue value;
    CameraValue camera;
    std::size_t scene;                   ///< for SceneSnapshot::scene
    std::vector<std::int32_t> excluded;  ///< ids; whole subtrees
    std::vector<EffectSnapshot> effects;
};

/// What a call draws: values copied, meshes and images shared. Nothing in it changes any more.
struct SceneSnapshot {
    FrozenSource environment;
    std::variant<glm::vec4, FrozenCube> background;
    std::vector<NodeSnapshot> nodes;  ///< the visible ones, in order of id
    std::vector<LightValue> lights;
    std::vector<ProbeSnapshot>
        probes;  ///< those that `nodes` use, in the order of their first user

    // Of the scene that was asked for; the others have none of their own.

    std::vector<EffectSnapshot> effects;  ///< of the frame

    /// Render textures that any of the scenes shows, each once, in the order of their first user.
    std::vector<TextureSnapshot> textures;
    /// The other scenes that those are drawn from, each once and as it was at one moment.
    std::vector<SceneSnapshot> others;

    /// By number: 0 is this one, then the others.
    const SceneSnapshot& scene(std::size_t number) const {
        return number == 0 ? *this : others[number - 1];
    }
};

}  // namespace cubecam
