#include "cubecam/scene/node.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/materials/phong.hpp"
#include "cubecam/math/transform.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {

namespace {

void check_transform(Transform& transform) {
    expect_finite(transform.position, "position");
    expect_finite(transform.scale, "scale");
    const glm::dvec3& scale = transform.scale;
    // The text of a message is composed only on failure: this check runs for every move.
    if (scale.x == 0.0 || scale.y == 0.0 || scale.z == 0.0) {
        expect(false, "a scale without 0, which would make the matrix singular", describe(scale));
    }

    transform.rotation = unit_rotation(transform.rotation);
}

void check_matrix(const glm::dmat4& matrix) {
    for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) expect_finite(matrix[column][row], "matrix");
    }
    const glm::dvec4 last(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3]);
    if (last != glm::dvec4(0.0, 0.0, 0.0, 1.0)) {
        expect(false, "a matrix with (0, 0, 0, 1) as its last row", describe(glm::vec4(last)));
    }
    expect(!is_singular(glm::dmat3(matrix)), "a matrix that can be inverted", "a singular one");
}

}  // namespace

glm::dquat unit_rotation(const glm::dquat& q) {
    const double length = std::sqrt(glm::dot(q, q));
    if (!(length > 0.0 && std::isfinite(length))) {
        expect(false, "a rotation (w, x, y, z) of 4 finite numbers, not all 0",
               "(" + describe(q.w) + ", " + describe(q.x) + ", " + describe(q.y) + ", " +
                   describe(q.z) + ")");
    }
    // A rotation that already has unit length keeps all its bits: naming a node must not turn it.
    return std::abs(length - 1.0) > 1e-14 ? q / length : q;
}

void check(Placing& placing) {
    if (auto* transform = std::get_if<Transform>(&placing)) {
        check_transform(*transform);
    } else {
        check_matrix(std::get<glm::dmat4>(placing));
    }
}

void set_position(Placing& placing, const glm::dvec3& position) {
    if (auto* matrix = std::get_if<glm::dmat4>(&placing)) {
        (*matrix)[3] = glm::dvec4(position, 1.0);
    } else {
        std::get<Transform>(placing).position = position;
    }
}

glm::dmat4 matrix_of(const Placing& placing) {
    if (const auto* given = std::get_if<glm::dmat4>(&placing)) return *given;
    const auto& transform = std::get<Transform>(placing);
    const glm::dmat3 rotation = glm::mat3_cast(transform.rotation);
    glm::dmat4 matrix(1.0);
    for (int i = 0; i < 3; ++i) matrix[i] = glm::dvec4(rotation[i] * transform.scale[i], 0.0);
    matrix[3] = glm::dvec4(transform.position, 1.0);
    return matrix;
}

Transform transform_of(const Placing& placing) {
    if (const auto* transform = std::get_if<Transform>(&placing)) return *transform;
    const auto& matrix = std::get<glm::dmat4>(placing);
    glm::dmat3 axes(matrix);
    glm::dvec3 scale;
    for (int i = 0; i < 3; ++i) {
        scale[i] = glm::length(axes[i]);
        axes[i] /= scale[i];
    }
    // The tolerance also suits matrices that were computed in float32.
    const double shear =
        std::max({std::abs(glm::dot(axes[0], axes[1])), std::abs(glm::dot(axes[1], axes[2])),
                  std::abs(glm::dot(axes[2], axes[0]))});
    expect(shear < 1e-5, "a matrix without shear, for its rotation and scale",
           "axes that are not at right angles; use the matrix itself");
    if (glm::determinant(axes) < 0.0) {
        scale.x = -scale.x;
        axes[0] = -axes[0];
    }
    return {glm::dvec3(matrix[3]), glm::normalize(glm::quat_cast(axes)), scale};
}

