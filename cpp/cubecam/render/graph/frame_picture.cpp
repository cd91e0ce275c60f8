#include "cubecam/render/graph/frame_picture.hpp"

#include "cubecam/render/graph/picture_kind.hpp"

#include <utility>

namespace cubecam {

FramePicture::FramePicture(FrameContext& context, std::vector<View> views, Target& target,
                           Wanted wanted, PostProcess post_process)
    : ScenePicture(context, frame_id(), 0), views_(std::move(views)), target_(target),
      wanted_(std::move(wanted)), post_process_(std::move(post_process)) {}

std::vector<PictureId> FramePicture::possible_dependencies() {
    Dependencies shown = context_.contents(number_).shown(wanted_);
    add_dependencies(post_process_.effects, shown);
    return shown;
}

std::vector<PictureId> FramePicture::dependencies() {
    const TargetDescription& description = target_.description();
    Dependencies shown = plan(std::move(views_), description.width, description.height,
                              description.depth_format, wanted_);
    add_dependencies(post_process_.effects, shown);
    return shown;
}

void FramePicture::update() { draw_changed(target_, post_process_); }

std::string FramePicture::label(std::size_t /*place*/) const { return "the frame"; }

}  // namespace cubecam
