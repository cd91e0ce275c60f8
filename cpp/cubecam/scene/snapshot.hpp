#pragma once

#include "cubecam/core/revision.hpp"
#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/geometry/mesh.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/environment_placing.hpp"
#include "cubecam/scene/image_effect.hpp"
#include "cubecam/scene/light.hpp"
#include "cubecam/scene/planar_mirror.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/probe_blend.hpp"
#include "cubecam/scene/probe_grid.hpp"
#include "cubecam/scene/render_texture.hpp"

#include <glm/glm.hpp>

#include <cstdint>
#include <memory>
#include <variant>
#include <vector>

namespace cubecam {

class Scene;

/// A fixed cubemap at the moment of the snapshot; `object` identifies the GPU's copy of it.
struct CubeSnapshot {
    std::shared_ptr<CubeMap> object;
    std::shared_ptr<const CubeMapData> data;
};

/// The index of a planar mirror in SceneSnapshot::planar_mirrors.
struct PlanarMirrorIndex {
    std::size_t value;
};

/// Several probes; `probes` are their indices in SceneSnapshot::probes.
struct ProbeBlendSnapshot {
    std::shared_ptr<ProbeBlend> object;
    std::shared_ptr<const std::vector<std::size_t>> probes;
};

/// A cube lookup in a snapshot: none, a fixed cubemap, or the index of a probe in
/// SceneSnapshot::probes. Only as the environment of a node it may also be a planar mirror, or
/// several probes.
using CubeSourceSnapshot =
    std::variant<std::monostate, CubeSnapshot, std::size_t, PlanarMirrorIndex, ProbeBlendSnapshot>;

/// A picture that a surface shows: none, a fixed one, or the index of a render texture in the
/// `textures` of the first scene.
using MapSnapshot = std::variant<std::monostate, std::shared_ptr<const Image>, std::size_t>;

/// The contents of one texture of a material or an effect.
using TextureSourceSnapshot = std::variant<MapSnapshot, CubeSourceSnapshot>;

/// Whether the texture shows nothing.
inline bool is_none(const TextureSourceSnapshot& texture) {
    return std::visit([](const auto& source) { return source.index() == 0; }, texture);
}

struct NodeSnapshot {
    std::int32_t id;
    std::uint64_t revision;  ///< of all members below: nodes with equal revisions are equal
    glm::dmat4 world;
    Bounds bounds;  ///< of all possible positions of its vertices, in the mesh's space
    Bounds world_bounds;
    /// The largest distance of a vertex from the node's origin along each axis of the world, if
    /// every term of the matrix product were positive: rounding errors are proportional to it.
    glm::dvec3 reach;
    std::shared_ptr<const MeshData> mesh;  ///< never null: groups are not in a snapshot
    Material::State material;
    CubeSourceSnapshot environment;  ///< the environment of the node; none: that of the scene
    /// The contents of the material's textures, in the order of MaterialTraits::textures; empty if
    /// no texture is set. A map is also none if the mesh lacks the uvs that place it.
    std::vector<TextureSourceSnapshot> textures;
    bool unbounded;    ///< its vertices may be anywhere, so it is not culled
    bool in_captures;  ///< of the node and all nodes above it
    bool translucent;  ///< blended over the surfaces behind it
    Blend blend;       ///< the mode by which it is drawn
    bool depth_write;
    std::vector<std::int32_t> ancestors;  ///< ids of the nodes above it, nearest first
    bool cast_shadow;                     ///< of the node and all nodes above it
    bool receive_shadow;
    std::int32_t render_order = 0;
    std::int32_t label = 0;
    /// The number of the node's crowd, from 1 in the order of the first ids; 0: no crowd. Opaque
    /// nodes of one crowd differ only in their matrices and the numbers of their materials, so they
    /// are drawn together.
    std::uint32_t crowd = 0;
    bool turned = false;  ///< its matrix turns the winding of its triangles
    /// Whether weights or joints may change its mesh; it joins no crowd then.
    bool deforms = false;