void show_material(NodeValue& value, const std::optional<std::string>& variant) {
    if (value.variants.empty() && !value.own_material) return;
    const auto own = value.own_material.value_or(value.material);
    const auto shown = std::ranges::find_if(
        value.variants, [&](const auto& named) { return variant && named.first == *variant; });
    if (shown == value.variants.end()) {
        value.material = own;
        value.own_material.reset();
    } else {
        value.material = shown->second;
        value.own_material = own;
    }
}

Node::Node(std::int32_t id, NodeValue value)
    : id_(id), value_(std::move(value)), graph_(std::make_shared<NodeGraph>(false)) {
    check(value_.placing);
    complete(value_, {});
}

Node::~Node() {
    // In a chain of parents each destructor would call the next one, and a long chain would
    // overflow the stack. Therefore the first destructor frees the whole chain in a loop.
    static thread_local std::vector<std::shared_ptr<Node>>* pending = nullptr;
    if (!parent_) return;
    if (pending) {
        pending->push_back(std::move(parent_));
        return;
    }
    std::vector<std::shared_ptr<Node>> chain;
    pending = &chain;
    chain.push_back(std::move(parent_));
    while (!chain.empty()) {
        const std::shared_ptr<Node> last = std::move(chain.back());
        chain.pop_back();
    }
    pending = nullptr;
}

void Node::complete(NodeValue& value, const NodeValue& before) {
    if (value.mesh && !value.material) value.material = std::make_shared<PhongMaterial>();
    if (value.mesh != before.mesh && value.weights == before.weights &&
        (!value.mesh || value.mesh->data()->target_count() != value.weights.size())) {
        value.weights.clear();
    }
}

void Node::check_skin(const NodeValue& value, const NodeValue& before, const NodeGraph& graph) {
    if (value.weights != before.weights) {
        const std::size_t targets = value.mesh ? value.mesh->data()->target_count() : 0;
        expect(value.weights.empty() || value.weights.size() == targets,
               "as many weights as the mesh has morph targets, " + std::to_string(targets),
               std::to_string(value.weights.size()));
        for (const float weight : value.weights) {
            expect_finite(static_cast<double>(weight), "weights");
        }
    }
    if (!value.skin || (value.skin == before.skin && value.mesh == before.mesh)) return;
    if (value.mesh) {
        const auto data = value.mesh->data();
        expect(data->influences() != nullptr, "a mesh with joints and joint_weights for a skin",
               "a mesh without");
        const std::size_t needed = data->influences()->needed_joints();
        expect(needed <= value.skin->joints().size(),
               "a skin of at least " + std::to_string(needed) + " joints, which the mesh names",
               std::to_string(value.skin->joints().size()));
    }
    if (!graph.of_scene) return;  // it may still become part of the joints' tree
    for (const auto& weak : value.skin->joints()) {
        const auto joint = weak.lock();
        if (!joint || joint->graph().get() == &graph) continue;
        expect(false, "a skin whose joints are in the node's scene",
               "node " + std::to_string(joint->id()) + ", which is in another scene or in none");
    }
}

std::shared_ptr<NodeGraph> Node::graph() const {
    const std::lock_guard guard(graph_guard_);
    return graph_;
}

void Node::set_graph(std::shared_ptr<NodeGraph> graph) {
    deformation_.reset();  // nodes of the old graph may share it
    const std::lock_guard guard(graph_guard_);
    graph_.swap(graph);
}

Node::Lock Node::lock() const {
    while (true) {
        Lock locked{graph(), {}};
        locked.lock = std::unique_lock(locked.graph->mutex);
        if (locked.graph == graph()) return locked;
    }
}

NodeValue Node::value() const {
    const Lock lock = this->lock();
    return value_;
}

void Node::set_variants(std::vector<std::pair<std::string, std::shared_ptr<Material>>> variants) {
    NodeValue old;  // these two are destroyed after the lock is released
    std::shared_ptr<SceneSnapshot> outdated;
    const Lock lock = this->lock();
    NodeValue next = value_;
    next.variants = std::move(variants);
    show_material(next, lock.graph->variant);
    if (next.contents() == value_.contents()) return;
    outdated = lock.graph->changed();
    old = std::exchange(value_, std::move(next));
}

