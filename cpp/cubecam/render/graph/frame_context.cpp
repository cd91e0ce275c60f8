#include "cubecam/render/graph/frame_context.hpp"

#include "cubecam/render/graph/batch_picture.hpp"
#include "cubecam/render/graph/behind_picture.hpp"
#include "cubecam/render/graph/frame_picture.hpp"
#include "cubecam/render/graph/picture_kind.hpp"
#include "cubecam/render/graph/planar_mirror_picture.hpp"
#include "cubecam/render/graph/probe_picture.hpp"
#include "cubecam/render/graph/screen_picture.hpp"
#include "cubecam/render/graph/shadow_picture.hpp"
#include "cubecam/render/graph/texture_picture.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>

namespace cubecam {
namespace {

/// Of mirrors in mirrors: a hall of n mirrors that all see each other makes n^bounces pictures.
constexpr std::size_t most_mirror_pictures = 256;

}  // namespace

FrameContext::FrameContext(RendererState& its_gpu, const SceneSnapshot& its_scenes,
                           double lod_error)
    : gpu(its_gpu), scenes(its_scenes), max_lod_error(lod_error),
      pictures([this](const PictureId& id) { return make(id); }),
      contents_(its_scenes.others.size() + 1), circles_(contents_.size()) {
    std::map<const void*, std::size_t> users;  // how many scenes so far use an object; not iterated
    for (std::size_t s = 0; s < contents_.size(); ++s) {
        const SceneSnapshot& scene = scenes.scene(s);
        gpu.shadows.check(scene);
        Ranks& ranks = ranks_.emplace_back();
        for (const ProbeSnapshot& probe : scene.probes) {
            ranks.probes.push_back(users[probe.object.get()]++);
        }
        for (const LightSnapshot& light : scene.lights) {
            ranks.lights.push_back(users[light.object.get()]++);
        }
        mirrors_.emplace_back(scene, gpu.planes);
        add_caster_dependencies(scene, s, caster_dependencies_);
    }
    caster_dependencies_ = unique(std::move(caster_dependencies_));
}

bool FrameContext::counts_no_calls() const {
    for (std::size_t s = 0; s < contents_.size(); ++s) {
        for (const ProbeSnapshot& probe : scenes.scene(s).probes) {
            const ProbeValue& value = probe.value;
            if (value.update == ProbeUpdate::every_n_frames || value.faces_per_frame < 6) {
                return false;
            }
        }
    }
    return true;
}

void FrameContext::draw(std::vector<View> views, Target& target,
                        std::function<bool(const NodeSnapshot&)> wanted, Key wanted_key,
                        PostProcess post_process, bool screen_reflections) {
    Key request = std::move(wanted_key);
    request.add(screen_reflections);
    request.add(max_lod_error);
    for (const View& view : views) add_view(request, view);
    add_grading(request, post_process);
    const std::optional<UnchangedCall>& last = target.unchanged;
    if (last && last->scene == scenes.revision && last->contents == gpu.contents &&
        last->request == request) {
        stats.views_skipped = last->views;
        return;
    }
    target.unchanged.reset();
    pictures.add(frame_id(),
                 std::make_unique<FramePicture>(*this, std::move(views), target, std::move(wanted),
                                                std::move(post_process), screen_reflections));
    update({frame_id()});
    if (stats.views_drawn == 0 && stats.shadow_views_drawn == 0 && counts_no_calls()) {
        target.unchanged = {scenes.revision, gpu.contents, std::move(request), stats.views_skipped};
    }
}

void FrameContext::draw(std::vector<View> views, BatchTarget& batch, std::size_t cube,
                        std::function<bool(const NodeSnapshot&)> wanted) {
    pictures.add(frame_id(), std::make_unique<BatchPicture>(*this, std::move(views), batch, cube,
                                                            std::move(wanted)));
    update({frame_id()});
}

void FrameContext::update_probes(const std::vector<std::size_t>& probes) {
    Dependencies roots;
    for (const std::size_t place : probes) {
        probe(probe_id(0, place)).force();
        const Dependencies all = probe_pictures(0, place);
        roots.insert(roots.end(), all.begin(), all.end());
    }
    update(roots);
}

bool FrameContext::draw_again(const Probe& lost) {
    for (std::size_t s = 0; s < contents_.size(); ++s) {
        const std::vector<ProbeSnapshot>& probes = scenes.scene(s).probes;
        for (std::size_t place = 0; place < probes.size(); ++place) {
            if (probes[place].object.get() != &lost) continue;
            probe(probe_id(s, place)).force();
            update(probe_pictures(s, place));
            return true;
        }
    }
    return false;
}

bool FrameContext::draw_again(const RenderTexture& lost) {
    for (std::size_t place = 0; place < scenes.textures.size(); ++place) {
        if (scenes.textures[place].object.get() != &lost) continue;
        update({texture_id(place)});
        return true;
    }
    return false;
}

Buffer<float> FrameContext::shadow_map(std::size_t light) {
    Dependencies roots;
    add_shadows(scenes, 0, roots);
    update(roots);
    return gpu.shadows.read(static_cast<ShadowPicture&>(pictures.at(shadow_id(0, light))).use());
}

void FrameContext::update(const std::vector<PictureId>& roots) {
    // Without render textures and moved casters no picture is strict, so no circle is refused.
    if (!scenes.textures.empty() || !caster_dependencies_.empty()) {
        std::string advice = "; leave the nodes that show it out with exclude=";
        if (!caster_dependencies_.empty()) {
            advice += ", those that cast by it with cast_shadow=False";
        }
        pictures.refuse_circles(roots, advice);
    }
    pictures.update(roots);
    measure_bounces();
}

void FrameContext::measure_bounces() {
    std::vector<BouncePair> pairs;
    for (const PictureId& id : pictures.order()) {
        if (id.kind != PictureKind::probe || id.bounce == 0) continue;
        // One bounce less is out of date if nothing in this call shows it.
        const ProbePicture& more = probe(id);
        const ProbePicture& less = probe(probe_id(id.scene, id.object, id.bounce - 1));
        if (!more.probe_updated() || !more.up_to_date() || !less.up_to_date()) continue;
        pairs.push_back({id.bounce, less.cube(), more.cube()});
    }
    if (!pairs.empty()) stats.bounce_changes = gpu.bounce_changes.measure(pairs, stats);
}

std::unique_ptr<Picture> FrameContext::make(const PictureId& id) {
    switch (id.kind) {
        case PictureKind::probe: return std::make_unique<ProbePicture>(*this, id);
        case PictureKind::texture: return std::make_unique<TexturePicture>(*this, id);
        case PictureKind::shadow: return std::make_unique<ShadowPicture>(*this, id);
        case PictureKind::behind: return std::make_unique<BehindPicture>(*this, id);
        case PictureKind::screen: return std::make_unique<ScreenPicture>(*this, id);
        case PictureKind::planar_mirror:
            if (id.viewer->kind == id.kind && ++mirror_pictures_ > most_mirror_pictures) {
                throw std::invalid_argument(
                    "planar mirrors: expected at most " + std::to_string(most_mirror_pictures) +
                    " pictures of mirrors in mirrors in one call, got more: mirrors that see each "
                    "other need one for each path; set fewer bounces");
            }
            return std::make_unique<PlanarMirrorPicture>(*this, id);
        case PictureKind::frame: break;
    }
    throw std::logic_error("expected a frame to be added before something depends on it");
}

ProbePicture& FrameContext::probe(const PictureId& id) {
    return static_cast<ProbePicture&>(pictures.at(id));
}

const ProbeCircles& FrameContext::probe_circles(std::size_t scene) {
    std::optional<ProbeCircles>& known = circles_[scene];
    if (!known) known.emplace(scenes.scene(scene));
    return *known;
}

std::vector<PictureId> FrameContext::probe_pictures(std::size_t scene, std::size_t probe) {
    std::vector<PictureId> all;
    const std::size_t levels = probe_circles(scene).levels(probe);
    for (std::size_t bounce = 0; bounce < levels; ++bounce) {
        all.push_back(probe_id(scene, probe, bounce));
    }
    return all;
}

std::optional<PictureId> FrameContext::shown_probe(const PictureId& viewer, std::size_t scene,
                                                   std::size_t probe) {
    // A picture for one viewer shows what its viewer shows.
    const PictureId* root = &viewer;
    while (root->viewer != nullptr) root = root->viewer.get();
    const bool in_circle = root->kind == PictureKind::probe && root->scene == scene &&
                           probe_circles(scene).together(root->object, probe);
    if (in_circle && root->bounce == 0) return std::nullopt;
    ProbePicture& first = this->probe(probe_id(scene, probe));
    if (first.due()) {
        const std::size_t levels = in_circle ? root->bounce : probe_circles(scene).levels(probe);
        return probe_id(scene, probe, levels - 1);
    }
    const auto kept =
        first.drawn_below(in_circle ? root->bounce : std::numeric_limits<std::size_t>::max());
    if (!kept) return std::nullopt;  // a manual probe before its first update
    return probe_id(scene, probe, *kept);
}

ScenePicture& FrameContext::scene_picture(const PictureId& id) {
    return static_cast<ScenePicture&>(pictures.at(id));
}

Dependencies FrameContext::with_shown_probes(const PictureId& viewer, std::size_t scene,
                                             const Dependencies& shown) {
    Dependencies found;
    std::vector<bool> known(scenes.scene(scene).probes.size(), false);
    for (const PictureId& id : shown) {
        if (id.kind != PictureKind::probe) {
            found.push_back(id);
        } else if (!known[id.object]) {
            known[id.object] = true;
            if (auto picture = shown_probe(viewer, scene, id.object)) {
                found.push_back(std::move(*picture));
            }
        }
    }
    return found;
}

TexturePicture& FrameContext::texture(std::size_t place) {
    return static_cast<TexturePicture&>(pictures.at(texture_id(place)));
}

std::vector<ShadowUse> FrameContext::shadows(std::size_t scene) {
    Dependencies maps;
    add_shadows(scenes.scene(scene), scene, maps);
    std::vector<ShadowUse> uses;
    for (const PictureId& id : maps) {
        uses.push_back(static_cast<ShadowPicture&>(pictures.at(id)).use());
    }
    return uses;
}

ProbeLevels& FrameContext::probe_levels(std::size_t scene, std::size_t probe) {
    const ProbeSnapshot& snapshot = scenes.scene(scene).probes[probe];
    // A manual probe has one state: every scene sees what it last showed.
    const bool by_hand = snapshot.value.update == ProbeUpdate::manual;
    return gpu.probes.get(snapshot.object, [] { return StatesByScene<ProbeLevels>(); })
        .of(by_hand ? 0 : ranks_[scene].probes[probe]);
}

ShadowState& FrameContext::shadow_state(std::size_t scene, std::size_t light) {
    return gpu.shadow_maps
        .get(scenes.scene(scene).lights[light].object, [] { return StatesByScene<ShadowState>(); })
        .of(ranks_[scene].lights[light]);
}

const SceneContents& FrameContext::contents(std::size_t scene) {
    std::optional<SceneContents>& known = contents_[scene];
    if (!known) known.emplace(scenes.scene(scene), scene);
    return *known;
}

bool FrameContext::moves_casters(const PictureId& picture) const {
    return std::binary_search(caster_dependencies_.begin(), caster_dependencies_.end(), picture);
}

}  // namespace cubecam
