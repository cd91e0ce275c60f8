#pragma once

#include "cubecam/core/revision.hpp"
#include "cubecam/geometry/mesh.hpp"
#include "cubecam/geometry/mesh_data.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/materials/texture_source.hpp"
#include "cubecam/scene/skin.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam {

class Node;
class Scene;
class Deformer;
struct Deformation;
struct SceneSnapshot;

/// A scale, then a rotation, then a translation.
struct Transform {
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z; unit length
    glm::dvec3 scale{1.0};

    bool operator==(const Transform&) const = default;
};

/// The parts of a transform, or a whole matrix.
using Placing = std::variant<Transform, glm::dmat4>;

/// All properties of a node except its parent and children.
struct NodeValue {
    Placing placing;
    std::shared_ptr<Mesh> mesh;          ///< null: a group
    std::shared_ptr<Material> material;  ///< not null if there is a mesh
    CubeSource environment;              ///< none: the environment of the scene
    bool visible = true;
    bool in_captures = true;
    std::string name;
    std::int32_t render_order = 0;  ///< lower numbers are drawn first, whatever the distance
    bool cast_shadow = true;        ///< false: nodes below it cast none either
    bool receive_shadow = true;     ///< whether its own surface shows shadows
    std::int32_t label = 0;         ///< a user's number, which the output "label" shows
    std::shared_ptr<Skin> skin{};   ///< null: none
    /// Of the mesh's morph targets. If there are fewer weights than targets, the others are 0.
    std::vector<float> weights{};
    /// Materials that `material` becomes while the scene shows the variant of their name.
    std::vector<std::pair<std::string, std::shared_ptr<Material>>> variants{};
    /// The node's own material while `material` is that of a variant.
    std::optional<std::shared_ptr<Material>> own_material{};

    /// All members except `placing` and `weights`, which often change alone.
    auto contents() const {
        return std::tie(mesh, material, environment, visible, in_captures, name, render_order,
                        cast_shadow, receive_shadow, label, skin, variants, own_material);
    }
};

/// @throws std::invalid_argument for a rotation that is not finite or has length 0.
glm::dquat unit_rotation(const glm::dquat& rotation);

/// Makes `material` what a node shows in a variant of its scene: the material of that name, or the
/// node's own one.
void show_material(NodeValue& value, const std::optional<std::string>& variant);

/// Normalises the rotation. Throws std::invalid_argument for a transform that is not finite or is
/// singular.
void check(Placing& placing);

/// Sets the position alone, of parts or of a matrix.
void set_position(Placing& placing, const glm::dvec3& position);

glm::dmat4 matrix_of(const Placing& placing);

/// Returns position, rotation and scale: the parts, or those of the matrix.
/// @throws std::invalid_argument for a matrix with a shear, which parts cannot express.
Transform transform_of(const Placing& placing);

/// The data that nodes share: all nodes of one scene, or nodes outside any scene that belong
/// together. A node is in a scene if it shares the scene's graph. Thanks to the mutex a snapshot
/// shows one moment.
struct NodeGraph {
    explicit NodeGraph(bool belongs_to_scene) : of_scene(belongs_to_scene) {}

    std::mutex mutex;
    const bool of_scene;
    std::weak_ptr<Scene> scene;  ///< null for a Scene that no shared_ptr owns

    // The following members need the mutex locked.

    /// Notes a change of the scene. Returns the kept snapshot, which the caller releases after the
    /// lock.
    std::shared_ptr<SceneSnapshot> changed() {
        ++changes;
        next_revision();  // newest_revision() must change as well
        moved.clear();
        return std::exchange(snapshot, nullptr);
    }
    /// Notes that a node was moved or got other weights and nothing else changed: the kept snapshot
    /// can be brought up to date.
    void node_moved(Node& node) {
        ++changes;
        next_revision();
        if (snapshot) moved.push_back(&node);
    }

    std::optional<std::string> variant;  ///< that the scene shows
    std::uint64_t changes = 0;           ///< the number of changes so far
    /// The last snapshot, while it can be used again; see Scene::snapshot.
    std::shared_ptr<SceneSnapshot> snapshot;
    std::vector<Node*> moved;       ///< since `snapshot` was valid; a node may occur several times
    std::uint64_t newest_seen = 0;  ///< newest_revision() when `snapshot` was last found valid
};

/// A mesh at a place in the world.
struct PlacedMesh {
    std::shared_ptr<Mesh> mesh;
    std::shared_ptr<const MeshData> deformed;  ///< null: the vertices of the mesh itself
    glm::dmat4 world;
};

