#include "cubecam/render/graph/texture_lookup.hpp"

#include "cubecam/render/graph/frame_context.hpp"
#include "cubecam/render/graph/picture_kind.hpp"
#include "cubecam/render/graph/probe_picture.hpp"
#include "cubecam/render/graph/texture_picture.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

namespace cubecam {

TextureLookup::TextureLookup(FrameContext& context, const PictureId& viewer, std::size_t scene)
    : context_(context), viewer_(viewer), number_(scene), scene_(context.scenes.scene(scene)),
      probes_(scene_.probes.size()) {}

BoundTexture TextureLookup::find(const CubeSourceSnapshot& source) {
    return find_environment(source).cube;
}

Environment TextureLookup::find_environment(const CubeSourceSnapshot& source) {
    if (const auto* cube = std::get_if<CubeSnapshot>(&source)) {
        const CubeMapData& data = *cube->data;
        Environment found;
        found.cube = {context_.gpu.cache.cube(*cube).texture.id(), data.revision};
        if (data.mipmaps) {
            found.levels = EnvironmentLevels::mipmaps;
            found.level_count = gl::mip_levels(data.size, data.size);
        }
        return found;
    }
    const auto* probe = std::get_if<std::size_t>(&source);
    return probe == nullptr ? Environment{} : find_probe(*probe);
}

const Environment& TextureLookup::find_probe(std::size_t probe) {
    std::optional<Environment>& known = probes_[probe];
    if (known) return *known;
    const Environment held = context_.probe(number_, probe).environment();
    const bool back = context_.pictures.is_edge_back(viewer_, probe_id(number_, probe));
    if (!back && held.cube.texture != 0) return known.emplace(held);
    // Reached for a mirror in a circle of mirrors, or a manual probe before its first update.
    return known.emplace(std::holds_alternative<CubeSnapshot>(scene_.environment)
                             ? find_environment(scene_.environment)
                             : Environment{});
}

BoundTexture TextureLookup::find(const MapSnapshot& map) {
    if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&map)) {
        return {context_.gpu.cache.image(*image).texture.id(), (*image)->revision()};
    }
    const auto* texture = std::get_if<std::size_t>(&map);
    return texture == nullptr ? BoundTexture{} : context_.texture(*texture).texture();
}

BoundTexture TextureLookup::find(const TextureSourceSnapshot& texture) {
    return std::visit([this](const auto& source) { return find(source); }, texture);
}

NodeTextures TextureLookup::find(const NodeSnapshot& node) {
    NodeTextures found{find_environment(environment_of(scene_, node)), {}};
    for (const TextureSourceSnapshot& texture : node.textures) {
        found.textures.push_back(find(texture));
    }
    return found;
}

std::vector<BoundTexture> TextureLookup::find_for_vertices(const NodeSnapshot& node) {
    std::vector<BoundTexture> found(node.textures.size());
    for (const std::size_t place : vertex_textures(node)) {
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

BoundTexture TextureLookup::background() {
    const auto* cube = std::get_if<CubeSnapshot>(&scene_.background);
    return cube == nullptr ? BoundTexture{} : find(CubeSourceSnapshot(*cube));
}

}  // namespace cubecam
