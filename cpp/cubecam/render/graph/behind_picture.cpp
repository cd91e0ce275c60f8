#include "cubecam/render/graph/behind_picture.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <limits>

namespace cubecam {

namespace {

/// From and to which distance from the eye a node reaches at most.
struct Reach {
    double nearest;
    double furthest;
};

Reach reach(const View& view, const NodeSnapshot& node) {
    const glm::dvec3 center = node.world_bounds.center() - view.position;
    const glm::dvec3 half = (node.world_bounds.high - node.world_bounds.low) * 0.5;
    if (view.parallel) {
        const double depth = glm::dot(center, view.forward);
        const double spread = glm::dot(half, glm::abs(view.forward));
        return {depth - spread, depth + spread};
    }
    return {glm::length(glm::max(glm::abs(center) - half, 0.0)),
            glm::length(glm::abs(center) + half)};
}

}  // namespace

BehindPicture::BehindPicture(FrameContext& context, const PictureId& id)
    : ScenePicture(context, id, context.scene_picture(*id.viewer).scene_number()),
      viewer_(context.scene_picture(*id.viewer)) {}

bool BehindPicture::sees(const NodeSnapshot& node) const {
    return viewer_.sees(node) && !shows_behind(node) && !is_in_front(node);
}

bool BehindPicture::is_in_front(const NodeSnapshot& node) const {
    if (nearest_.empty() || node.unbounded || !node.drawn_as_transparent()) return false;
    const std::vector<View>& views = viewer_.views();
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (reach(views[v], node).furthest >= nearest_[v]) return false;
    }
    return true;
}

TargetDescription BehindPicture::describe() const {
    const TargetDescription viewer = viewer_.describe();
    TargetDescription description =
        describe_target(context_.gpu.context, {.shape = viewer.shape,
                                               .width = viewer.width,
                                               .height = viewer.height,
                                               .samples = viewer.samples,
                                               .format = Format::rgba16f,
                                               .depth_format = viewer.depth_format,
                                               .depth_order = viewer.depth_order});
    description.mipmaps = true;
    return description;
}

std::vector<PictureId> BehindPicture::dependencies() {
    nearest_.assign(viewer_.views().size(), std::numeric_limits<double>::infinity());
    for (const NodeSnapshot& node : scene_.nodes) {
        if (!shows_behind(node) || !viewer_.sees(node)) continue;
        for (std::size_t v = 0; v < nearest_.size(); ++v) {
            nearest_[v] = std::min(nearest_[v],
                                   node.unbounded ? 0.0 : reach(viewer_.views()[v], node).nearest);
        }
    }
    return plan(viewer_.views(), describe());
}

void BehindPicture::update() {
    Target::Behind& kept = viewer_.kept_behind();
    if (!draw_kept(kept.target, [&kept] { kept = {}; })) return;
    kept.revision = context_.gpu.contents = next_revision();
}

std::string BehindPicture::label(std::size_t /*place*/) const { return ""; }

}  // namespace cubecam
