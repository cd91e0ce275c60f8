#pragma once

#include "cubecam/scene/cubemap.hpp"
#include "cubecam/scene/light.hpp"
#include "cubecam/scene/material.hpp"
#include "cubecam/scene/mesh.hpp"
#include "cubecam/scene/probe.hpp"

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

struct NodeSnapshot {
    std::int32_t id;
    glm::dmat4 world;
    Bounds world_bounds;
    std::shared_ptr<const Mesh> mesh;  ///< never null: groups are left out
    Material::State material;
    FrozenSource environment;  ///< the node's own; none: the scene's
    FrozenSource cubemap;      ///< what a BasicMaterial shows
    bool in_probes;            ///< of the node and all above it
    bool translucent;
    std::vector<std::int32_t> ancestors;  ///< ids of the nodes above it, nearest first
    bool casts_shadows;                   ///< opaque, and so are it and all above it set
    bool receives_shadows;
};

/// A light as it was at the moment of the snapshot; `object` names its shadow map.
struct LightSnapshot {
    std::shared_ptr<Light> object;
    LightValue value;
};

struct ProbeSnapshot {
    std::shared_ptr<Probe> object;
    ProbeValue value;
    glm::dvec3 position;                 ///< world
    std::vector<std::int32_t> excluded;  ///< ids; whole subtrees
};

/// What a call draws: values copied, meshes and images shared. Nothing in it changes any more.
struct SceneSnapshot {
    FrozenSource environment;
    std::variant<glm::vec4, FrozenCube> background;
    std::vector<NodeSnapshot> nodes;  ///< the visible ones, in order of id
    std::vector<LightSnapshot> lights;
    std::vector<ProbeSnapshot>
        probes;  ///< those that `nodes` use, in the order of their first user
};

}  // namespace cubecam
