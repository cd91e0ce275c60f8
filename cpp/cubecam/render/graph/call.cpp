#include "cubecam/render/graph/call.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/render/graph/dependencies.hpp"
#include "cubecam/render/graph/session.hpp"

#include <algorithm>

namespace cubecam {
namespace {

void add_light(Key& key, const LightValue& light) {
    key.add(light.parameters.index());
    key.add(light.color);
    key.add(light.intensity);
    if (const auto* point = std::get_if<PointParameters>(&light.parameters)) {
        key.add(point->position);
        key.add(point->decay);
    } else if (const auto* sun = std::get_if<DirectionalParameters>(&light.parameters)) {
        key.add(sun->direction);
    } else if (const auto* spot = std::get_if<SpotParameters>(&light.parameters)) {
        key.add(spot->position);
        key.add(spot->direction);
        key.add(spot->angle);
        key.add(spot->penumbra);
        key.add(spot->decay);
    }
    key.add(light.shadow.has_value());
}

/// What a node that receives shadows hangs on besides.
Key key_of(const std::vector<ShadowUse>& shadows) {
    Key key;
    for (const ShadowUse& use : shadows) {
        key.add(use.revision);
        key.add(use.shadow.radius);
        key.add(use.shadow.bias);
    }
    return key;
}

}  // namespace

Call::Call(Session& session, const SceneSnapshot& scene, std::size_t number,
           std::vector<std::size_t> ranks, std::vector<std::size_t> light_ranks)
    : stats(session.stats), session_(session), gpu_(session.gpu), scene_(scene), number_(number),
      ranks_(std::move(ranks)), light_ranks_(std::move(light_ranks)), work_(scene.probes.size()) {
    gpu_.shadows.check(scene);
}

std::vector<std::size_t> Call::needs_of(const DrawPlan& plan) const {
    std::vector<std::size_t> needs;
    for (const auto* nodes : {&plan.opaque, &plan.transparent}) {
        for (const PlannedNode& planned : *nodes) {
            session_.numbers.add_needs(scene_, number_, scene_.nodes[planned.node], needs);
        }
    }
    if (receives_any(plan)) session_.numbers.add_shadow_needs(scene_, number_, needs);
    return unique(std::move(needs));
}

ProbeState& Call::state_of(std::size_t index) {
    const ProbeSnapshot& probe = scene_.probes[index];
    // One that is drawn by hand alone shows in every scene what it was told to draw.
    const bool by_hand = probe.value.update == ProbeUpdate::manual;
    ProbeContents& contents = gpu_.probes.get(probe.object, [] { return ProbeContents(); });
    return contents.of(by_hand ? 0 : ranks_[index]);
}

BoundTexture Call::look_up(const CubeSourceSnapshot& source, std::optional<std::size_t> in_probe) {
    if (const auto* cube = std::get_if<CubeSnapshot>(&source)) {
        return {gpu_.cache.cube(*cube).texture.id(), cube->data->revision};
    }
    const auto* probe = std::get_if<std::size_t>(&source);
    if (probe == nullptr) return {};
    const auto number = [this](std::size_t p) { return session_.numbers.of_probe(number_, p); };
    const bool back = in_probe && work_[*probe] && work_[*probe]->due &&
                      session_.order().is_edge_back(number(*in_probe), number(*probe));
    const ProbeState& state = work_[*probe] ? *work_[*probe]->state : state_of(*probe);
    if (!back && state.target != nullptr) return {state.target->color().id(), state.revision};
    // A mirror in a circle of mirrors, or a manual probe before its first update.
    return std::holds_alternative<CubeSnapshot>(scene_.environment)
               ? look_up(scene_.environment, in_probe)
               : BoundTexture{};
}

BoundTexture Call::look_up(const TextureSourceSnapshot& texture,
                           std::optional<std::size_t> in_probe) {
    if (const auto* map = std::get_if<MapSnapshot>(&texture)) return session_.look_up(*map);
    return look_up(std::get<CubeSourceSnapshot>(texture), in_probe);
}

NodeTextures Call::look_up(const NodeSnapshot& node, std::optional<std::size_t> in_probe) {
    NodeTextures found{look_up(source_of(scene_, node), in_probe), session_.look_up(node.map), {}};
    for (const TextureSourceSnapshot& texture : node.textures) {
        found.textures.push_back(look_up(texture, in_probe));
    }
    return found;
}

std::vector<NodeTextures> Call::look_up_all(const DrawPlan& plan,
                                            std::optional<std::size_t> in_probe) {
    std::vector<NodeTextures> lookups(scene_.nodes.size());
    for (const auto* nodes : {&plan.opaque, &plan.transparent}) {
        for (const PlannedNode& planned : *nodes) {
            lookups[planned.node] = look_up(scene_.nodes[planned.node], in_probe);
        }
    }
    return lookups;
}

std::vector<std::vector<BoundTexture>> Call::look_up_all(const PostProcess& post_process) {
    std::vector<std::vector<BoundTexture>> lookups;
    for (const EffectSnapshot& effect : post_process.effects) {
        std::vector<BoundTexture>& found = lookups.emplace_back();
        for (const TextureSourceSnapshot& texture : effect.textures) {
            found.push_back(look_up(texture, std::nullopt));
        }
    }
    return lookups;
}

BoundTexture Call::background_lookup() {
    const auto* cube = std::get_if<CubeSnapshot>(&scene_.background);
    return cube == nullptr ? BoundTexture{} : look_up(CubeSourceSnapshot(*cube), std::nullopt);
}

bool Call::count_and_decide(const ProbeSnapshot& probe, ProbeWork& work) {
    const bool drawn = work.state->target != nullptr;
    if (work.forced) return true;
    switch (probe.value.update) {
        case ProbeUpdate::on_change: return true;
        case ProbeUpdate::once: return !drawn;
        case ProbeUpdate::manual: return false;
        case ProbeUpdate::every_n_frames:
            return work.state->calls++ % probe.value.every == 0 || !drawn;
    }
    return true;
}

std::vector<std::size_t> Call::find_work(std::size_t index) {
    const ProbeSnapshot& probe = scene_.probes[index];
    ProbeWork& work = work_[index] ? *work_[index] : work_[index].emplace();
    work.state = &state_of(index);
    work.due = count_and_decide(probe, work);
    if (!work.due) return {};  // it shows what it holds, and needs nothing
    work.views = cube_views(probe.position, probe.value.near, probe.value.far);
    work.plan = make_plan(
        scene_, work.views, probe.value.size, probe.value.size,
        [&](const NodeSnapshot& node) { return is_seen(scene_, node, index); },
        depth_mode(probe.value.depth_format));
    return needs_of(work.plan);
}

void Call::draw_probe(std::size_t index) {
    const ProbeSnapshot& probe = scene_.probes[index];
    ProbeWork& work = *work_[index];
    if (!work.due) return;
    ProbeState& state = *work.state;
    TargetDescription description =
        describe_target(gpu_.context, {.shape = TargetShape::cube(),
                                       .width = probe.value.size,
                                       .height = probe.value.size,
                                       .samples = probe.value.samples,
                                       .format = probe.value.format,
                                       .depth_format = probe.value.depth_format});
    description.mipmaps = probe.value.mipmaps;
    std::optional<Budget> budget;
    if (state.target == nullptr || state.target->description() != description) {
        state.target = nullptr;  // its memory first
        state.target = std::make_unique<Target>(gpu_.context, description);
    } else if (!work.forced && probe.value.faces_per_frame < 6) {
        // The first time all six are drawn: a face that holds nothing yet would be garbage.
        budget = Budget{static_cast<std::size_t>(probe.value.faces_per_frame), state.next_face};
    }
    std::size_t drawn = 0;
    try {
        drawn = draw_changed(work.views, work.plan, *state.target, look_up_all(work.plan, index),
                             {}, budget);
    } catch (...) {
        state.target = nullptr;
        throw;
    }
    if (drawn == 0) return;
    if (budget) state.next_face = (budget->first + drawn) % 6;
    if (description.mipmaps) gpu_.context.gl().GenerateTextureMipmap(state.target->color().id());
    state.revision = next_revision();
    ++stats.probes_updated;
}

std::vector<PictureKey> Call::keys_of(std::span<const View> views, const DrawPlan& plan,
                                      const std::vector<NodeTextures>& lookups,
                                      const PostProcess& post_process) {
    Key common;
    common.add(post_process.tonemap);
    common.add(post_process.encode);
    common.add(post_process.effects.size());
    for (const EffectSnapshot& effect : post_process.effects) {
        common.add(effect.revision);
        for (const TextureSourceSnapshot& texture : effect.textures) {
            common.add(look_up(texture, std::nullopt).revision);
        }
    }
    common.add(scene_.background.index());
    if (const auto* color = std::get_if<glm::vec4>(&scene_.background)) common.add(*color);
    common.add(background_lookup().revision);
    common.add(scene_.lights.size());
    for (const LightSnapshot& light : scene_.lights) add_light(common, light.value);
    const Key shadows = shadows_ ? key_of(*shadows_) : Key();

    std::vector<PictureKey> keys(views.size());
    for (std::size_t v = 0; v < views.size(); ++v) {
        const View& view = views[v];
        Key& key = keys[v].common;
        key = common;
        key.add(view.view);
        key.add(view.view_projection);
        key.add(view.position);
        key.add(view.eye);
        key.add(view.near);
    }
    for (const auto* nodes : {&plan.opaque, &plan.transparent}) {
        for (const PlannedNode& planned : *nodes) {
            const NodeSnapshot& node = scene_.nodes[planned.node];
            Key key;
            key.add(node.world);
            key.add(node.mesh->revision());
            key.add(node.material.revision);
            const NodeTextures& found = lookups[planned.node];
            key.add(found.cube.revision);
            key.add(found.map.revision);
            for (const BoundTexture& texture : found.textures) key.add(texture.revision);
            if (receive_shadow(node)) key.add(shadows);
            for (const PlannedNode::Visibility& visibility : planned.visibilities) {
                keys[visibility.view].nodes.push_back({node.id, key, visibility.bounds});
            }
        }
    }
    return keys;
}

std::size_t Call::draw_changed(std::span<const View> views, const DrawPlan& plan, Target& target,
                               const std::vector<NodeTextures>& lookups,
                               const PostProcess& post_process, std::optional<Budget> budget) {
    need_shadows(plan);
    std::vector<PictureKey> keys = keys_of(views, plan, lookups, post_process);
    const Rect whole{0, 0, target.description().width, target.description().height};
    std::vector<std::vector<Rect>> damaged(views.size());
    std::size_t count = 0;
    std::size_t last = 0;
    const std::size_t first = budget ? budget->first : 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::size_t v = (first + i) % views.size();
        if (!budget || count < budget->faces) damaged[v] = damage(target.keys[v], keys[v], whole);
        // llvmpipe (Mesa 22.3) lets samples beyond the scissor's edge through.
        if (target.multisampled() && !damaged[v].empty()) damaged[v] = {whole};
        if (damaged[v].empty()) {
            ++stats.views_skipped;
            continue;
        }
        last = i + 1;
        ++count;
    }
    if (count == 0) return 0;
    stats.views_drawn += static_cast<std::int64_t>(count);

