#pragma once

#include "cubecam/core/revision.hpp"
#include "cubecam/geometry/mesh.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/materials/texture_source.hpp"

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cstdint>
#include <memory>
#include <mutex>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam {

class Node;
class Scene;
struct SceneSnapshot;

/// Scale, then rotation, then translation.
struct Transform {
    glm::dvec3 position{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< w, x, y, z; unit length
    glm::dvec3 scale{1.0};

    bool operator==(const Transform&) const = default;
};

/// Parts, or a matrix given whole.
using Placing = std::variant<Transform, glm::dmat4>;

/// Everything a node is but its place in the tree.
struct NodeValue {
    Placing placing;
    std::shared_ptr<Mesh> mesh;          ///< null: a group
    std::shared_ptr<Material> material;  ///< set wherever there is a mesh
    CubeSource environment;              ///< none: the scene's
    bool visible = true;
    bool in_captures = true;
    std::string name;
    std::int32_t render_order = 0;  ///< lower is drawn first, before distance
    bool cast_shadow = true;        ///< false: nor does anything below it
    bool receive_shadow = true;     ///< of its own surface

    /// All but `placing`.
    auto contents() const {
        return std::tie(mesh, material, environment, visible, in_captures, name, render_order,
                        cast_shadow, receive_shadow);
    }
};

/// Throws std::invalid_argument for a transform that is not finite or is singular; normalises the
/// rotation.
void check(Placing& placing);

/// Position alone, which every matrix has.
void set_position(Placing& placing, const glm::dvec3& position);

glm::dmat4 matrix_of(const Placing& placing);

/// Position, rotation and scale: those given, or those of the matrix.
/// @throws std::invalid_argument where the matrix has a shear, which they cannot say.
Transform transform_of(const Placing& placing);

/// What the nodes of one tree of trees share: those of one scene, or those that are in none
/// together. The mutex makes a snapshot one moment; being in a scene is sharing the scene's graph.
struct NodeGraph {
    explicit NodeGraph(bool belongs_to_scene) : of_scene(belongs_to_scene) {}

    std::mutex mutex;
    const bool of_scene;
    std::weak_ptr<Scene> scene;  ///< null for a Scene that no shared_ptr owns

    // With the mutex locked:

    /// Whatever is in the scene changed. Gives the snapshot that was kept, to be let go of after
    /// the lock.
    std::shared_ptr<SceneSnapshot> changed() {
        ++changes;
        next_revision();  // whoever waits for any change sees one
        moved.clear();
        return std::exchange(snapshot, nullptr);
    }
    /// A node was placed elsewhere, and nothing else changed: the snapshot that is kept can be
    /// brought up to date.
    void node_moved(Node& node) {
        ++changes;
        next_revision();
        if (snapshot) moved.push_back(&node);
    }

    std::uint64_t changes = 0;  ///< so many so far
    /// The last one, while it can be used again; see Scene::snapshot.
    std::shared_ptr<SceneSnapshot> snapshot;
    std::vector<Node*> moved;       ///< since `snapshot` was true; a node may come several times
    std::uint64_t newest_seen = 0;  ///< newest_revision() when `snapshot` was found to be true
};

/// A thing in a scene: a mesh with a material somewhere, or a group that carries others.
///
/// Made by Scene::add. Every member function may be called from any thread.
class Node : public std::enable_shared_from_this<Node> {
public:
    /// A node in no scene.
    Node(std::int32_t id, NodeValue value);
    ~Node();
    Node(const Node&) = delete;
    Node& operator=(const Node&) = delete;

    /// From 1 in order of Scene::add; never used again in that scene.
    std::int32_t id() const { return id_; }

    NodeValue value() const;
    std::shared_ptr<Node> parent() const;
    std::vector<std::shared_ptr<Node>> children() const;  ///< in order of id
    glm::dmat4 world_matrix() const;
    std::shared_ptr<Scene> scene() const;  ///< null: in none

    /// `change` gets a NodeValue, which is checked afterwards. The old value stays if anything
    /// throws.
    template <class Change>
    void edit(Change&& change) {
        NodeValue old;  // what these two let go of is destroyed after the lock
        std::shared_ptr<SceneSnapshot> outdated;
        const Lock lock = this->lock();
        NodeValue next = value_;
        std::forward<Change>(change)(next);
        check(next.placing);
        complete(next);
        if (next.contents() != value_.contents()) {
            outdated = lock.graph->changed();
        } else if (next.placing != value_.placing) {
            lock.graph->node_moved(*this);
        } else {
            return;
        }
        old = std::exchange(value_, std::move(next));
    }

    /// As edit, of the place alone: `change` gets a Placing.
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

    /// Null: no parent. Nodes that are in no scene come together, children and all.
    /// @throws std::invalid_argument if that would make a cycle or join a scene with anything else.
    void set_parent(const std::shared_ptr<Node>& parent);

private:
    friend class Scene;
    friend class SnapshotBuilder;

    struct Lock {
        std::shared_ptr<NodeGraph> graph;
        std::unique_lock<std::mutex> lock;
    };

    /// Gives a mesh without a material the default one.
    static void complete(NodeValue& value);

    std::shared_ptr<NodeGraph> graph() const;
    Lock lock() const;

    // These are called with the graph locked.
    void set_graph(std::shared_ptr<NodeGraph> graph);
    void attach(const std::shared_ptr<Node>& parent);
    void detach();
    glm::dmat4 locked_world_matrix() const;
    /// This node and all below it.
    std::vector<std::shared_ptr<Node>> subtree();

    const std::int32_t id_;
    NodeValue value_;
    std::shared_ptr<Node> parent_;
    std::set<std::weak_ptr<Node>, std::owner_less<>> children_;  ///< some may be gone
    std::size_t children_swept_at_ = 16;  ///< so many, and those that are gone are taken out

    mutable std::mutex graph_guard_;    ///< for the pointer alone, held for no longer than a copy
    std::shared_ptr<NodeGraph> graph_;  ///< changed only with both the old and the new one locked
};

}  // namespace cubecam
