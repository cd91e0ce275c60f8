#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace cubecam {
namespace {

bool has(const std::vector<std::int32_t>& ids, std::int32_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

}  // namespace

bool is_excluded(const NodeSnapshot& node, const std::vector<std::int32_t>& excluded) {
    if (excluded.empty()) return false;
    return has(excluded, node.id) ||
           std::any_of(node.ancestors.begin(), node.ancestors.end(),
                       [&excluded](std::int32_t id) { return has(excluded, id); });
}

std::span<const std::size_t> probes_of(const CubeSourceSnapshot& source) {
    if (const auto* one = std::get_if<std::size_t>(&source)) return {one, 1};
    const auto* blend = std::get_if<ProbeBlendSnapshot>(&source);
    return blend == nullptr ? std::span<const std::size_t>() : *blend->probes;
}

ReachingProbes reaching_probes(const SceneSnapshot& scene, const NodeSnapshot& node,
                               const ProbeBlendSnapshot& blend) {
    ReachingProbes found;
    for (const std::size_t place : *blend.probes) {
        const ProbeValue& probe = scene.probes[place].value;
        const Influence influence = make_influence(probe.influence, probe.parallax.proxy_matrix);
        if (!node.unbounded && !influence.reaches(node.world_bounds)) continue;
        found.probes.push_back(place);
        found.whole = found.whole || influence.everywhere ||
                      (!node.unbounded && influence.contains(node.world_bounds));
    }
    if (found.probes.size() > most_blended_probes) {
        throw std::invalid_argument(
            "node " + std::to_string(node.id) + ": expected at most " +
            std::to_string(most_blended_probes) +
            " probes of its ProbeBlend whose influence reaches it, got " +
            std::to_string(found.probes.size()) +
            ": give them smaller influences or blend distances, or divide the mesh");
    }
    return found;
}

bool uses_probe(const NodeSnapshot& node, std::size_t probe) {
    const auto is_probe = [probe](const CubeSourceSnapshot& source) {
        const auto probes = probes_of(source);
        return std::find(probes.begin(), probes.end(), probe) != probes.end();
    };
    return is_probe(node.environment) ||
           std::any_of(node.textures.begin(), node.textures.end(),
                       [&is_probe](const TextureSourceSnapshot& texture) {
                           const auto* source = std::get_if<CubeSourceSnapshot>(&texture);
                           return source != nullptr && is_probe(*source);
                       });
}

const CubeSourceSnapshot& environment_of(const SceneSnapshot& scene, const NodeSnapshot& node) {
    static const CubeSourceSnapshot none;
    if (!node.material.value.traits().uses_environment) return none;
    return node.environment.index() == 0 ? scene.environment : node.environment;
}

bool moves_vertices(const NodeSnapshot& node) {
    return node.material.value.traits().moves_vertices();
}

bool vertices_see_pictures(const NodeSnapshot& node) {
    if (!moves_vertices(node)) return false;
    const auto is_drawn = [](const auto& source) {
        return std::holds_alternative<std::size_t>(source);
    };
    return !probes_of(node.environment).empty() ||
           std::any_of(node.textures.begin(), node.textures.end(),
                       [&](const TextureSourceSnapshot& t) { return std::visit(is_drawn, t); });
}

bool shows_behind(const NodeSnapshot& node) { return node.material.value.traits().shows_behind; }

bool sees_probe_grid(const NodeSnapshot& node) {
    const MaterialTraits& traits = node.material.value.traits();
    return traits.uses_environment && traits.environment_parts.filtered;
}

bool receive_shadow(const NodeSnapshot& node) {
    return node.receive_shadow && node.material.value.traits().uses_lights;
}

bool casts_shadow(const NodeSnapshot& node) { return node.cast_shadow && !node.translucent; }

bool has_shadows(const SceneSnapshot& scene) {
    return std::any_of(scene.lights.begin(), scene.lights.end(),
                       [](const LightSnapshot& light) { return light.value.shadow.has_value(); });
}

std::optional<std::size_t> mask_texture(const NodeSnapshot& node) {
    const MaterialTraits& traits = node.material.value.traits();
    if (!traits.alpha_mask) return std::nullopt;
    for (std::size_t place = 0; place < node.textures.size(); ++place) {
        if (traits.textures[place].alpha_counts && !is_none(node.textures[place])) return place;
    }
    return std::nullopt;
}

bool has_holes(const NodeSnapshot& node) {
    const MaterialTraits& traits = node.material.value.traits();
    if (!traits.alpha_mask) return false;
    const bool by_vertices =
        traits.vertex_colors != VertexColors::ignored && node.mesh->translucent_colors();
    return by_vertices || mask_texture(node) ||
           traits.alpha_mask->factor < traits.alpha_mask->cutoff;
}

std::vector<std::size_t> shadow_textures(const NodeSnapshot& node) {
    std::vector<std::size_t> found;
    if (const auto mask = mask_texture(node)) found.push_back(*mask);
    if (!moves_vertices(node)) return found;
    const MaterialTraits& traits = node.material.value.traits();
    for (std::size_t place = 0; place < traits.textures.size(); ++place) {
        if (mentions(traits.user_code->vertex->text, traits.textures[place].name)) {
            found.push_back(place);
        }
    }
    return found;
}

bool is_seen(const SceneSnapshot& scene, const NodeSnapshot& node, std::size_t probe) {
    return node.in_captures && !uses_probe(node, probe) &&
           !is_excluded(node, scene.probes[probe].excluded);
}

bool is_seen(const RenderTextureSnapshot& texture, const NodeSnapshot& node) {
    return !is_excluded(node, texture.excluded);
}

}  // namespace cubecam