std::shared_ptr<Node> Node::parent() const {
    const Lock lock = this->lock();
    return parent_;
}

std::vector<std::shared_ptr<Node>> Node::children() const {
    std::vector<std::shared_ptr<Node>> alive;
    {
        const Lock lock = this->lock();
        for (const auto& child : children_) {
            if (auto node = child.lock()) alive.push_back(std::move(node));
        }
    }
    std::sort(alive.begin(), alive.end(),
              [](const auto& a, const auto& b) { return a->id() < b->id(); });
    return alive;
}

glm::dmat4 Node::world_matrix() const {
    const Lock lock = this->lock();
    return locked_world_matrix();
}

glm::dmat4 Node::locked_world_matrix() const {
    if (!parent_) return matrix_of(value_.placing);
    std::vector<const Node*> chain;
    for (const Node* node = this; node; node = node->parent_.get()) chain.push_back(node);
    // From the root down, as in the snapshot, so that the bits are the same.
    glm::dmat4 world = matrix_of(chain.back()->value_.placing);
    for (auto node = chain.rbegin() + 1; node != chain.rend(); ++node) {
        world = world * matrix_of((*node)->value_.placing);
    }
    return world;
}

std::shared_ptr<Scene> Node::scene() const {
    const Lock lock = this->lock();
    return lock.graph->scene.lock();
}

void Node::attach(const std::shared_ptr<Node>& parent) {
    auto& siblings = parent->children_;
    if (siblings.size() >= parent->children_swept_at_) {
        std::erase_if(siblings, [](const auto& child) { return child.expired(); });
        parent->children_swept_at_ = std::max<std::size_t>(16, 2 * siblings.size());
    }
    siblings.insert(weak_from_this());
    parent_ = parent;
}

void Node::detach() {
    if (!parent_) return;
    parent_->children_.erase(weak_from_this());
    parent_.reset();
}

std::vector<std::shared_ptr<Node>> Node::subtree() {
    std::vector<std::shared_ptr<Node>> all{shared_from_this()};
    for (std::size_t i = 0; i < all.size(); ++i) {
        for (const auto& child : all[i]->children_) {
            if (auto node = child.lock()) all.push_back(std::move(node));
        }
    }
    return all;
}

void Node::set_parent(const std::shared_ptr<Node>& parent) {
    std::shared_ptr<Node> old;  // these are released after the locks
    std::shared_ptr<SceneSnapshot> outdated[2];
    while (true) {
        const auto mine = graph();
        const auto theirs = parent ? parent->graph() : mine;
        std::unique_lock first(mine->mutex, std::defer_lock);
        std::unique_lock second(theirs->mutex, std::defer_lock);
        if (mine == theirs) {
            first.lock();
        } else {
            std::lock(first, second);
        }
        if (mine != graph() || (parent && theirs != parent->graph())) continue;

        if (mine != theirs && (mine->of_scene || theirs->of_scene)) {
            throw std::invalid_argument("expected a parent in the same scene, got node " +
                                        std::to_string(parent->id_) +
                                        ", which is in another scene or in none");
        }
        for (const Node* above = parent.get(); above; above = above->parent_.get()) {
            if (above != this) continue;
            throw std::invalid_argument(
                "expected a parent that is not below the node itself, got node " +
                std::to_string(parent->id_) + " for node " + std::to_string(id_) + ": a cycle");
        }
        old = parent_;
        outdated[0] = mine->changed();
        outdated[1] = theirs->changed();
        detach();
        if (parent) attach(parent);
        if (mine != theirs) {
            for (const auto& node : subtree()) node->set_graph(theirs);
        }
        return;
    }
}

}  // namespace cubecam
