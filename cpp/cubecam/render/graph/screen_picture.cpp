#include "cubecam/render/graph/screen_picture.hpp"

#include "cubecam/core/revision.hpp"

namespace cubecam {

ScreenPicture::ScreenPicture(FrameContext& context, const PictureId& id)
    : ScenePicture(context, id, context.scene_picture(*id.viewer).scene_number()),
      viewer_(static_cast<FramePicture&>(context.scene_picture(*id.viewer))) {}

bool ScreenPicture::sees(const NodeSnapshot& node) const {
    return viewer_.sees(node) && !node.drawn_as_transparent();
}

/// Rays need depths that are precise, of one sample. A stencil masks the same pixels as in the
/// viewer.
TargetDescription ScreenPicture::describe() const {
    const TargetDescription viewer = viewer_.describe();
    Outputs ids;
    ids.add(output_row("id"));
    TargetDescription description = describe_target(
        context_.gpu.context,
        {.shape = viewer.shape,
         .width = viewer.width,
         .height = viewer.height,
         .format = viewer.format == Format::rgba32f ? Format::rgba32f : Format::rgba16f,
         .outputs = ids,
         .depth_format = has_stencil(viewer.depth_format) ? DepthFormat::depth32f_stencil8
                                                          : DepthFormat::depth_component32f});
    description.mipmaps = viewer_.reflects_by_level();
    return description;
}

std::vector<PictureId> ScreenPicture::dependencies() { return plan(viewer_.views(), describe()); }

void ScreenPicture::update() {
    Target::Screen& kept = viewer_.kept_screen();
    const auto forget = [&kept] { kept = {}; };
    if (!draw_kept(kept.target, forget)) return;
    try {
        context_.gpu.screen_depths.update(kept, context_.stats);
    } catch (...) {
        forget();
        throw;
    }
    kept.revision = context_.gpu.contents = next_revision();
}

std::string ScreenPicture::label(std::size_t /*place*/) const { return ""; }

}  // namespace cubecam
