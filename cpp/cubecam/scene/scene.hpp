#pragma once

#include "cubecam/materials/texture_source.hpp"
#include "cubecam/scene/animation.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/environment_placing.hpp"
#include "cubecam/scene/light.hpp"
#include "cubecam/scene/node.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace cubecam {

/// None (the environment if there is one, otherwise transparent black), a linear RGBA colour, or a
/// skybox.
using Background = std::variant<std::monostate, glm::vec4, std::shared_ptr<CubeMap>>;

class SharedReads;

/// Nodes, lights, and their surroundings. A scene is plain data that does not depend on a renderer.
///
/// Every member function may be called from any thread.
class Scene : public std::enable_shared_from_this<Scene> {
public:
    explicit Scene(std::shared_ptr<CubeMap> environment = nullptr, Background background = {});
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    std::shared_ptr<CubeMap> environment() const;
    void set_environment(std::shared_ptr<CubeMap> environment);
    /// How mirrors and the background show the environment. The rotation has unit length.
    EnvironmentPlacing environment_placing() const;
    /// Normalises the rotation. @throws std::invalid_argument for one that is not finite or has
    /// length 0.
    void set_environment_rotation(const glm::dquat& rotation);
    /// @throws std::invalid_argument for a factor that is negative or not finite.
    void set_environment_intensity(float intensity);
    /// The grid whose light falls on surfaces from all around; null: the environment's does.
    std::shared_ptr<ProbeGrid> probe_grid() const;
    void set_probe_grid(std::shared_ptr<ProbeGrid> grid);
    Background background() const;
    /// @throws std::invalid_argument for a colour that is not finite or has an alpha outside 0..1.
    void set_background(Background background);

    /// @throws std::invalid_argument for a singular transform or a parent of another scene.
    std::shared_ptr<Node> add(NodeValue value, const std::shared_ptr<Node>& parent = nullptr);
    /// A light may be in several scenes, but only once in each.
    void add(std::shared_ptr<Light> light);
    /// A camera may be in several scenes. No picture depends on the cameras of a scene.
    void add(std::shared_ptr<Camera> camera);
    /// @throws std::invalid_argument also for a channel of a node that is not in this scene.
    void add(std::shared_ptr<Animation> animation);

    /// Removes a node and all nodes below it; they keep their values and their tree.
    /// @throws std::invalid_argument if the object is not in this scene.
    void remove(const std::shared_ptr<Node>& node);
    void remove(const std::shared_ptr<Light>& light);
    void remove(const std::shared_ptr<Camera>& camera);
    void remove(const std::shared_ptr<Animation>& animation);
    /// Removes all nodes, lights, cameras, animations and variants.
    void clear();

    /// Places many nodes at once, node i by `change(i, Placing&)`. Either all nodes are moved or
    /// none.
    /// @throws std::invalid_argument for a node that is not in this scene, and the exceptions of
    /// Node::edit_placing.
    void place(std::span<const std::shared_ptr<Node>> nodes,
               const std::function<void(std::size_t, Placing&)>& change);

    bool contains(const Node& node) const;
    bool contains(const Light& light) const;
    bool contains(const Camera& camera) const;
    bool contains(const Animation& animation) const;
    std::vector<std::shared_ptr<Node>> nodes() const;  ///< in the order of add and of ids
    std::vector<std::shared_ptr<Light>> lights() const;
    std::vector<std::shared_ptr<Camera>> cameras() const;  ///< in the order of add
    std::vector<std::shared_ptr<Animation>> animations() const;

    /// Gives the nodes of this scene that an animation moves their places and weights at a time, as
    /// `place` does. Either all nodes are changed or none. Channels whose node is gone, or not in
    /// this scene, are skipped. A scale nearer to 0 than 1e-6 becomes 1e-6.
    /// @throws std::invalid_argument for seconds that are not finite, a node whose matrix has a
    /// shear, or another number of weights than its mesh has morph targets.
    void set_time(double seconds, const Animation& animation);

