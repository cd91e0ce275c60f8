#include "cubecam/render/graph/scene_picture.hpp"

#include "cubecam/scene/snapshot_queries.hpp"

#include <utility>

namespace cubecam {

ScenePicture::ScenePicture(FrameContext& context, PictureId id, std::size_t scene)
    : context_(context), id_(std::move(id)), number_(scene), scene_(context.scenes.scene(scene)) {}

Dependencies ScenePicture::plan(std::vector<View> views, int width, int height,
                                DepthFormat depth_format, const Wanted& wanted) {
    views_ = std::move(views);
    plan_ = make_plan(scene_, views_, width, height, wanted, depth_mode(depth_format));
    Dependencies shown;
    const bool shadows = has_shadows(scene_);
    shows_shadows_ = false;
    plan_.for_each([&](const PlannedNode& planned) {
        const NodeSnapshot& node = scene_.nodes[planned.node];
        add_dependencies(scene_, number_, node, shown);
        shows_shadows_ = shows_shadows_ || (shadows && receive_shadow(node));
    });
    if (shows_shadows_) add_shadows(scene_, number_, shown);
    return shown;
}

std::size_t ScenePicture::draw_changed(Target& target, const PostProcess& post_process,
                                       std::optional<Budget> budget) {
    TextureLookup lookup(context_, id_, number_);
    const std::vector<ShadowUse> shadows =
        shows_shadows_ ? context_.shadows(number_) : std::vector<ShadowUse>();
    DrawnPicture picture{context_.gpu, scene_,  views_,       plan_,
                         lookup,       shadows, post_process, context_.stats};
    return picture.draw_changed(target, budget);
}

}  // namespace cubecam
