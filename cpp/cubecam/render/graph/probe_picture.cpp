#include "cubecam/render/graph/probe_picture.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/scene/scene_encoding.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>

namespace cubecam {

ProbePicture::ProbePicture(FrameContext& context, const PictureId& id)
    : ScenePicture(context, id, id.scene), probe_(scene_.probes[id.object]),
      state_(context.probe_state(id.scene, id.object)) {}

BoundTexture ProbePicture::texture() const {
    return state_.target == nullptr ? BoundTexture{}
                                    : BoundTexture{state_.target->color().id(), state_.revision};
}

Environment ProbePicture::environment() const {
    if (state_.target == nullptr) return {};
    const TargetDescription& description = state_.target->description();
    Environment made;
    made.cube = texture();
    if (description.mipmaps) {
        made.levels = EnvironmentLevels::mipmaps;
        made.level_count = gl::mip_levels(description.width, description.height);
    }
    made.position = state_.position;
    return made;
}

bool ProbePicture::sees(const NodeSnapshot& node) const {
    return is_seen(scene_, node, id_.object);
}

bool ProbePicture::count_and_decide() {
    const bool drawn = state_.target != nullptr;
    if (forced_) return true;
    switch (probe_.value.update) {
        case ProbeUpdate::on_change: return true;
        case ProbeUpdate::once: return !drawn;
        case ProbeUpdate::manual: return false;
        case ProbeUpdate::every_n_frames: return state_.calls++ % probe_.value.every == 0 || !drawn;
    }
    return true;
}

std::vector<PictureId> ProbePicture::possible_dependencies() {
    return context_.contents(number_).shown([this](const NodeSnapshot& n) { return sees(n); });
}

std::vector<PictureId> ProbePicture::dependencies() {
    due_ = count_and_decide();
    if (!due_) return {};  // it keeps its contents and depends on nothing
    return plan(cube_views(probe_.position, probe_.value.near, probe_.value.far), probe_.value.size,
                probe_.value.size, probe_.value.depth_format,
                [this](const NodeSnapshot& node) { return sees(node); });
}

TargetDescription ProbePicture::describe() const {
    const ProbeValue& value = probe_.value;
    TargetDescription description =
        describe_target(context_.gpu.context, {.shape = TargetShape::cube(),
                                               .width = value.size,
                                               .height = value.size,
                                               .samples = value.samples,
                                               .format = value.format,
                                               .depth_format = value.depth_format});
    description.mipmaps = value.mipmaps;
    return description;
}

void ProbePicture::update() {
    if (!due_) return;
    const TargetDescription description = describe();
    std::optional<Budget> budget;
    if (state_.target == nullptr || state_.target->description() != description) {
        state_.target = nullptr;  // frees the old memory first
        state_.target = std::make_unique<Target>(context_.gpu.context, description);
    } else if (!forced_ && probe_.value.faces_per_frame < 6) {
        // The first time all six faces are drawn: an undrawn face would have undefined contents.
        budget = Budget{static_cast<std::size_t>(probe_.value.faces_per_frame), state_.next_face};
    }
    std::size_t drawn = 0;
    try {
        drawn = draw_changed(*state_.target, {}, budget);
    } catch (...) {
        state_.target = nullptr;
        context_.gpu.contents = next_revision();
        throw;
    }
    // A face that is left for a later call was drawn from elsewhere.
    if (state_.position != probe_.position) context_.gpu.contents = next_revision();
    state_.position = probe_.position;
    state_.encoding =
        scene_encoding(context_.scenes, number_, [this](const NodeSnapshot& n) { return sees(n); });
    if (drawn == 0) return;
    if (budget) state_.next_face = (budget->first + drawn) % 6;
    if (description.mipmaps) {
        context_.gpu.context.gl().GenerateTextureMipmap(state_.target->color().id());
    }
    state_.revision = context_.gpu.contents = next_revision();
    ++context_.stats.probes_updated;
}

std::string ProbePicture::label(std::size_t /*place*/) const {
    const auto user =
        std::find_if(scene_.nodes.begin(), scene_.nodes.end(),
                     [this](const NodeSnapshot& node) { return uses_probe(node, id_.object); });
    return "the probe of node " + std::to_string(user == scene_.nodes.end() ? 0 : user->id);
}

}  // namespace cubecam