    /// The names of the sets of materials that the scene can show.
    std::vector<std::string> variants() const;
    std::optional<std::string> variant() const;  ///< none: each node shows its own material
    /// If the present variant is not among the names, none is shown any more.
    /// @throws std::invalid_argument for a name that occurs twice.
    void set_variants(std::vector<std::string> names);
    /// @throws std::invalid_argument for a name that is none of `variants`.
    void set_variant(const std::optional<std::string>& name);

    /// The nodes that `fits` accepts, in the order of ids. `fits` gets each node's id and value.
    std::vector<std::shared_ptr<Node>>
    find(const std::function<bool(std::int32_t, const NodeValue&)>& fits) const;
    /// The exact bounds, in the world, of the vertices of all visible nodes; see no_bounds().
    Bounds bounds() const;

    /// The id that the next node will get.
    std::int32_t next_id() const;
    /// For unpickling: no new node gets an id below `next`.
    void skip_ids(std::int32_t next);
    /// For unpickling: returns the node with this id; if there is none, makes it as an empty group.
    std::shared_ptr<Node> restore(std::int32_t id);

    using Effects = std::vector<std::shared_ptr<ImageEffect>>;
    using AroundWork = std::function<void(const std::function<void()>& work)>;

    /// Returns the current state of everything on which a picture depends, including the scenes of
    /// render textures, which are read one after the other, and the effects of the frame.
    ///
    /// The last snapshot is kept and returned again while nothing in it has changed. If nodes were
    /// moved and nothing else changed, only these nodes are read again.
    ///
    /// Tangents and flat faces of large meshes may take seconds. They are made first, with polls
    /// (core/interrupts.hpp) and without locks of the core; a host that holds a lock of its own
    /// releases it in `around`, which must call its argument.
    std::shared_ptr<const SceneSnapshot> snapshot(const Effects& effects = {},
                                                  const AroundWork& around = {}) const;

private:
    std::shared_ptr<const SceneSnapshot> kept_snapshot() const;
    /// Reads everything. Returns null if `shared` has left out forms of large meshes.
    std::shared_ptr<const SceneSnapshot> read_snapshot(const Effects& effects,
                                                       SharedReads& shared) const;
    /// Updates the nodes that were moved, or got other weights, since the snapshot was valid.
    /// Returns false if the snapshot must be made anew, since a mesh became translucent or opaque.
    bool follow_moves(SceneSnapshot& snapshot) const;
    /// Deforms meshes again after joints moved or weights changed; returns as follow_moves.
    bool follow_deformations(SceneSnapshot& snapshot) const;
    /// `changes`, if not null, gets the NodeGraph::changes of the snapshot's moment.
    SceneSnapshot snapshot_alone(SharedReads& shared, std::uint64_t* changes = nullptr) const;
    std::shared_ptr<Node> insert(std::size_t place, std::int32_t id, NodeValue value);
    /// The index of the first id that is not below `id`.
    std::size_t place_of(std::int32_t id) const;
    /// Returns the kept snapshot, which the caller releases after the lock.
    std::shared_ptr<SceneSnapshot> show_variant(std::optional<std::string> name);

    const std::shared_ptr<NodeGraph> graph_;
    std::shared_ptr<CubeMap> environment_;
    EnvironmentPlacing environment_placing_;
    std::shared_ptr<ProbeGrid> probe_grid_;
    Background background_;
    /// In the order of ids. A removed node leaves a null until there are as many nulls as nodes, so
    /// that removing one costs only a binary search.
    std::vector<std::shared_ptr<Node>> nodes_;
    std::vector<std::int32_t> ids_;  ///< of nodes_, including the removed ones
    std::size_t removed_ = 0;        ///< nulls in nodes_
    std::vector<std::shared_ptr<Light>> lights_;
    std::vector<std::shared_ptr<Camera>> cameras_;
    std::vector<std::shared_ptr<Animation>> animations_;
    std::vector<std::string> variants_;
    std::int32_t next_id_ = 1;
};

}  // namespace cubecam
