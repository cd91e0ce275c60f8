#pragma once

#include "cubecam/materials/texture_source.hpp"
#include "cubecam/scene/light.hpp"
#include "cubecam/scene/node.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace cubecam {

/// Nothing (the environment if there is one, else transparent black), a linear RGBA colour, or a
/// skybox.
using Background = std::variant<std::monostate, glm::vec4, std::shared_ptr<CubeMap>>;

class SharedReads;

/// Nodes, lights, and what surrounds them. Plain data: it knows nothing of who draws it.
///
/// Every member function may be called from any thread.
class Scene : public std::enable_shared_from_this<Scene> {
public:
    explicit Scene(std::shared_ptr<CubeMap> environment = nullptr, Background background = {});
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    std::shared_ptr<CubeMap> environment() const;
    void set_environment(std::shared_ptr<CubeMap> environment);
    Background background() const;
    /// @throws std::invalid_argument for a colour that is not finite, negative, or of an alpha
    /// beyond 0..1.
    void set_background(Background background);

    /// @throws std::invalid_argument for a singular transform or a parent of another scene.
    std::shared_ptr<Node> add(NodeValue value, const std::shared_ptr<Node>& parent = nullptr);
    /// The same light may be in several scenes, and only once in each.
    void add(std::shared_ptr<Light> light);

    /// Takes a node and all below it out; they keep their values and their places among themselves.
    /// @throws std::invalid_argument if it is not here.
    void remove(const std::shared_ptr<Node>& node);
    void remove(const std::shared_ptr<Light>& light);
    /// Removes all nodes and lights.
    void clear();

    /// Places many nodes at once: node i by `change(i, Placing&)`. All of them are moved, or none.
    /// @throws std::invalid_argument for a node that is not here, or as Node::edit_placing does.
    void place(std::span<const std::shared_ptr<Node>> nodes,
               const std::function<void(std::size_t, Placing&)>& change);

    bool contains(const Node& node) const;
    bool contains(const Light& light) const;
    std::vector<std::shared_ptr<Node>> nodes() const;  ///< in order of add, which is that of id
    std::vector<std::shared_ptr<Light>> lights() const;

    /// The id that the next node will get.
    std::int32_t next_id() const;
    /// For unpickling. Ids below `next` are not given out any more.
    void skip_ids(std::int32_t next);
    /// For unpickling: the node of this id, made as an empty group if there is none.
    std::shared_ptr<Node> restore(std::int32_t id);

    using Effects = std::vector<std::shared_ptr<ImageEffect>>;

    /// Everything a picture depends on, as it is now: also the scenes of render textures, one
    /// after the other, and the effects that are to be run over it.
    ///
    /// The last one is kept. While nothing in it has changed it is given again; where nodes were
    /// moved, and nothing else happened, those alone are read anew.
    std::shared_ptr<const SceneSnapshot> snapshot(const Effects& effects = {}) const;

private:
    std::shared_ptr<const SceneSnapshot> kept_snapshot() const;
    /// Gives the snapshot's nodes that were moved since then their new places.
    void follow_moves(SceneSnapshot& snapshot) const;
    /// `changes`, if it is not null, gets NodeGraph::changes of the moment.
    SceneSnapshot snapshot_alone(SharedReads& shared, std::uint64_t* changes = nullptr) const;
    std::shared_ptr<Node> insert(std::size_t place, std::int32_t id, NodeValue value);
    /// The index of the first id that is not below `id`.
    std::size_t place_of(std::int32_t id) const;

    const std::shared_ptr<NodeGraph> graph_;
    std::shared_ptr<CubeMap> environment_;
    Background background_;
    /// In order of id. One that was removed leaves a null until there are as many nulls as nodes:
    /// so removing one is a binary search.
    std::vector<std::shared_ptr<Node>> nodes_;
    std::vector<std::int32_t> ids_;  ///< of nodes_, of the removed ones too
    std::size_t removed_ = 0;        ///< nulls in nodes_
    std::vector<std::shared_ptr<Light>> lights_;
    std::int32_t next_id_ = 1;
};

}  // namespace cubecam
