#include "cubecam/render/graph/shadow_picture.hpp"

#include "cubecam/core/revision.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <utility>

namespace cubecam {
namespace {

void add_caster(Key& key, const NodeSnapshot& node, TextureLookup& lookup) {
    key.add(node.world);
    key.add(node.mesh->revision());
    if (!moves_vertices(node) && !has_holes(node)) return;
    key.add(node.material.revision);
    for (const BoundTexture& texture : lookup.find_for_shadow(node)) key.add(texture.revision);
}

/// A key of the whole map: it costs less than the layers' keys, which need every caster culled
/// against every view.
Key whole_key(const SceneSnapshot& scene, const ShadowView& view, TextureLookup& lookup) {
    Key key;
    key.add(view.views.front().view_projection);
    key.add(view.views.front().position);
    for (const NodeSnapshot& node : scene.nodes) {
        if (casts_shadow(node)) add_caster(key, node, lookup);
    }
    return key;
}

std::vector<Key> layer_keys(const SceneSnapshot& scene, const ShadowView& view,
                            const DrawPlan& plan, TextureLookup& lookup) {
    std::vector<Key> keys(view.views.size());
    for (std::size_t v = 0; v < keys.size(); ++v) {
        keys[v].add(view.views[v].view_projection);
        keys[v].add(view.views[v].position);
    }
    plan.for_each([&](const PlannedNode& planned) {
        const NodeSnapshot& node = scene.nodes[planned.node];
        for (const Visibility& visibility : plan.visible_in(planned)) {
            add_caster(keys[visibility.view], node, lookup);
        }
    });
    return keys;
}

}  // namespace

ShadowPicture::ShadowPicture(FrameContext& context, const PictureId& id)
    : context_(context), id_(id), scene_(context.scenes.scene(id.scene)),
      state_(context.shadow_state(id.scene, id.object)) {}

std::vector<PictureId> ShadowPicture::possible_dependencies() {
    Dependencies shown;
    add_caster_dependencies(scene_, id_.scene, shown);
    return shown;
}

std::vector<PictureId> ShadowPicture::dependencies() {
    return context_.with_shown_probes(id_, id_.scene, possible_dependencies());
}

void ShadowPicture::update() {
    const LightValue& light = scene_.lights[id_.object].value;
    const int size = light.shadow->size;
    use_ = {shadow_view(light, scene_), *light.shadow, 0, 0};
    const std::size_t layers = use_.view.views.size();
    if (state_.map.size != size || state_.keys.size() != layers) {
        state_ = {};  // frees the old memory first
        state_.map = context_.gpu.shadows.make_map(size, static_cast<int>(layers));
        state_.keys.resize(layers);
    }
    TextureLookup lookup(context_, id_, id_.scene);
    Key whole = whole_key(scene_, use_.view, lookup);
    if (state_.whole != whole) draw_changed(lookup);
    state_.whole = std::move(whole);
    use_.texture = state_.map.depth.id();
    use_.revision = state_.revision;
}

void ShadowPicture::draw_changed(TextureLookup& lookup) {
    state_.whole.reset();
    const std::vector<View>& views = use_.view.views;
    const DrawPlan plan = make_plan(scene_, views, state_.map.size, state_.map.size, casts_shadow);
    std::vector<Key> keys = layer_keys(scene_, use_.view, plan, lookup);
    const ShadowInput input{scene_, use_.view, plan, [&lookup](const NodeSnapshot& node) {
                                return lookup.find_for_shadow(node);
                            }};
    std::size_t drawn = 0;
    for (std::size_t layer = 0; layer < keys.size(); ++layer) {
        if (state_.keys[layer] == keys[layer]) continue;
        state_.keys[layer].reset();
        context_.gpu.shadows.draw(input, layer, state_.map, context_.stats);
        ++drawn;
    }
    if (drawn == 0) return;
    gl::check_gl(context_.gpu.context.gl(), "drawing a shadow map");
    for (std::size_t layer = 0; layer < keys.size(); ++layer) {
        state_.keys[layer] = std::move(keys[layer]);
    }
    state_.revision = context_.gpu.contents = next_revision();
    context_.stats.shadow_views_drawn += static_cast<std::int64_t>(drawn);
}

std::string ShadowPicture::label(std::size_t /*place*/) const { return ""; }

}  // namespace cubecam
