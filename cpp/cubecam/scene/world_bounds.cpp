// The bounds of scenes and nodes in the world.
#include "cubecam/geometry/mesh_bounds.hpp"
#include "cubecam/scene/deformer.hpp"
#include "cubecam/scene/scene.hpp"

#include <utility>

namespace cubecam {

namespace {

Bounds bounds_of(const std::vector<PlacedMesh>& meshes) {
    Bounds all = no_bounds();
    for (const auto& [mesh, deformed, world] : meshes) {
        all = united(all, bounds_in_world(deformed ? *deformed : *mesh->data(), world));
    }
    return all;
}

}  // namespace

void Node::find_meshes(Deformer& deformer, std::vector<PlacedMesh>& to) const {
    // A loop and not a recursion: a long chain of parents would overflow the stack.
    std::vector<std::pair<std::shared_ptr<const Node>, glm::dmat4>> waiting;
    waiting.emplace_back(shared_from_this(), locked_world_matrix());
    while (!waiting.empty()) {
        const auto [node, world] = std::move(waiting.back());
        waiting.pop_back();
        if (const auto& mesh = node->value_.mesh) {
            const auto data = mesh->data();
            if (may_deform(node->value_, *data)) {
                const auto made = deformer.deform(*node, data, node->value_.material->value());
                to.push_back({mesh, made.mesh, made.world});
            } else {
                to.push_back({mesh, nullptr, world});
            }
        }
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
        WorldMatrices worlds;
        Deformer deformer(*lock.graph, [&worlds](const Node& node) { return worlds.of(node); });
        find_meshes(deformer, meshes);
    }
    return bounds_of(meshes);
}

Bounds Scene::bounds() const {
    std::vector<PlacedMesh> meshes;
    {
        const std::lock_guard lock(graph_->mutex);
        WorldMatrices worlds;
        Deformer deformer(*graph_, [&worlds](const Node& node) { return worlds.of(node); });
        for (const auto& node : nodes_) {
            if (node && !node->parent_ && node->value_.visible) node->find_meshes(deformer, meshes);
        }
    }
    return bounds_of(meshes);
}

}  // namespace cubecam
