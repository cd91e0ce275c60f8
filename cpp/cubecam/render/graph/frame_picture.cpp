#include "cubecam/render/graph/frame_picture.hpp"

#include "cubecam/render/graph/picture_kind.hpp"

#include <utility>

namespace cubecam {

FramePicture::FramePicture(FrameContext& context, std::vector<View> views, Target& target,
                           std::function<bool(const NodeSnapshot&)> wanted,
                           PostProcess post_process, bool screen_reflections)
    : ScenePicture(context, frame_id(), 0), given_views_(std::move(views)), target_(target),
      wanted_(std::move(wanted)), post_process_(std::move(post_process)),
      screen_reflections_(screen_reflections) {}

ScreenTextures FramePicture::screen() {
    if (!screen_reflections_ || !reflects()) return {};
    const Target::Screen& kept = target_.screen;
    return {{kept.target->color().id(), kept.revision}, kept.depths.id()};
}

std::vector<PictureId> FramePicture::possible_dependencies() {
    Dependencies shown = possible();
    if (screen_reflections_) shown.push_back(screen_id(id_));
    add_dependencies(post_process_.effects, shown);
    return shown;
}

std::vector<PictureId> FramePicture::dependencies() {
    Dependencies shown = plan(std::move(given_views_), target_.description());
    if (screen_reflections_ && reflects()) shown.push_back(screen_id(id_));
    add_dependencies(post_process_.effects, shown);
    return shown;
}

void FramePicture::update() { draw_changed(target_, post_process_); }

std::string FramePicture::label(std::size_t /*place*/) const { return "the frame"; }

}  // namespace cubecam
