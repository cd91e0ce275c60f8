#include "cubecam/render/call.hpp"

#include "cubecam/scene/revision.hpp"

#include <algorithm>

namespace cubecam {
namespace {

bool contains(const std::vector<std::int32_t>& ids, std::int32_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool uses(const NodeSnapshot& node, std::size_t probe) {
    const auto is_probe = [probe](const FrozenSource& source) {
        const auto* index = std::get_if<std::size_t>(&source);
        return index != nullptr && *index == probe;
    };
    return is_probe(node.environment) || is_probe(node.cubemap);
}

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

bool is_excluded(const NodeSnapshot& node, const std::vector<std::int32_t>& excluded) {
    if (excluded.empty()) return false;
    return contains(excluded, node.id) ||
           std::any_of(node.ancestors.begin(), node.ancestors.end(),
                       [&excluded](std::int32_t id) { return contains(excluded, id); });
}

Call::Call(GpuState& gpu, const SceneSnapshot& scene)
    : gpu_(gpu), scene_(scene), work_(scene.probes.size()) {
    gpu_.shadows.check(scene);
}

const FrozenSource& Call::source_of(const NodeSnapshot& node) const {
    static const FrozenSource none;
    const MaterialParameters& parameters = node.material.value.parameters;
    if (std::holds_alternative<BasicParameters>(parameters)) return node.cubemap;
    if (std::holds_alternative<PhongParameters>(parameters)) return none;
    return node.environment.index() == 0 ? scene_.environment : node.environment;
}

std::vector<std::size_t> Call::probes_of(const DrawPlan& plan) const {
    std::vector<std::size_t> probes;
    for (const auto* nodes : {&plan.opaque, &plan.translucent}) {
        for (const PlannedNode& planned : *nodes) {
            const auto* probe = std::get_if<std::size_t>(&source_of(scene_.nodes[planned.node]));
            if (probe != nullptr) probes.push_back(*probe);
        }
    }
    std::sort(probes.begin(), probes.end());
    probes.erase(std::unique(probes.begin(), probes.end()), probes.end());
    return probes;
}

Call::Lookup Call::look_up(const FrozenSource& source, std::optional<std::size_t> in_probe,
                           const ProbeOrder* order) {
    if (const auto* cube = std::get_if<FrozenCube>(&source)) {
        return {gpu_.cache.cube(*cube).texture.id(), cube->data->revision};
    }
    const auto* probe = std::get_if<std::size_t>(&source);
    if (probe == nullptr) return {};
    const bool back =
        in_probe && work_[*probe] && work_[*probe]->due && order->is_edge_back(*in_probe, *probe);
    const ProbeState* state =
        work_[*probe] ? work_[*probe]->state : gpu_.probes.find(scene_.probes[*probe].object);
    if (!back && state != nullptr && state->target != nullptr) {
        return {state->target->color().id(), state->revision};
    }
    // A mirror in a circle of mirrors, or a manual probe before its first update.
    return std::holds_alternative<FrozenCube>(scene_.environment)
               ? look_up(scene_.environment, in_probe, order)
               : Lookup{};
}

std::vector<Call::Lookup> Call::look_up_all(const DrawPlan& plan,
                                            std::optional<std::size_t> in_probe,
                                            const ProbeOrder* order) {
    std::vector<Lookup> lookups(scene_.nodes.size());
    for (const auto* nodes : {&plan.opaque, &plan.translucent}) {
        for (const PlannedNode& planned : *nodes) {
            lookups[planned.node] = look_up(source_of(scene_.nodes[planned.node]), in_probe, order);
        }
    }
    return lookups;
}

Call::Lookup Call::background_lookup() {
    const auto* cube = std::get_if<FrozenCube>(&scene_.background);
    return cube == nullptr ? Lookup{} : look_up(*cube, std::nullopt, nullptr);
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

void Call::find_work(std::size_t index, std::vector<std::vector<std::size_t>>& needs) {
    const ProbeSnapshot& probe = scene_.probes[index];
    ProbeWork& work = work_[index] ? *work_[index] : work_[index].emplace();
    work.state = &gpu_.probes.get(probe.object, [] { return ProbeState{}; });
    work.due = count_and_decide(probe, work);
    if (!work.due) return;  // it shows what it holds, and needs nothing
    work.views = cube_views(probe.position, probe.value.near, probe.value.far);
    work.plan = make_plan(
        scene_, work.views, probe.value.size, probe.value.size, [&](const NodeSnapshot& node) {
            return node.in_probes && !uses(node, index) && !is_excluded(node, probe.excluded);
        });
    needs[index] = probes_of(work.plan);
}

void Call::update_probes(const std::vector<std::size_t>& roots) {
    std::vector<std::vector<std::size_t>> needs(scene_.probes.size());
    std::vector<bool> found(scene_.probes.size(), false);
    std::vector<std::size_t> open = roots;
    while (!open.empty()) {
        const std::size_t probe = open.back();
        open.pop_back();
        if (found[probe]) continue;
        found[probe] = true;
        find_work(probe, needs);
        open.insert(open.end(), needs[probe].begin(), needs[probe].end());
    }
    const ProbeOrder order = order_probes(needs, roots);
    for (const std::size_t probe : order.order) {
        if (work_[probe]->due) draw_probe(probe, order);
    }
}

void Call::draw_probe(std::size_t index, const ProbeOrder& order) {
    const ProbeSnapshot& probe = scene_.probes[index];
    ProbeWork& work = *work_[index];
    ProbeState& state = *work.state;
    TargetDescription description =
        describe_target(gpu_.context, true, probe.value.size, probe.value.size, probe.value.samples,
                        probe.value.format);
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
        drawn = draw_changed(work.views, work.plan, *state.target,
                             look_up_all(work.plan, index, &order), Tonemap::none, Encode::none,
                             budget);
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
                                      const std::vector<Lookup>& lookups, Tonemap tonemap,
                                      Encode encode) {
    Key common;
    common.add(tonemap);
    common.add(encode);
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
    for (const auto* nodes : {&plan.opaque, &plan.translucent}) {
        for (const PlannedNode& planned : *nodes) {
            const NodeSnapshot& node = scene_.nodes[planned.node];
            Key key;
            key.add(node.world);
            key.add(node.mesh->revision());
            key.add(node.material.revision);
            key.add(lookups[planned.node].revision);
            if (receives_shadows(node)) key.add(shadows);
            for (const PlannedNode::Sight& sight : planned.sights) {
                keys[sight.view].nodes.push_back({node.id, key, sight.bounds});
            }
        }
    }
    return keys;
}

std::size_t Call::draw_changed(std::span<const View> views, const DrawPlan& plan, Target& target,
                               const std::vector<Lookup>& lookups, Tonemap tonemap, Encode encode,
                               std::optional<Budget> budget) {
    need_shadows(plan);
    std::vector<PictureKey> keys = keys_of(views, plan, lookups, tonemap, encode);
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
    const Lookup sky = background_lookup();
    const auto* color = std::get_if<glm::vec4>(&scene_.background);
    gpu_.surface.draw(
        {scene_, views, plan, std::move(regions),
         color != nullptr ? BackgroundSource(*color) : BackgroundSource(sky.texture),
         [&lookups](std::size_t node) { return lookups[node].texture; },
         shadows_ ? std::span<const ShadowUse>(*shadows_) : std::span<const ShadowUse>()},
        target, stats);
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!damaged[v].empty() && target.multisampled()) target.resolve(static_cast<int>(v));
    }
    if (target.description().graded) grade(target, tonemap, encode);
    gl::check_gl(gpu_.context.gl(), "finishing a picture");
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!damaged[v].empty()) target.keys[v] = std::move(keys[v]);
    }
    return budget ? last : count;
}

