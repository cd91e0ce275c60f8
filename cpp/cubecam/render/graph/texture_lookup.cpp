#include "cubecam/render/graph/texture_lookup.hpp"

#include "cubecam/render/graph/frame_context.hpp"
#include "cubecam/render/graph/probe_picture.hpp"
#include "cubecam/render/graph/scene_picture.hpp"
#include "cubecam/render/graph/texture_picture.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

namespace cubecam {

TextureLookup::TextureLookup(FrameContext& context, const PictureId& viewer, std::size_t scene)
    : context_(context), viewer_(viewer), number_(scene), scene_(context.scenes.scene(scene)),
      shown_(scene_.probes.size()) {}

BoundTexture TextureLookup::find(const CubeSourceSnapshot& source) {
    return find_environment(source, {}).cube;
}

Environment TextureLookup::find_environment(const CubeSourceSnapshot& source,
                                            const EnvironmentParts& parts) {
    if (const auto* cube = std::get_if<CubeSnapshot>(&source)) return find_cube(*cube, parts);
    if (const auto* probe = std::get_if<std::size_t>(&source)) {
        const std::optional<PictureId>& picture = shown(*probe);
        return picture ? context_.probe(*picture).environment(parts)
                       : find_scene_environment(parts);
    }
    Environment none;
    none.parts = parts;
    return none;
}

Environment TextureLookup::find_cube(const CubeSnapshot& cube, const EnvironmentParts& parts) {
    const CubeMapData& data = *cube.data;
    RendererState& gpu = context_.gpu;
    Environment found;
    found.cube = {gpu.cache.cube(cube).texture.id(), data.revision};
    found.parts = parts;
    if (data.mipmaps) {
        found.levels = EnvironmentLevels::mipmaps;
        found.level_count = gl::mip_levels(data.size, data.size);
    }
    if (parts.mipmaps) {
        found.box_mipmaps = {gpu.cache.box_mipmaps(cube).texture.id(), data.revision};
    }
    if (parts.filtered || (parts.filtered_if_made && data.levels)) {
        found.filter(gpu.filtered_cubes.get(gpu.context, cube, context_.stats));
    }
    return found;
}

Environment TextureLookup::find_blend(const NodeSnapshot& node, const ProbeBlendSnapshot& blend,
                                      const EnvironmentParts& parts) {
    const ReachingProbes reaching = reaching_probes(scene_, node, blend);
    if (reaching.probes.empty()) return find_scene_environment(parts);
    Environment first = find_environment(reaching.probes.front(), parts);
    if (reaching.whole && reaching.probes.size() == 1) return first;
    auto others = std::make_shared<EnvironmentBlend>();
    for (const std::size_t place : reaching.probes) {
        const ProbeValue& probe = scene_.probes[place].value;
        others->influences.push_back(make_influence(probe.influence, probe.parallax.proxy_matrix));
        if (others->influences.size() > 1) others->others.push_back(find_environment(place, parts));
    }
    others->has_rest = !reaching.whole;
    if (others->has_rest) others->others.push_back(find_scene_environment(parts));
    first.blend = std::move(others);
    return first;
}

Environment TextureLookup::find_scene_environment(const EnvironmentParts& parts) {
    Environment found = find_environment(scene_.environment, parts);
    found.placing = scene_.environment_placing;
    return found;
}

const std::optional<PictureId>& TextureLookup::shown(std::size_t probe) {
    std::optional<std::optional<PictureId>>& known = shown_[probe];
    if (!known) known = context_.shown_probe(viewer_, number_, probe);
    return *known;
}

BoundTexture TextureLookup::find(const MapSnapshot& map, bool colors) {
    if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&map)) {
        return {context_.gpu.cache.image(*image, colors).texture.id(), (*image)->revision()};
    }
    const auto* texture = std::get_if<std::size_t>(&map);
    return texture == nullptr ? BoundTexture{} : context_.texture(*texture).texture(colors);
}

BoundTexture TextureLookup::find(const TextureSourceSnapshot& texture, bool colors) {
    if (const auto* map = std::get_if<MapSnapshot>(&texture)) return find(*map, colors);
    return find(std::get<CubeSourceSnapshot>(texture));
}

NodeTextures TextureLookup::find(const NodeSnapshot& node) {
    const MaterialTraits& material = node.material.value.traits();
    const EnvironmentParts& parts = material.environment_parts;
    NodeTextures found;
    if (material.uses_environment && std::holds_alternative<PlanarMirrorIndex>(node.environment)) {
        found.environment = find_scene_environment(parts);
        const auto planar = context_.scene_picture(viewer_).reflection(node);
        if (planar) found.environment.planar = *planar;
    } else if (material.uses_environment && node.environment.index() == 0) {
        found.environment = find_scene_environment(parts);
    } else {
        const CubeSourceSnapshot& own = environment_of(scene_, node);
        const auto* blend = std::get_if<ProbeBlendSnapshot>(&own);
        found.environment =
            blend != nullptr ? find_blend(node, *blend, parts) : find_environment(own, parts);
    }
    for (std::size_t i = 0; i < node.textures.size(); ++i) {
        found.textures.push_back(find(node.textures[i], material.textures[i].srgb));
    }
    if (material.shows_far_side) found.body = context_.gpu.bodies.get(*node.mesh, context_.stats);
    if (material.shows_behind) found.behind = context_.scene_picture(viewer_).behind();
    if (material.uses_environment && !std::holds_alternative<PlanarMirrorIndex>(node.environment)) {
        found.screen = context_.scene_picture(viewer_).screen();
    }
    return found;
}

std::vector<BoundTexture> TextureLookup::find_for_shadow(const NodeSnapshot& node) {
    std::vector<BoundTexture> found(node.textures.size());
    for (const std::size_t place : shadow_textures(node)) {
        found[place] = find(node.textures[place]);
    }
    return found;
}

std::vector<std::vector<BoundTexture>>
TextureLookup::find(const std::vector<EffectSnapshot>& effects) {
    std::vector<std::vector<BoundTexture>> lookups;
    for (const EffectSnapshot& effect : effects) {
        std::vector<BoundTexture>& found = lookups.emplace_back();
        for (const TextureSourceSnapshot& texture : effect.textures) {
            found.push_back(find(texture));
        }
    }
    return lookups;
}

Environment TextureLookup::background() {
    if (scene_.shows_environment) return find_scene_environment({});
    const auto* cube = std::get_if<CubeSnapshot>(&scene_.background);
    return cube == nullptr ? Environment{} : find_cube(*cube, {});
}

}  // namespace cubecam
