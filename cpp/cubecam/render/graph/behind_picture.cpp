#include "cubecam/render/graph/behind_picture.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

namespace cubecam {

BehindPicture::BehindPicture(FrameContext& context, const PictureId& id)
    : ScenePicture(context, id, context.scene_picture(*id.viewer).scene_number()),
      viewer_(context.scene_picture(*id.viewer)) {}

bool BehindPicture::sees(const NodeSnapshot& node) const {
    return viewer_.sees(node) && !shows_behind(node);
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

std::vector<PictureId> BehindPicture::dependencies() { return plan(viewer_.views(), describe()); }

void BehindPicture::update() {
    const TargetDescription description = describe();
    Target::Behind& kept = viewer_.kept_behind();
    if (kept.target == nullptr || kept.target->description() != description) {
        kept = {};  // frees the old memory first
        kept.target = std::make_unique<Target>(context_.gpu.context, description);
    }
    try {
        if (draw_changed(*kept.target) == 0) return;
    } catch (...) {
        kept = {};
        throw;
    }
    context_.gpu.context.gl().GenerateTextureMipmap(kept.target->color().id());
    kept.revision = context_.gpu.contents = next_revision();
}

std::string BehindPicture::label(std::size_t /*place*/) const { return ""; }

}  // namespace cubecam
