#include "cubecam/scene/deformer.hpp"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <utility>

namespace cubecam {

namespace {

std::shared_ptr<const MeshData> shared(MeshData&& data) {
    return std::make_shared<const MeshData>(std::move(data));
}

/// The form of a mesh with weights. The weights are noted last, so that an exception leaves nothing
/// that counts as finished.
std::shared_ptr<const MeshData> morphed_form(Deformation& kept, std::vector<float> weights) {
    if (!kept.morphed || kept.weights != weights) {
        kept.weights.clear();
        kept.morphed = shared(kept.base->morphed(weights, kept.morphed.get()));
        if (kept.form.flat) kept.flat = shared(kept.morphed->flat_shaded(kept.flat.get()));
        if (kept.form.tangents >= 0) {
            const auto& plain = kept.form.flat ? kept.flat : kept.morphed;
            kept.tangents = shared(plain->with_tangents(kept.form.tangents, kept.tangents.get()));
        }
        kept.weights = std::move(weights);
    }
    if (kept.form.tangents >= 0) return kept.tangents;
    return kept.form.flat ? kept.flat : kept.morphed;
}

/// The weights of a mesh's targets; empty: all are 0.
std::vector<float> active_weights(const NodeValue& value, const MeshData& mesh) {
    std::vector<float> weights = value.weights;
    weights.resize(std::min(weights.size(), mesh.target_count()));
    const bool any =
        std::any_of(weights.begin(), weights.end(), [](float weight) { return weight != 0.0F; });
    if (!any) weights.clear();
    return weights;
}

}  // namespace

MeshForm form_for(const MeshData& mesh, const MaterialValue& material) {
    const MaterialTraits& traits = material.traits();
    const bool made =
        traits.uses_tangents && !mesh.tangents() && mesh.uvs(traits.tangent_uv_set) != nullptr;
    return {material.surface.flat_shading, made ? traits.tangent_uv_set : -1};
}

std::shared_ptr<const MeshData>
plain_form(const Mesh& mesh, const std::shared_ptr<const MeshData>& base, const MeshForm& form) {
    const auto plain = form.flat ? mesh.flat_shaded(base) : base;
    return form.tangents < 0 ? plain : mesh.with_tangents(plain, form.tangents, form.flat);
}

bool may_deform(const NodeValue& value, const MeshData& mesh) {
    return mesh.target_count() > 0 || (value.skin && mesh.influences());
}

const glm::dmat4& WorldMatrices::of(const Node& node) {
    const Node* at = &node;
    while (at != nullptr && !known_.contains(at)) {
        waiting_.push_back(at);
        at = at->parent_.get();
    }
    while (!waiting_.empty()) {
        const Node& next = *waiting_.back();
        waiting_.pop_back();
        const glm::dmat4 own = matrix_of(next.value_.placing);
        known_.emplace(&next, next.parent_ ? known_.at(next.parent_.get()) * own : own);
    }
    return known_.at(&node);
}

Deformer::Deformer(const NodeGraph& graph, std::function<glm::dmat4(const Node&)> world_of)
    : graph_(graph), world_of_(std::move(world_of)) {}

bool Deformer::fits(const Skin& skin, const MeshData& mesh) const {
    if (!mesh.influences() || mesh.influences()->needed_joints() > skin.joints().size()) {
        return false;
    }
    return std::all_of(skin.joints().begin(), skin.joints().end(), [this](const auto& weak) {
        const auto joint = weak.lock();
        return joint && joint->graph().get() == &graph_;
    });
}

std::vector<JointMatrix> Deformer::joint_matrices(const Skin& skin,
                                                  const glm::dvec3& origin) const {
    std::vector<JointMatrix> matrices;
    matrices.reserve(skin.joints().size());
    for (std::size_t i = 0; i < skin.joints().size(); ++i) {
        glm::dmat4 world = world_of_(*skin.joints()[i].lock());
        world[3] -= glm::dvec4(origin, 0.0);
        matrices.push_back(to_joint_matrix(world * skin.inverse_bind()[i]));
    }
    return matrices;
}

DeformedMesh Deformer::deform(const Node& node, const std::shared_ptr<const MeshData>& base,
                              const MaterialValue& material) {
    const NodeValue& value = node.value_;
    const MeshForm form = form_for(*base, material);
    std::vector<float> weights = active_weights(value, *base);
    const bool skinned = value.skin && fits(*value.skin, *base);
    const Look look{base.get(), skinned ? value.skin.get() : nullptr, weights, form.flat,
                    form.tangents};

    std::shared_ptr<Deformation>& kept = node.deformation_;
    if (const auto found = made_.find(look); found != made_.end()) {
        kept = found->second;
    } else {
        // What two nodes shared becomes two meshes as soon as the nodes differ: the GPU has one
        // state of each mesh in a picture.
        const bool taken = kept && std::any_of(made_.begin(), made_.end(), [&](const auto& other) {
                               return other.second == kept;
                           });
        if (!kept || taken || kept->base->identity() != base->identity() || kept->form != form) {
            kept = std::make_shared<Deformation>();
        }
        if (kept->base != base) kept->weights.clear();  // `morphed` is of another moment
        kept->base = base;
        kept->form = form;
        made_.emplace(look, kept);
    }

    const auto drawn =
        weights.empty() ? plain_form(*value.mesh, base, form) : morphed_form(*kept, weights);
    if (!skinned) return {drawn, world_of_(node)};

    // Numbers near the first joint are small, so that float32 is exact enough far from the world's
    // origin, too.
    const glm::dvec3 origin(world_of_(*value.skin->joints().front().lock())[3]);
    auto joints = joint_matrices(*value.skin, origin);
    if (!kept->skinned || kept->unskinned != drawn || kept->joints != joints) {
        kept->skinned = shared(drawn->skinned(joints, kept->skinned.get()));
        kept->unskinned = drawn;
        kept->joints = std::move(joints);
    }
    return {kept->skinned, glm::translate(glm::dmat4(1.0), origin)};
}

}  // namespace cubecam
