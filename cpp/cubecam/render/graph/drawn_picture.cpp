#include "cubecam/render/graph/drawn_picture.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/pace.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <limits>

namespace cubecam {
namespace {

void add_light(Key& key, const LightValue& light) {
    key.add(light.parameters.index());
    key.add(light.color);
    key.add(light.intensity);
    if (const auto* point = std::get_if<PointParameters>(&light.parameters)) {
        key.add(point->position);
        key.add(point->decay);
        key.add(point->range);
    } else if (const auto* sun = std::get_if<DirectionalParameters>(&light.parameters)) {
        key.add(sun->direction);
    } else if (const auto* spot = std::get_if<SpotParameters>(&light.parameters)) {
        key.add(spot->position);
        key.add(spot->direction);
        key.add(spot->angle);
        key.add(spot->penumbra);
        key.add(spot->decay);
        key.add(spot->range);
    }
    key.add(light.shadow.has_value());
}

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double most_pixels_of_a_band = gl::Pace::chunk / 2;
constexpr int side_of_block = 4;  // llvmpipe tests so many pixels at once

/// The rectangle in bands of rows, of about so many pixels each.
std::vector<Rect> bands(const Rect& rect, double most) {
    if (static_cast<double>(rect.area()) <= most) return {rect};
    const int rows = std::max(1, static_cast<int>(most / rect.width()));
    std::vector<Rect> made;
    for (int y = rect.y0; y < rect.y1; y += rows) {
        made.push_back({rect.x0, y, rect.x1, std::min(y + rows, rect.y1)});
    }
    return made;
}

/// One rectangle of whole blocks of pixels round all of some.
std::vector<Rect> in_blocks(const std::vector<Rect>& rects, const Rect& whole) {
    if (rects.empty()) return rects;
    Rect all = rects.front();
    for (const Rect& rect : rects) all = all.united(rect);
    const auto down = [](int side) { return side / side_of_block * side_of_block; };
    const auto up = [down](int side) { return down(side + side_of_block - 1); };
    return {Rect{down(all.x0), down(all.y0), up(all.x1), up(all.y1)}.intersected(whole)};
}

/// The additional key of nodes that receive shadows.
Key key_of(std::span<const ShadowUse> shadows) {
    Key key;
    for (const ShadowUse& use : shadows) {
        key.add(use.revision);
        key.add(use.shadow.radius);
        key.add(use.shadow.bias);
    }
    return key;
}

}  // namespace

std::vector<NodeTextures> DrawnPicture::look_up_all() {
    std::vector<NodeTextures> lookups(scene.nodes.size());
    plan.for_each([&](const PlannedNode& planned) {
        lookups[planned.node] = lookup.find(scene.nodes[planned.node]);
    });
    return lookups;
}

std::vector<PictureKey> DrawnPicture::keys_of(const std::vector<NodeTextures>& lookups,
                                              const Outputs& outputs) {
    Key common;
    add_grading(common, post_process);
    common.add(post_process.effects.size());
    for (const EffectSnapshot& effect : post_process.effects) {
        common.add(effect.revision);
        for (const TextureSourceSnapshot& texture : effect.textures) {
            common.add(lookup.find(texture).revision);
        }
    }
    common.add(scene.background.index());
    if (const auto* color = std::get_if<glm::vec4>(&scene.background)) common.add(*color);
    const Environment sky = lookup.background();
    common.add(sky.cube.revision);
    if (!sky.placing.is_plain()) {
        for (int i = 0; i < 4; ++i) common.add(sky.placing.rotation[i]);
        common.add(sky.placing.intensity);
    }
    common.add(scene.lights.size());
    for (const LightSnapshot& light : scene.lights) add_light(common, light.value);
    const Key shadow_key = key_of(shadows);
    std::vector<std::size_t> counts(views.size(), 0);
    for (const Visibility& visibility : plan.visibilities) ++counts[visibility.view];

    std::vector<PictureKey> keys(views.size());
    for (std::size_t v = 0; v < views.size(); ++v) {
        const View& view = views[v];
        Key& key = keys[v].common;
        key = common;
        add_view(key, view);
        keys[v].shadows = shadow_key;
        keys[v].nodes.reserve(counts[v]);
    }
    plan.for_each([&](const PlannedNode& planned) {
        const NodeSnapshot& node = scene.nodes[planned.node];
        const NodeTextures& found = lookups[planned.node];
        NodeKey key{node.id,
                    outputs.has(output_row("label")) ? node.label : 0,
                    !shadows.empty() && receive_shadow(node),
                    {},
                    node.revision,
                    node.world,
                    drawn_mesh(node, planned)->revision(),
                    node.material.revision,
                    0,
                    0};
        for (const Visibility& visibility : plan.visible_in(planned)) {
            PictureKey& picture = keys[visibility.view];
            key.bounds = visibility.bounds;
            key.first_texture = static_cast<std::uint32_t>(picture.textures.size());
            found.environment.add_to(picture.textures);
            for (const BoundTexture& texture : found.textures) {
                picture.textures.push_back(texture.revision);
            }
            if (found.behind.texture != 0) picture.textures.push_back(found.behind.revision);
            if (found.screen.depths != 0) {
                picture.textures.push_back(found.screen.picture.revision);
            }
            if (scene.probe_grid && sees_probe_grid(node)) {
                picture.textures.push_back(scene.probe_grid->revision);
            }
            key.texture_count =
                static_cast<std::uint32_t>(picture.textures.size()) - key.first_texture;
            picture.nodes.push_back(key);
        }
    });
    return keys;
}

std::size_t DrawnPicture::draw_changed(Target& target, std::optional<Budget> budget) {
    const std::vector<NodeTextures> lookups = look_up_all();
    std::vector<PictureKey> keys = keys_of(lookups, target.description().outputs);
    const Rect whole{0, 0, target.description().width, target.description().height};
    std::vector<std::vector<Rect>> damaged(views.size());
    std::size_t count = 0;
    std::size_t last = 0;
    const std::size_t first = budget ? budget->first : 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::size_t v = (first + i) % views.size();
        if (!budget || count < budget->views) damaged[v] = damage(target.keys[v], keys[v], whole);
        if (target.description().format == Format::rgb565) {
            // llvmpipe (Mesa 22.3) rounds a pixel otherwise if the scissor cuts its block.
            if (!damaged[v].empty()) damaged[v] = {whole};
        } else if (target.multisampled()) {
            // It also writes samples beyond the edge of the scissor. Those are in no pixel that is
            // resolved now, and are drawn again before one of them is: hence one rectangle.
            damaged[v] = in_blocks(damaged[v], whole);
        }
        if (damaged[v].empty()) {
            ++stats.views_skipped;
            continue;
        }
        last = i + 1;
        ++count;
    }
    if (count == 0) return 0;
    // Until they are drawn, the contents of these layers are not valid.
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (!damaged[v].empty()) target.keys[v].reset();
    }
    draw_damaged(target, damaged, lookups);
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (damaged[v].empty()) continue;
        target.keys[v] = std::move(keys[v]);
        target.revisions[v] = ++gpu.views_drawn;
    }
    return budget ? last : count;
}