    std::vector<Region> regions;
    for (std::size_t v = 0; v < views.size(); ++v) {
        for (const Rect& rect : damaged[v]) regions.push_back({v, rect});
        // Until they are drawn, these layers hold nothing that can be trusted.
        if (!damaged[v].empty()) target.keys[v].reset();
    }
    const BoundTexture sky = background_lookup();
    const auto* color = std::get_if<glm::vec4>(&scene_.background);
    // Place by place: positions in the shaders count from where a view stands, so its picture is
    // the same bit for bit whether others are drawn along or not.
    while (!regions.empty()) {
        const View& here = views[regions.front().view];
        const auto elsewhere =
            std::stable_partition(regions.begin(), regions.end(), [&](const Region& region) {
                return same_place(here, views[region.view]);
            });
        std::vector<Region> rest(elsewhere, regions.end());
        regions.erase(elsewhere, regions.end());
        gpu_.surface.draw(
            {scene_, views, plan, std::move(regions),
             color != nullptr ? BackgroundSource(*color) : BackgroundSource(sky.texture), lookups,
             shadows_ ? std::span<const ShadowUse>(*shadows_) : std::span<const ShadowUse>()},
            target, stats);
        regions = std::move(rest);
    }
    const auto textures = look_up_all(post_process);
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (damaged[v].empty()) continue;
        if (target.multisampled()) target.resolve(static_cast<int>(v));
        if (target.description().post_processed) {
            gpu_.post_process.draw(post_process, textures, target, static_cast<int>(v), stats);
        }
    }
    gl::check_gl(gpu_.context.gl(), "finishing a picture");
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!damaged[v].empty()) target.keys[v] = std::move(keys[v]);
    }
    return budget ? last : count;
}