/// An object in a scene: a placed mesh with a material, or a group that other nodes belong to.
///
/// Scene::add makes nodes. Every member function may be called from any thread.
class Node : public std::enable_shared_from_this<Node> {
public:
    /// Makes a node that is in no scene.
    Node(std::int32_t id, NodeValue value);
    ~Node();
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    /// Ids count from 1 in the order of Scene::add; a scene never uses an id twice.
    std::int32_t id() const { return id_; }

    NodeValue value() const;
    std::shared_ptr<Node> parent() const;
    std::vector<std::shared_ptr<Node>> children() const;  ///< in the order of their ids
    glm::dmat4 world_matrix() const;
    std::shared_ptr<Scene> scene() const;  ///< null: in no scene
    /// The exact bounds, in the world, of the vertices of the node and of all visible nodes below
    /// it, as if the node itself and those above it were visible; see no_bounds().
    Bounds world_bounds() const;

    /// Turns the node round its origin until its +Z axis points at `target`, a point of the world,
    /// and its +Y axis lies on the side of `up`, in the plane of `up` and the direction. An `up`
    /// along the direction is replaced by +Y of the world; if the direction lies along Y, by -Z for
    /// a target above the node and +Z for one below it. Position and scale stay.
    /// @throws std::invalid_argument for a target at the node's origin, an up of length 0, numbers
    /// that are not finite, or a matrix with a shear.
    void look_at(const glm::dvec3& target, const glm::dvec3& up = {0.0, 1.0, 0.0});

    /// Calls `change` with a copy of the NodeValue, then checks the copy. The old value stays if
    /// anything throws.
    template <class Change>
    void edit(Change&& change) {
        NodeValue old;  // these two are destroyed after the lock is released
        std::shared_ptr<SceneSnapshot> outdated;
        const Lock lock = this->lock();
        NodeValue next = value_;
        std::forward<Change>(change)(next);
        check(next.placing);
        complete(next, value_);
        check_skin(next, value_, *lock.graph);
        if (next.contents() != value_.contents()) {
            outdated = lock.graph->changed();
        } else if (next.placing != value_.placing || next.weights != value_.weights) {
            lock.graph->node_moved(*this);
        } else {
            return;
        }
        old = std::exchange(value_, std::move(next));
    }

    /// Sets NodeValue::variants, and shows that of the scene's present variant.
    void set_variants(std::vector<std::pair<std::string, std::shared_ptr<Material>>> variants);

    /// Like edit, for the placing alone: `change` gets a Placing.
    template <class Change>
    void edit_placing(Change&& change) {
        const Lock lock = this->lock();
        Placing next = value_.placing;
        std::forward<Change>(change)(next);
        check(next);
        if (next == value_.placing) return;
        value_.placing = next;
        lock.graph->node_moved(*this);
    }

    /// Sets the parent; null: no parent. Outside scenes this joins two trees into one.
    /// @throws std::invalid_argument if this would make a cycle or join a scene with nodes outside
    /// it.
    void set_parent(const std::shared_ptr<Node>& parent);

private:
    friend class Deformer;
    friend class Scene;
    friend class SnapshotBuilder;
    friend class WorldMatrices;

    struct Lock {
        std::shared_ptr<NodeGraph> graph;
        std::unique_lock<std::mutex> lock;
    };

    /// Gives a mesh without a material the default one, and a new mesh new weights, unless they
    /// are new, too.
    static void complete(NodeValue& value, const NodeValue& before);
    /// @throws std::invalid_argument for a skin that does not fit the mesh or the graph, and for
    /// weights that do not fit the mesh. Only what differs from `before` is checked.
    static void check_skin(const NodeValue& value, const NodeValue& before, const NodeGraph& graph);

    std::shared_ptr<NodeGraph> graph() const;
    Lock lock() const;

    // The following functions are called with the graph locked.
    void set_graph(std::shared_ptr<NodeGraph> graph);
    void attach(const std::shared_ptr<Node>& parent);
    void detach();
    glm::dmat4 locked_world_matrix() const;
    /// Finds the meshes of the node and of all visible nodes below it.
    void find_meshes(Deformer& deformer, std::vector<PlacedMesh>& to) const;
    /// This node and all below it.
    std::vector<std::shared_ptr<Node>> subtree();

    const std::int32_t id_;
    NodeValue value_;
    mutable std::shared_ptr<Deformation> deformation_;  ///< of the value; null: none yet
    std::shared_ptr<Node> parent_;
    std::set<std::weak_ptr<Node>, std::owner_less<>> children_;  ///< some may be destroyed
    std::size_t children_swept_at_ = 16;  ///< at this size the destroyed children are removed

    mutable std::mutex graph_guard_;    ///< only for the pointer; held for the time of a copy
    std::shared_ptr<NodeGraph> graph_;  ///< changes only while the old and the new one are locked
};

}  // namespace cubecam