    /// Whether the node is drawn after the opaque nodes and the background, from far to near. This
    /// includes opaque nodes that write no depth, since the background and farther nodes would be
    /// drawn over them. It excludes nodes that write no colour either: they are masks for later
    /// nodes.
    bool drawn_as_transparent() const {
        return translucent || (!depth_write && glm::any(material.value.surface.color_write));
    }

    /// Whether its triangles that show their backs are drawn first, then the others: what lies
    /// behind inside one mesh is then blended first, in whatever order its triangles are. Sums and
    /// products do not depend on the order.
    bool backs_first() const {
        return translucent && material.value.surface.double_sided && blend != Blend::additive &&
               blend != Blend::multiply;
    }
};

/// A light at the moment of the snapshot; `object` identifies its shadow map.
struct LightSnapshot {
    std::shared_ptr<Light> object;
    LightValue value;       ///< with position and direction in the world
    LightParameters own{};  ///< as they were set: relative to the parent if there is one
};

/// An image effect as a call sees it.
struct EffectSnapshot {
    EffectValue value;
    std::uint64_t revision;
    std::vector<TextureSourceSnapshot> textures;  ///< in the order of the effect's inputs
};

struct ProbeSnapshot {
    std::shared_ptr<Probe> object;
    ProbeValue value;
    glm::dvec3 position;                 ///< world
    std::vector<std::int32_t> excluded;  ///< ids of nodes, each with its subtree
};

struct ProbeGridSnapshot {
    std::shared_ptr<ProbeGrid> object;
    ProbeGridValue value;
    std::uint64_t revision;
};

struct PlanarMirrorSnapshot {
    std::shared_ptr<PlanarMirror> object;
    PlanarMirrorValue value;
};

struct RenderTextureSnapshot {
    std::shared_ptr<RenderTexture> object;
    RenderTextureValue value;
    CameraValue camera;
    std::size_t scene;                   ///< its number, for SceneSnapshot::scene
    std::vector<std::int32_t> excluded;  ///< ids of nodes, each with its subtree
    std::vector<EffectSnapshot> effects;
};

/// The data that a call draws: copies of values, shared meshes and images. A snapshot does not
/// change while it has an owner outside the scene.
struct SceneSnapshot {
    std::uint64_t revision = 0;  ///< snapshots with equal revisions are equal
    CubeSourceSnapshot environment;
    EnvironmentPlacing environment_placing;
    std::shared_ptr<const ProbeGridSnapshot> probe_grid;  ///< null: none
    std::variant<glm::vec4, CubeSnapshot> background;
    bool shows_environment = false;   ///< the background is the environment, as it is placed
    std::vector<NodeSnapshot> nodes;  ///< the visible ones, in the order of their ids
    std::vector<LightSnapshot> lights;
    std::vector<ProbeSnapshot>
        probes;  ///< those that `nodes` use, in the order of their first user
    std::vector<PlanarMirrorSnapshot> planar_mirrors;  ///< the same

    std::vector<std::int32_t> joints;  ///< ids of the nodes that move skins of `nodes`, sorted

    // Only the first scene has the following members; in `others` they are empty.

    std::weak_ptr<const Scene> origin;  ///< the scene of this snapshot

    std::vector<EffectSnapshot> effects;  ///< of the frame

    /// Render textures that any of the scenes shows, each once, in the order of their first user.
    std::vector<RenderTextureSnapshot> textures;
    /// The other scenes from which these textures are drawn; each occurs once and shows one moment.
    std::vector<SceneSnapshot> others;

    /// The objects from which the snapshot was read, except nodes, with their revisions.
    std::vector<SeenRevision> seen;
    /// Whether a probe or a light follows a node of another scene, whose changes `seen` does not
    /// contain.
    bool follows_others = false;

    /// Returns a scene by its number: 0 is this one, then the others follow.
    const SceneSnapshot& scene(std::size_t number) const {
        return number == 0 ? *this : others[number - 1];
    }
};

}  // namespace cubecam