bool Call::receives_any(const DrawPlan& plan) const {
    const auto receives = [this](const PlannedNode& planned) {
        return receive_shadow(scene_.nodes[planned.node]);
    };
    return has_shadows(scene_) &&
           (std::any_of(plan.opaque.begin(), plan.opaque.end(), receives) ||
            std::any_of(plan.transparent.begin(), plan.transparent.end(), receives));
}

void Call::need_shadows(const DrawPlan& plan) {
    if (!shadows_ && receives_any(plan)) update_shadows();
}

void Call::update_shadows() {
    const auto look_up_in = [this](const NodeSnapshot& node) {
        std::vector<BoundTexture> found(node.textures.size());
        for (const std::size_t place : vertex_textures(node)) {
            found[place] = look_up(node.textures[place], std::nullopt);
        }
        return found;
    };
    shadows_ = gpu_.shadows.update(scene_, light_ranks_, look_up_in, stats);
}

Buffer<float> Call::shadow_map(std::size_t light) {
    update_shadows();
    const auto before = std::count_if(
        scene_.lights.begin(), scene_.lights.begin() + static_cast<std::ptrdiff_t>(light),
        [](const LightSnapshot& other) { return other.value.shadow.has_value(); });
    return gpu_.shadows.read((*shadows_)[static_cast<std::size_t>(before)]);
}

