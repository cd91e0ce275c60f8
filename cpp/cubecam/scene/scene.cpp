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
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (environment == environment_) return;
    environment_.swap(environment);
    outdated = graph_->changed();
}

std::shared_ptr<ProbeGrid> Scene::probe_grid() const {
    const std::lock_guard lock(graph_->mutex);
    return probe_grid_;
}

void Scene::set_probe_grid(std::shared_ptr<ProbeGrid> grid) {
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (grid == probe_grid_) return;
    probe_grid_.swap(grid);
    outdated = graph_->changed();
}

EnvironmentPlacing Scene::environment_placing() const {
    const std::lock_guard lock(graph_->mutex);
    return environment_placing_;
}

void Scene::set_environment_rotation(const glm::dquat& rotation) {
    const glm::dquat unit = unit_rotation(rotation);
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (unit == environment_placing_.rotation) return;
    environment_placing_.rotation = unit;
    outdated = graph_->changed();
}

void Scene::set_environment_intensity(float intensity) {
    expect_not_negative(static_cast<double>(intensity), "environment_intensity");
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (intensity == environment_placing_.intensity) return;
    environment_placing_.intensity = intensity;
    outdated = graph_->changed();
}

Background Scene::background() const {
    const std::lock_guard lock(graph_->mutex);
    return background_;
}

void Scene::set_background(Background background) {
    background = checked_background(std::move(background));
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (background == background_) return;
    background_.swap(background);
    outdated = graph_->changed();
}

std::size_t Scene::place_of(std::int32_t id) const {
    const auto at = std::lower_bound(ids_.begin(), ids_.end(), id);
    return static_cast<std::size_t>(at - ids_.begin());
}

std::shared_ptr<Node> Scene::insert(std::size_t place, std::int32_t id, NodeValue value) {
    auto node = std::make_shared<Node>(id, std::move(value));
    node->set_graph(graph_);
    if (graph_->scene.expired()) graph_->scene = weak_from_this();
    if (place < ids_.size() && ids_[place] == id) {
        nodes_[place] = node;  // the place of a removed node with this id
        --removed_;
    } else {
        const auto offset = static_cast<std::ptrdiff_t>(place);
        nodes_.insert(nodes_.begin() + offset, node);
        ids_.insert(ids_.begin() + offset, id);
    }
    next_id_ = std::max(next_id_, id + 1);
    return node;
}

std::shared_ptr<Node> Scene::add(NodeValue value, const std::shared_ptr<Node>& parent) {
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (parent && parent->graph() != graph_) {
        throw std::invalid_argument("expected a parent in this scene, got node " +
                                    std::to_string(parent->id()) +
                                    ", which is in another scene or in none");
    }
    Node::check_skin(value, {}, *graph_);
    if (next_id_ > last_id) throw std::length_error("all 2,147,483,646 ids of the scene are used");
    outdated = graph_->changed();
    auto node = insert(nodes_.size(), next_id_, std::move(value));
    if (parent) node->attach(parent);
    return node;
}

void Scene::add(std::shared_ptr<Light> light) {
    if (!light) throw std::invalid_argument("expected a light, got none");
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (std::find(lights_.begin(), lights_.end(), light) != lights_.end()) {
        throw std::invalid_argument("expected a light that is not in the scene, got one that is");
    }
    outdated = graph_->changed();
    lights_.push_back(std::move(light));
}

void Scene::add(std::shared_ptr<Camera> camera) {
    if (!camera) throw std::invalid_argument("expected a camera, got none");
    const std::lock_guard lock(graph_->mutex);
    if (std::ranges::find(cameras_, camera) != cameras_.end()) {
        throw std::invalid_argument("expected a camera that is not in the scene, got one that is");
    }
    cameras_.push_back(std::move(camera));
    next_revision();
}

void Scene::add(std::shared_ptr<Animation> animation) {
    if (!animation) throw std::invalid_argument("expected an animation, got none");
    for (const auto& channel : animation->channels()) {
        const auto node = channel->node();
        if (!node || contains(*node)) continue;
        throw std::invalid_argument("expected an animation of nodes of this scene, got node " +
                                    std::to_string(node->id()) +
                                    ", which is in another scene or in none");
    }
    const std::lock_guard lock(graph_->mutex);
    if (std::ranges::find(animations_, animation) != animations_.end()) {
        throw std::invalid_argument(
            "expected an animation that is not in the scene, got one that is");
    }
    animations_.push_back(std::move(animation));
    next_revision();
}

void Scene::remove(const std::shared_ptr<Node>& node) {
    std::vector<std::shared_ptr<Node>> removed;  // these two are released after the lock
    std::shared_ptr<SceneSnapshot> outdated;
    const std::lock_guard lock(graph_->mutex);
    if (!node || node->graph() != graph_) {
        throw std::invalid_argument(
            "expected a node of this scene, got " +
            (node ? "node " + std::to_string(node->id()) + ", which is in another scene or in none"
                  : std::string("none")));
    }
    outdated = graph_->changed();
    removed = node->subtree();
    node->detach();
    const auto loose = std::make_shared<NodeGraph>(false);
    for (const auto& below : removed) {
        below->set_graph(loose);
        nodes_[place_of(below->id())].reset();
    }
    removed_ += removed.size();
    if (2 * removed_ < nodes_.size()) return;
    std::erase(nodes_, nullptr);
    ids_.clear();
    for (const auto& left : nodes_) ids_.push_back(left->id());
    removed_ = 0;
}

