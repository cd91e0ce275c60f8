#include "cubecam/render/graph/scene_picture.hpp"

#include "cubecam/render/graph/picture_kind.hpp"
#include "cubecam/render/graph/planar_mirror_picture.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace cubecam {
namespace {

/// Whether rays from a node may be looked up on the screen.
bool reflects_environment(const NodeSnapshot& node) {
    return node.material.value.traits().uses_environment &&
           !std::holds_alternative<PlanarMirrorIndex>(node.environment);
}

}  // namespace

ScenePicture::ScenePicture(FrameContext& context, PictureId id, std::size_t scene)
    : context_(context), id_(std::move(id)), number_(scene), scene_(context.scenes.scene(scene)) {}

BoundTexture ScenePicture::behind() {
    if (!shows_behind_) return {};
    const Target::Behind& kept = kept_behind();
    return {kept.target->color().id(), kept.revision};
}

std::optional<PlanarReflection> ScenePicture::reflection(const NodeSnapshot& node) {
    const PlanarMirrors& mirrors = context_.mirrors(number_);
    const auto mirror = mirrors.of(node);
    if (!mirror || *mirror >= mirror_bounds_.size() || mirror_bounds_[*mirror].empty()) {
        return std::nullopt;
    }
    auto& picture = static_cast<PlanarMirrorPicture&>(
        context_.pictures.at(planar_mirror_id(mirror_viewer(), *mirror)));
    return PlanarReflection{picture.texture(), mirrors.all()[*mirror].plane.normal,
                            mirrors.all()[*mirror].value.distance};
}

void ScenePicture::add_mirror(const PlannedNode& planned, const std::vector<Rect>& windows,
                              const glm::ivec2& size) {
    const NodeSnapshot& node = scene_.nodes[planned.node];
    const PlanarMirrors& mirrors = context_.mirrors(number_);
    const auto place = mirrors.of(node);
    if (!place || !node.material.value.traits().uses_environment) return;
    const PlanarMirrors::Mirror& mirror = mirrors.all()[*place];
    if (mirrors_met() >= static_cast<std::size_t>(mirror.value.bounces)) return;
    mirror_bounds_.resize(mirrors.all().size());
    std::vector<Rect>& bounds = mirror_bounds_[*place];
    const bool both_sides = node.material.value.surface.double_sided;
    for (const Visibility& visibility : plan_.visible_in(planned)) {
        const View& view = views_[visibility.view];
        if (!both_sides && !sees_front(view, mirror.plane)) continue;
        Rect covered = visibility.bounds;
        if (!node.unbounded) {
            covered = covered.intersected(bounds_in_view(view, node, size.x, size.y));
        }
        if (!windows.empty()) covered = covered.intersected(windows[visibility.view]);
        if (covered.empty()) continue;
        if (bounds.empty()) bounds.resize(views_.size());
        Rect& known = bounds[visibility.view];
        known = known.empty() ? covered : known.united(covered);
    }
}

Dependencies ScenePicture::mirror_pictures() {
    Dependencies pictures;
    std::set<Target::Mirrors::Name> names;
    for (std::size_t m = 0; m < mirror_bounds_.size(); ++m) {
        if (mirror_bounds_[m].empty()) continue;
        pictures.push_back(planar_mirror_id(mirror_viewer(), m));
        names.insert(context_.mirrors(number_).all()[m].name);
    }
    if (mirror_viewer() == id_) {
        std::erase_if(kept_mirrors().kept,
                      [&names](const auto& kept) { return !names.contains(kept.first); });
    }
    return pictures;
}

