#include "cubecam/render/graph/scene_picture.hpp"

#include "cubecam/render/graph/picture_kind.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <utility>

namespace cubecam {

ScenePicture::ScenePicture(FrameContext& context, PictureId id, std::size_t scene)
    : context_(context), id_(std::move(id)), number_(scene), scene_(context.scenes.scene(scene)) {}

BoundTexture ScenePicture::behind() {
    if (!shows_behind_) return {};
    const Target::Behind& kept = kept_behind();
    return {kept.target->color().id(), kept.revision};
}

Dependencies ScenePicture::possible() {
    const auto wanted = [this](const NodeSnapshot& node) { return sees(node); };
    const SceneContents& contents = context_.contents(number_);
    Dependencies shown = contents.shown(wanted);
    if (contents.shows_behind(wanted)) shown.push_back(behind_id(id_));
    return shown;
}

Dependencies ScenePicture::plan(std::vector<View> views, const TargetDescription& target) {
    views_ = std::move(views);
    plan_ = make_plan(
        scene_, views_, target.width, target.height,
        [this](const NodeSnapshot& node) { return sees(node); }, depth_mode(target.depth_format));
    Dependencies shown;
    const bool shadows = has_shadows(scene_);
    shows_shadows_ = false;
    shows_behind_ = false;
    plan_.for_each([&](const PlannedNode& planned) {
        const NodeSnapshot& node = scene_.nodes[planned.node];
        add_dependencies(scene_, number_, node, shown);
        shows_shadows_ = shows_shadows_ || (shadows && receive_shadow(node));
        shows_behind_ = shows_behind_ || (target.color && shows_behind(node));
    });
    shown = context_.with_shown_probes(id_, number_, shown);
    if (shows_behind_) shown.push_back(behind_id(id_));
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
