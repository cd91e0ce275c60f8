// The bounds of scenes and nodes in the world.
#include "cubecam/geometry/mesh_bounds.hpp"
#include "cubecam/scene/scene.hpp"

#include <utility>

namespace cubecam {

namespace {

Bounds bounds_of(const std::vector<PlacedMesh>& meshes) {
    Bounds all = no_bounds();
    for (const auto& [mesh, world] : meshes) {
        all = united(all, bounds_in_world(*mesh->data(), world));
    }
    return all;
}

}  // namespace

void Node::find_meshes(std::vector<PlacedMesh>& to) const {
    // A loop and not a recursion: a long chain of parents would overflow the stack.
    std::vector<std::pair<std::shared_ptr<const Node>, glm::dmat4>> waiting;
    waiting.emplace_back(shared_from_this(), locked_world_matrix());
    while (!waiting.empty()) {
        const auto [node, world] = std::move(waiting.back());
        waiting.pop_back();
        if (node->value_.mesh) to.push_back({node->value_.mesh, world});
        for (const auto& child : node->children_) {
            auto below = child.lock();
            if (!below || !below->value_.visible) continue;
            const glm::dmat4 place = world * matrix_of(below->value_.placing);
            waiting.emplace_back(std::move(below), place);
        }
    }
}

Bounds Node::world_bounds() const {
    std::vector<PlacedMesh> meshes;
    {
        const Lock lock = this->lock();
        find_meshes(meshes);
    }
    return bounds_of(meshes);
}

Bounds Scene::bounds() const {
    std::vector<PlacedMesh> meshes;
    {
        const std::lock_guard lock(graph_->mutex);
        for (const auto& node : nodes_) {
            if (node && !node->parent_ && node->value_.visible) node->find_meshes(meshes);
        }
    }
    return bounds_of(meshes);
}

}  // namespace cubecam