void DrawnPicture::draw_shared(Target& target, std::size_t first_layer,
                               const std::vector<bool>& drawn) {
    const Rect whole{0, 0, target.description().width, target.description().height};
    std::vector<std::vector<Rect>> damaged(views.size());
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (drawn[v]) damaged[v] = {whole};
    }
    draw_damaged(target, damaged, look_up_all(), first_layer, true);
}

void DrawnPicture::draw_damaged(Target& target, const std::vector<std::vector<Rect>>& damaged,
                                const std::vector<NodeTextures>& lookups, std::size_t first_layer,
                                bool shared) {
    const Rect whole{0, 0, target.description().width, target.description().height};
    stats.views_drawn += std::count_if(damaged.begin(), damaged.end(),
                                       [](const auto& rects) { return !rects.empty(); });
    // Where all bands have the same bits as the whole, so that large pictures can be interrupted.
    const double most_pixels = gpu.context.software() ? most_pixels_of_a_band : infinity;
    const double most_drawn = target.multisampled() ? infinity : most_pixels;
    std::vector<Region> regions;
    for (std::size_t v = 0; v < views.size(); ++v) {
        for (const Rect& rect : damaged[v]) {
            for (const Rect& band : bands(rect, most_drawn)) regions.push_back({v, band});
        }
    }
    const Environment sky = lookup.background();
    const auto* color = std::get_if<glm::vec4>(&scene.background);
    // Views at one position are drawn together, one position after the other: positions in the
    // shaders count from the view's position, so a picture has the same bits whether other views
    // are drawn in the same call or not.
    while (!regions.empty()) {
        const View& here = views[regions.front().view];
        const auto elsewhere =
            std::stable_partition(regions.begin(), regions.end(), [&](const Region& region) {
                return same_place(here, views[region.view]);
            });
        std::vector<Region> rest(elsewhere, regions.end());
        regions.erase(elsewhere, regions.end());
        gpu.surface.draw({scene, views, plan, std::move(regions),
                          color != nullptr ? BackgroundSource(*color) : BackgroundSource(sky),
                          lookups, shadows, first_layer, shared},
                         target, stats);
        regions = std::move(rest);
    }
    // llvmpipe waits for all samples in the call that begins to resolve them, without looking for
    // signals.
    if (target.multisampled() && gpu.context.software())
        gpu.context.pace().finish(gpu.context.gl());
    const auto textures = lookup.find(post_process.effects);
    for (std::size_t v = 0; v < views.size(); ++v) {
        if (damaged[v].empty()) continue;
        poll_interrupts();
        const auto layer = static_cast<int>(first_layer + v);
        if (target.multisampled()) {
            for (const Rect& rect : damaged[v]) resolve(target, layer, bands(rect, most_pixels));
        }
        if (target.description().post_processed) {
            gpu.post_process.draw(post_process, textures, target, layer, damaged[v], gpu.context,
                                  stats);
        }
    }
    gl::check_gl(gpu.context.gl(), "finishing a picture");
}

void DrawnPicture::resolve(Target& target, int layer, const std::vector<Rect>& rects) {
    const double cost = target.description().samples;
    for (const Rect& rect : rects) {
        target.resolve(layer, rect);
        gpu.context.pace().submitted(gpu.context.gl(), static_cast<double>(rect.area()) * cost);
    }
}

}  // namespace cubecam
