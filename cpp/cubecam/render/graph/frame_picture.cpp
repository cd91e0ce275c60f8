#include "cubecam/render/graph/frame_picture.hpp"

#include "cubecam/render/graph/picture_kind.hpp"

#include <utility>

namespace cubecam {

FramePicture::FramePicture(FrameContext& context, std::vector<View> views, Target& target,
                           std::function<bool(const NodeSnapshot&)> wanted,
                           PostProcess post_process)
    : ScenePicture(context, frame_id(), 0), given_views_(std::move(views)), target_(target),
      wanted_(std::move(wanted)), post_process_(std::move(post_process)) {}

std::vector<PictureId> FramePicture::possible_dependencies() {
    Dependencies shown = possible();
    add_dependencies(post_process_.effects, shown);
    return shown;
}

std::vector<PictureId> FramePicture::dependencies() {
    Dependencies shown = plan(std::move(given_views_), target_.description());
    add_dependencies(post_process_.effects, shown);
    return shown;
}

void FramePicture::update() { draw_changed(target_, post_process_); }

std::string FramePicture::label(std::size_t /*place*/) const { return "the frame"; }

}  // namespace cubecam