Dependencies ScenePicture::possible() {
    const auto wanted = [this](const NodeSnapshot& node) { return sees(node); };
    const SceneContents& contents = context_.contents(number_);
    Dependencies shown = contents.shown(wanted);
    if (contents.shows_behind(wanted)) shown.push_back(behind_id(mirror_viewer()));
    // What mirrors in mirrors show, the first mirrors may show, too.
    if (mirrors_met() == 0) {
        for (std::size_t m = 0; m < context_.mirrors(number_).all().size(); ++m) {
            const bool seen = std::any_of(
                scene_.nodes.begin(), scene_.nodes.end(), [&](const NodeSnapshot& node) {
                    return context_.mirrors(number_).of(node) == m && wanted(node);
                });
            if (seen) shown.push_back(planar_mirror_id(mirror_viewer(), m));
        }
    }
    return shown;
}

double ScenePicture::max_lod_error() const {
    const PictureId* root = &id_;
    while (root->viewer != nullptr) root = root->viewer.get();
    return root->kind == PictureKind::frame ? context_.max_lod_error : 0.0;
}

Dependencies ScenePicture::plan(std::vector<View> views, const TargetDescription& target) {
    views_ = std::move(views);
    plan_ = make_plan(
        scene_, views_, target.width, target.height,
        [this](const NodeSnapshot& node) { return sees(node); }, depth_mode(target.depth_format),
        max_lod_error());
    Dependencies shown;
    const bool shadows = has_shadows(scene_);
    shows_shadows_ = false;
    shows_behind_ = false;
    reflects_ = false;
    reflects_by_level_ = false;
    mirror_bounds_.clear();
    const bool mirrors = target.color && !context_.mirrors(number_).all().empty();
    const std::vector<Rect> through = mirrors ? windows() : std::vector<Rect>();
    plan_.for_each([&](const PlannedNode& planned) {
        const NodeSnapshot& node = scene_.nodes[planned.node];
        add_dependencies(scene_, number_, node, shown);
        shows_shadows_ = shows_shadows_ || (shadows && receive_shadow(node));
        shows_behind_ = shows_behind_ || (target.color && shows_behind(node));
        if (target.color && reflects_environment(node)) {
            const EnvironmentParts& parts = node.material.value.traits().environment_parts;
            reflects_ = true;
            reflects_by_level_ =
                reflects_by_level_ || parts.filtered || parts.mipmaps || parts.filtered_if_made;
        }
        if (mirrors) add_mirror(planned, through, {target.width, target.height});
    });
    shown = context_.with_shown_probes(id_, number_, shown);
    if (shows_behind_) shown.push_back(behind_id(mirror_viewer()));
    const Dependencies mirrored = mirror_pictures();
    shown.insert(shown.end(), mirrored.begin(), mirrored.end());
    if (shows_shadows_) add_shadows(scene_, number_, shown);
    return shown;
}

template <class Draw>
auto ScenePicture::with_picture(const PostProcess& post_process, const Draw& draw) {
    TextureLookup lookup(context_, id_, number_);
    const std::vector<ShadowUse> shadows =
        shows_shadows_ ? context_.shadows(number_) : std::vector<ShadowUse>();
    DrawnPicture picture{context_.gpu, scene_,  views_,       plan_,
                         lookup,       shadows, post_process, context_.stats};
    return draw(picture);
}

std::size_t ScenePicture::draw_changed(Target& target, const PostProcess& post_process,
                                       std::optional<Budget> budget) {
    return with_picture(
        post_process, [&](DrawnPicture& picture) { return picture.draw_changed(target, budget); });
}

void ScenePicture::draw_shared(Target& target, std::size_t first_layer,
                               const std::vector<bool>& drawn) {
    with_picture({},
                 [&](DrawnPicture& picture) { picture.draw_shared(target, first_layer, drawn); });
}

bool ScenePicture::draw_kept(std::unique_ptr<Target>& target, const std::function<void()>& forget) {
    const TargetDescription description = describe();
    if (target == nullptr || target->description() != description) {
        forget();  // frees the old memory first
        target = std::make_unique<Target>(context_.gpu.context, description);
    }
    try {
        if (draw_changed(*target) == 0) return false;
        if (description.mipmaps) {
            context_.gpu.context.gl().GenerateTextureMipmap(target->color().id());
        }
    } catch (...) {
        forget();
        throw;
    }
    return true;
}

}  // namespace cubecam