void Scene::remove(const std::shared_ptr<Light>& light) {
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    const auto found = std::find(lights_.begin(), lights_.end(), light);
    if (found == lights_.end()) {
        throw std::invalid_argument("expected a light of this scene, got one that is not in it");
    }
    outdated = graph_->changed();
    lights_.erase(found);
}

void Scene::remove(const std::shared_ptr<Camera>& camera) {
    const std::lock_guard lock(graph_->mutex);
    const auto found = std::ranges::find(cameras_, camera);
    if (found == cameras_.end()) {
        throw std::invalid_argument("expected a camera of this scene, got one that is not in it");
    }
    cameras_.erase(found);
    next_revision();
}

void Scene::remove(const std::shared_ptr<Animation>& animation) {
    const std::lock_guard lock(graph_->mutex);
    const auto found = std::ranges::find(animations_, animation);
    if (found == animations_.end()) {
        throw std::invalid_argument(
            "expected an animation of this scene, got one that is not in it");
    }
    animations_.erase(found);
    next_revision();
}

void Scene::clear() {
    std::vector<std::shared_ptr<Node>> nodes;  // these are released after the lock
    std::vector<std::shared_ptr<Light>> lights;
    std::vector<std::shared_ptr<Camera>> cameras;
    std::vector<std::shared_ptr<Animation>> animations;
    std::shared_ptr<SceneSnapshot> outdated;
    const std::lock_guard lock(graph_->mutex);
    outdated = graph_->changed();
    const auto loose = std::make_shared<NodeGraph>(false);
    for (const auto& node : nodes_) {
        if (node) node->set_graph(loose);
    }
    nodes.swap(nodes_);
    ids_.clear();
    removed_ = 0;
    lights.swap(lights_);
    cameras.swap(cameras_);
    animations.swap(animations_);
    variants_.clear();
    graph_->variant.reset();
}

void Scene::place(std::span<const std::shared_ptr<Node>> nodes,
                  const std::function<void(std::size_t, Placing&)>& change) {
    const std::lock_guard lock(graph_->mutex);
    std::vector<Placing> placings;
    placings.reserve(nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (nodes[i]->graph() != graph_) {
            throw std::invalid_argument("expected nodes of this scene, got node " +
                                        std::to_string(nodes[i]->id()) +
                                        ", which is in another scene or in none");
        }
        Placing& next = placings.emplace_back(nodes[i]->value_.placing);
        change(i, next);
        check(next);
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        if (placings[i] == nodes[i]->value_.placing) continue;
        nodes[i]->value_.placing = placings[i];
        graph_->node_moved(*nodes[i]);
    }
}

bool Scene::contains(const Node& node) const { return node.graph() == graph_; }

bool Scene::contains(const Light& light) const {
    const std::lock_guard lock(graph_->mutex);
    return std::any_of(lights_.begin(), lights_.end(),
                       [&](const auto& other) { return other.get() == &light; });
}

bool Scene::contains(const Camera& camera) const {
    const std::lock_guard lock(graph_->mutex);
    return std::ranges::any_of(cameras_, [&](const auto& other) { return other.get() == &camera; });
}

bool Scene::contains(const Animation& animation) const {
    const std::lock_guard lock(graph_->mutex);
    return std::ranges::any_of(animations_,
                               [&](const auto& other) { return other.get() == &animation; });
}

std::vector<std::shared_ptr<Node>> Scene::nodes() const {
    const std::lock_guard lock(graph_->mutex);
    std::vector<std::shared_ptr<Node>> nodes = nodes_;
    std::erase(nodes, nullptr);
    return nodes;
}

std::vector<std::shared_ptr<Node>>
Scene::find(const std::function<bool(std::int32_t, const NodeValue&)>& fits) const {
    const std::lock_guard lock(graph_->mutex);
    std::vector<std::shared_ptr<Node>> found;
    for (const auto& node : nodes_) {
        if (node && fits(node->id(), node->value_)) found.push_back(node);
    }
    return found;
}

std::vector<std::shared_ptr<Light>> Scene::lights() const {
    const std::lock_guard lock(graph_->mutex);
    return lights_;
}

std::vector<std::shared_ptr<Camera>> Scene::cameras() const {
    const std::lock_guard lock(graph_->mutex);
    return cameras_;
}

std::vector<std::shared_ptr<Animation>> Scene::animations() const {
    const std::lock_guard lock(graph_->mutex);
    return animations_;
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
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    const std::size_t place = place_of(id);
    if (place < nodes_.size() && ids_[place] == id && nodes_[place]) return nodes_[place];
    outdated = graph_->changed();
    return insert(place, id, {});
}

}  // namespace cubecam
