// What changes a scene as a whole: the time of its animations, and its variant.
#include "cubecam/core/checks.hpp"
#include "cubecam/core/parse_name.hpp"
#include "cubecam/scene/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

namespace cubecam {

namespace {

/// Replaces a scale of 0 in an animation: a node's matrix must stay invertible.
constexpr double least_scale = 1e-6;

double usable_scale(double scale) {
    return std::abs(scale) < least_scale ? std::copysign(least_scale, scale) : scale;
}

void set_part(Transform& transform, const Keys& keys, double seconds) {
    std::array<double, 4> value{};
    sample(keys, seconds, std::span(value).first(keys.width));
    if (keys.path == AnimationPath::rotation) {
        transform.rotation = {value[0], value[1], value[2], value[3]};
        return;
    }
    const glm::dvec3 vector(value[0], value[1], value[2]);
    if (keys.path == AnimationPath::translation) {
        transform.position = vector;
    } else {
        for (int i = 0; i < 3; ++i) transform.scale[i] = usable_scale(vector[i]);
    }
}

}  // namespace

void Scene::set_time(double seconds, const Animation& animation) {
    expect_finite(seconds, "seconds");
    // The nodes, which live as long as this list, in the order of their ids.
    std::map<std::int32_t, std::pair<std::shared_ptr<Node>, std::vector<const Keys*>>> targets;
    for (const auto& channel : animation.channels()) {
        auto node = channel->node();
        if (!node || !contains(*node)) continue;
        auto& [kept, keys] = targets[node->id()];
        kept = std::move(node);
        keys.push_back(&channel->keys());
    }
    const std::lock_guard lock(graph_->mutex);
    struct Change {
        Node* node;
        Placing placing;
        std::optional<std::vector<float>> weights;
    };
    std::vector<Change> changes;
    changes.reserve(targets.size());
    for (const auto& [id, target] : targets) {
        const auto& [node, channels] = target;
        if (node->graph() != graph_) continue;  // removed since
        changes.push_back({node.get(), node->value_.placing, std::nullopt});
        Change& change = changes.back();
        std::optional<Transform> transform;
        for (const Keys* keys : channels) {
            if (keys->path == AnimationPath::weights) {
                std::vector<double> row(keys->width);
                sample(*keys, seconds, row);
                change.weights.emplace(row.begin(), row.end());
                continue;
            }
            if (!transform) transform = transform_of(change.placing);
            set_part(*transform, *keys, seconds);
        }
        if (!transform) continue;
        change.placing = *transform;
        check(change.placing);
    }
    for (const Change& change : changes) {
        if (!change.weights) continue;
        NodeValue next = change.node->value_;
        next.weights = *change.weights;
        Node::check_skin(next, change.node->value_, *graph_);
    }
    for (Change& change : changes) {
        NodeValue& value = change.node->value_;
        const bool moved = change.placing != value.placing;
        const bool morphed = change.weights && *change.weights != value.weights;
        if (moved) value.placing = change.placing;
        if (morphed) value.weights = std::move(*change.weights);
        if (moved || morphed) graph_->node_moved(*change.node);
    }
}

std::vector<std::string> Scene::variants() const {
    const std::lock_guard lock(graph_->mutex);
    return variants_;
}

std::optional<std::string> Scene::variant() const {
    const std::lock_guard lock(graph_->mutex);
    return graph_->variant;
}

void Scene::set_variants(std::vector<std::string> names) {
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
            names.begin() + static_cast<std::ptrdiff_t>(i)) {
            expect(false, "variants of different names", "'" + names[i] + "' twice");
        }
    }
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (names == variants_) return;
    variants_ = std::move(names);
    next_revision();
    if (graph_->variant && std::ranges::find(variants_, *graph_->variant) == variants_.end()) {
        outdated = show_variant(std::nullopt);
    }
}

void Scene::set_variant(const std::optional<std::string>& name) {
    std::shared_ptr<SceneSnapshot> outdated;  // released after the lock
    const std::lock_guard lock(graph_->mutex);
    if (name == graph_->variant) return;
    if (name && std::ranges::find(variants_, *name) == variants_.end()) {
        throw std::invalid_argument("expected a variant of the scene, got '" + shortened(*name) +
                                    "'");
    }
    outdated = show_variant(name);
}

std::shared_ptr<SceneSnapshot> Scene::show_variant(std::optional<std::string> name) {
    graph_->variant = std::move(name);
    for (const auto& node : nodes_) {
        if (node) show_material(node->value_, graph_->variant);
    }
    return graph_->changed();
}

}  // namespace cubecam
