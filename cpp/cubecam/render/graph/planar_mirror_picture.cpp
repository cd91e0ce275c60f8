#include "cubecam/render/graph/planar_mirror_picture.hpp"

#include "cubecam/core/revision.hpp"

#include <algorithm>

namespace cubecam {

PlanarMirrorPicture::PlanarMirrorPicture(FrameContext& context, const PictureId& id)
    : ScenePicture(context, id, context.scene_picture(*id.viewer).scene_number()),
      viewer_(context.scene_picture(*id.viewer)),
      mirror_(context.mirrors(viewer_.scene_number()).all()[id.object]) {}

Target::Mirrors::Kept& PlanarMirrorPicture::kept() {
    auto& kept = viewer_.kept_mirrors().kept[mirror_.name];
    if (kept == nullptr) kept = std::make_unique<Target::Mirrors::Kept>();
    return *kept;
}

BoundTexture PlanarMirrorPicture::texture() {
    return {kept().target->color().id(), kept().revision};
}

bool PlanarMirrorPicture::sees(const NodeSnapshot& node) const {
    return node.in_captures && viewer_.sees_in_mirrors(node) &&
           context_.mirrors(number_).of(node) != id_.object;
}

bool PlanarMirrorPicture::sees_in_mirrors(const NodeSnapshot& node) const {
    return viewer_.sees_in_mirrors(node);
}

/// Light is not clipped as a picture in bytes would be, and the mirror shows what is nearest,
/// whatever the viewer shows.
TargetDescription PlanarMirrorPicture::describe() const {
    const TargetDescription viewer = viewer_.describe();
    const Format format = viewer.format == Format::rgba32f ? Format::rgba32f : Format::rgba16f;
    TargetDescription description =
        describe_target(context_.gpu.context, {.shape = viewer.shape,
                                               .width = viewer.width,
                                               .height = viewer.height,
                                               .samples = viewer.samples,
                                               .format = format,
                                               .depth_format = viewer.depth_format});
    description.mipmaps = mirror_.looked_up_by_level;
    return description;
}

/// A rough or bent reflection looks up pixels beside the mirror, too.
std::vector<Rect> PlanarMirrorPicture::windows() const {
    const std::vector<View>& views = viewer_.views();
    const bool seen_from_elsewhere = std::any_of(views.begin(), views.end(), [](const View& view) {
        return !view.parallel && view.eye != view.position;
    });
    if (mirror_.looked_up_by_level || seen_from_elsewhere) return {};
    return viewer_.mirror_bounds(id_.object);
}

std::vector<PictureId> PlanarMirrorPicture::dependencies() {
    std::vector<View> views;
    for (const View& view : viewer_.views()) views.push_back(mirrored(view, mirror_.plane));
    return plan(std::move(views), describe());
}

void PlanarMirrorPicture::update() {
    Target::Mirrors::Kept& mine = kept();
    if (!draw_kept(mine.target, [&mine] { mine.target = nullptr; })) return;
    mine.revision = context_.gpu.contents = next_revision();
}

std::string PlanarMirrorPicture::label(std::size_t /*place*/) const { return ""; }

}  // namespace cubecam
