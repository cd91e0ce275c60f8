#include "cubecam/scene/scene.hpp"

#include "cubecam/core/checks.hpp"

#include <algorithm>
#include <limits>
#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

constexpr std::int32_t last_id = std::numeric_limits<std::int32_t>::max() - 1;

Background checked_background(Background background) {
    if (const auto* color = std::get_if<glm::vec4>(&background)) {
        expect_color(*color, "background");
    } else if (auto* cube = std::get_if<std::shared_ptr<CubeMap>>(&background); cube && !*cube) {
        return {};
    }
    return background;
}

}  // namespace

Scene::Scene(std::shared_ptr<CubeMap> environment, Background background)
    : graph_(std::make_shared<NodeGraph>(true)), environment_(std::move(environment)),
      background_(checked_background(std::move(background))) {}

std::shared_ptr<CubeMap> Scene::environment() const {
    const std::lock_guard lock(graph_->mutex);
    return environment_;
}

void Scene::set_environment(std::shared_ptr<CubeMap> environment) {
    const std::lock_guard lock(graph_->mutex);
    environment_.swap(environment);
}

Background Scene::background() const {
    const std::lock_guard lock(graph_->mutex);
    return background_;
}

void Scene::set_background(Background background) {
    background = checked_background(std::move(background));
    const std::lock_guard lock(graph_->mutex);
    background_.swap(background);
}

std::shared_ptr<Node> Scene::insert(std::vector<std::shared_ptr<Node>>::iterator at,
                                    std::int32_t id, NodeValue value) {
    auto node = std::make_shared<Node>(id, std::move(value));
    node->set_graph(graph_);
    if (graph_->scene.expired()) graph_->scene = weak_from_this();
    nodes_.insert(at, node);
    next_id_ = std::max(next_id_, id + 1);
    return node;
}

std::shared_ptr<Node> Scene::add(NodeValue value, const std::shared_ptr<Node>& parent) {
    const std::lock_guard lock(graph_->mutex);
    if (parent && parent->graph() != graph_) {
        throw std::invalid_argument("expected a parent in this scene, got node " +
                                    std::to_string(parent->id()) + " of another or of none");
    }
    if (next_id_ > last_id) throw std::length_error("all 2,147,483,646 ids of the scene are used");
    auto node = insert(nodes_.end(), next_id_, std::move(value));
    if (parent) node->attach(parent);
    return node;
}

void Scene::add(std::shared_ptr<Light> light) {
    if (!light) throw std::invalid_argument("expected a light, got none");
    const std::lock_guard lock(graph_->mutex);
    if (std::find(lights_.begin(), lights_.end(), light) != lights_.end()) {
        throw std::invalid_argument("expected a light that is not in the scene, got one that is");
    }
    lights_.push_back(std::move(light));
}

void Scene::remove(const std::shared_ptr<Node>& node) {
    std::vector<std::shared_ptr<Node>> removed;  // let go of after the lock
    const std::lock_guard lock(graph_->mutex);
    if (!node || node->graph() != graph_) {
        throw std::invalid_argument(
            "expected a node of this scene, got " +
            (node ? "node " + std::to_string(node->id()) + " of another or of none"
                  : std::string("none")));
    }
    removed = node->subtree();
    node->detach();
    const auto loose = std::make_shared<NodeGraph>(false);
    for (const auto& below : removed) below->set_graph(loose);
    if (removed.size() == 1) {
        nodes_.erase(
            std::lower_bound(nodes_.begin(), nodes_.end(), node->id(),
                             [](const auto& other, std::int32_t id) { return other->id() < id; }));
    } else {
        std::erase_if(nodes_, [&](const auto& other) { return other->graph() == loose; });
    }
}

void Scene::remove(const std::shared_ptr<Light>& light) {
    const std::lock_guard lock(graph_->mutex);
    const auto found = std::find(lights_.begin(), lights_.end(), light);
    if (found == lights_.end()) {
        throw std::invalid_argument("expected a light of this scene, got one that is not in it");
    }
    lights_.erase(found);
}

void Scene::clear() {
    std::vector<std::shared_ptr<Node>> nodes;  // let go of after the lock
    std::vector<std::shared_ptr<Light>> lights;
    const std::lock_guard lock(graph_->mutex);
    const auto loose = std::make_shared<NodeGraph>(false);
    for (const auto& node : nodes_) node->set_graph(loose);
    nodes.swap(nodes_);
    lights.swap(lights_);
}

bool Scene::contains(const Node& node) const { return node.graph() == graph_; }

bool Scene::contains(const Light& light) const {
    const std::lock_guard lock(graph_->mutex);
    return std::any_of(lights_.begin(), lights_.end(),
                       [&](const auto& other) { return other.get() == &light; });
}

std::vector<std::shared_ptr<Node>> Scene::nodes() const {
    const std::lock_guard lock(graph_->mutex);
    return nodes_;
}

std::vector<std::shared_ptr<Light>> Scene::lights() const {
    const std::lock_guard lock(graph_->mutex);
    return lights_;
}

std::int32_t Scene::next_id() const {
    const std::lock_guard lock(graph_->mutex);
    return next_id_;
}

void Scene::skip_ids(std::int32_t next) {
    const std::lock_guard lock(graph_->mutex);
    next_id_ = std::max(next_id_, next);
}

std::shared_ptr<Node> Scene::restore(std::int32_t id) {
    expect(id >= 1 && id <= last_id, "a node's id of at least 1", std::to_string(id));
    const std::lock_guard lock(graph_->mutex);
    const auto at = std::lower_bound(
        nodes_.begin(), nodes_.end(), id,
        [](const auto& other, std::int32_t wanted) { return other->id() < wanted; });
    if (at != nodes_.end() && (*at)->id() == id) return *at;
    return insert(at, id, {});
}

}  // namespace cubecam