void Call::need_shadows(const DrawPlan& plan) {
    if (shadows_) return;
    const auto receives = [this](const PlannedNode& planned) {
        return receives_shadows(scene_.nodes[planned.node]);
    };
    if (std::any_of(plan.opaque.begin(), plan.opaque.end(), receives) ||
        std::any_of(plan.translucent.begin(), plan.translucent.end(), receives)) {
        shadows_ = gpu_.shadows.update(scene_, stats);
    }
}

Buffer<float> Call::shadow_map(std::size_t light) {
    shadows_ = gpu_.shadows.update(scene_, stats);
    const auto before = std::count_if(
        scene_.lights.begin(), scene_.lights.begin() + static_cast<std::ptrdiff_t>(light),
        [](const LightSnapshot& other) { return other.value.shadow.has_value(); });
    return gpu_.shadows.read((*shadows_)[static_cast<std::size_t>(before)]);
}

void Call::grade(Target& target, Tonemap tonemap, Encode encode) {
    const GladGLContext& gl = gpu_.context.gl();
    gl.BindFramebuffer(GL_FRAMEBUFFER, target.graded_pass().one(0));
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_BLEND);
    gpu_.surface.programs().grade(tonemap, encode).use();
    gl.BindTextureUnit(0, target.color().id());
    gl.BindVertexArray(gpu_.cache.views_only().id());
    gl.DrawArrays(GL_TRIANGLE_STRIP, 0, 4);
    ++stats.draw_calls;
    stats.triangles += 2;
}

void Call::draw(std::span<const View> views, Target& target,
                const std::function<bool(const NodeSnapshot&)>& wanted, Tonemap tonemap,
                Encode encode) {
    const DrawPlan plan =
        make_plan(scene_, views, target.description().width, target.description().height, wanted);
    update_probes(probes_of(plan));
    draw_changed(views, plan, target, look_up_all(plan, std::nullopt, nullptr), tonemap, encode,
                 std::nullopt);
}

void Call::force(const std::vector<std::size_t>& probes) {
    for (const std::size_t probe : probes) work_[probe].emplace().forced = true;
    update_probes(probes);
}

}  // namespace cubecam
