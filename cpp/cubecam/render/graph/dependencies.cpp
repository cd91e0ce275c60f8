#include "cubecam/render/graph/dependencies.hpp"

#include "cubecam/render/graph/picture_kind.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <utility>

namespace cubecam {
namespace {

/// Often many nodes in a row show the same picture.
void add_picture(const PictureId& id, Dependencies& to) {
    if (to.empty() || to.back() != id) to.push_back(id);
}

void add_map(const MapSnapshot& map, Dependencies& to) {
    if (const auto* texture = std::get_if<std::size_t>(&map)) {
        add_picture(texture_id(*texture), to);
    }
}

void add_cube(std::size_t scene, const CubeSourceSnapshot& source, Dependencies& to) {
    if (const auto* probe = std::get_if<std::size_t>(&source)) {
        add_picture(probe_id(scene, *probe), to);
    }
}

void add_source(std::size_t scene, const TextureSourceSnapshot& texture, Dependencies& to) {
    if (const auto* map = std::get_if<MapSnapshot>(&texture)) {
        add_map(*map, to);
    } else {
        add_cube(scene, std::get<CubeSourceSnapshot>(texture), to);
    }
}

}  // namespace

void add_dependencies(const SceneSnapshot& scene, std::size_t number, const NodeSnapshot& node,
                      Dependencies& to) {
    const CubeSourceSnapshot& environment = environment_of(scene, node);
    if (const auto* blend = std::get_if<ProbeBlendSnapshot>(&environment)) {
        for (const std::size_t probe : reaching_probes(scene, node, *blend).probes) {
            add_picture(probe_id(number, probe), to);
        }
    } else {
        add_cube(number, environment, to);
    }
    for (const TextureSourceSnapshot& texture : node.textures) add_source(number, texture, to);
}

void add_dependencies(const std::vector<EffectSnapshot>& effects, Dependencies& to) {
    for (const EffectSnapshot& effect : effects) {
        for (const TextureSourceSnapshot& texture : effect.textures) {
            // An effect belongs to no scene, so it shows no probe.
            if (const auto* map = std::get_if<MapSnapshot>(&texture)) add_map(*map, to);
        }
    }
}

void add_shadows(const SceneSnapshot& scene, std::size_t number, Dependencies& to) {
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (scene.lights[i].value.shadow) to.push_back(shadow_id(number, i));
    }
}

void add_caster_dependencies(const SceneSnapshot& scene, std::size_t number, Dependencies& to) {
    if (!has_shadows(scene)) return;
    for (const NodeSnapshot& node : scene.nodes) {
        if (!casts_shadow(node)) continue;
        for (const std::size_t place : shadow_textures(node)) {
            add_source(number, node.textures[place], to);
        }
    }
}

Dependencies unique(Dependencies pictures) {
    std::sort(pictures.begin(), pictures.end());
    pictures.erase(std::unique(pictures.begin(), pictures.end()), pictures.end());
    return pictures;
}

SceneContents::SceneContents(const SceneSnapshot& scene, std::size_t number) {
    add_shadows(scene, number, shadows_);
    for (const NodeSnapshot& node : scene.nodes) {
        Dependencies pictures;
        add_dependencies(scene, number, node, pictures);
        if (!pictures.empty()) showing_.push_back({&node, std::move(pictures)});
        if (!shadows_.empty() && receive_shadow(node)) receivers_.push_back(&node);
        if (cubecam::shows_behind(node)) transmissive_.push_back(&node);
    }
}

bool SceneContents::shows_behind(const std::function<bool(const NodeSnapshot&)>& wanted) const {
    return std::any_of(transmissive_.begin(), transmissive_.end(),
                       [&wanted](const NodeSnapshot* node) { return wanted(*node); });
}

Dependencies SceneContents::shown(const std::function<bool(const NodeSnapshot&)>& wanted) const {
    Dependencies found;
    for (const Showing& showing : showing_) {
        if (!wanted(*showing.node)) continue;
        found.insert(found.end(), showing.pictures.begin(), showing.pictures.end());
    }
    if (std::any_of(receivers_.begin(), receivers_.end(),
                    [&wanted](const NodeSnapshot* node) { return wanted(*node); })) {
        found.insert(found.end(), shadows_.begin(), shadows_.end());
    }
    return unique(std::move(found));
}

}  // namespace cubecam