void Call::draw(std::span<const View> views, Target& target,
                const std::function<bool(const NodeSnapshot&)>& wanted,
                const PostProcess& post_process) {
    if (may_have_circles(session_.asked_for, session_.numbers)) {
        std::vector<std::size_t> shown;
        bool receives = false;
        for (const NodeSnapshot& node : scene_.nodes) {
            if (!wanted(node)) continue;
            session_.numbers.add_needs(scene_, number_, node, shown);
            receives = receives || receive_shadow(node);
        }
        if (receives) session_.numbers.add_shadow_needs(scene_, number_, shown);
        session_.numbers.add_needs(post_process.effects, shown);
        refuse_circles(session_.asked_for, session_.numbers, unique(std::move(shown)));
    }
    const TargetDescription& description = target.description();
    const DrawPlan plan = make_plan(scene_, views, description.width, description.height, wanted,
                                    depth_mode(description.depth_format));
    std::vector<std::size_t> needs = needs_of(plan);
    session_.numbers.add_needs(post_process.effects, needs);
    session_.update(unique(std::move(needs)));
    draw_planned(views, plan, target, post_process);
}

std::size_t Call::draw_planned(std::span<const View> views, const DrawPlan& plan, Target& target,
                               const PostProcess& post_process) {
    return draw_changed(views, plan, target, look_up_all(plan, std::nullopt), post_process,
                        std::nullopt);
}

void Call::force(const std::vector<std::size_t>& probes) {
    std::vector<std::size_t> numbers;
    for (const std::size_t probe : probes) {
        work_[probe].emplace().forced = true;
        numbers.push_back(session_.numbers.of_probe(number_, probe));
    }
    refuse_circles(session_.asked_for, session_.numbers, numbers);
    session_.update(numbers);
}

}  // namespace cubecam
