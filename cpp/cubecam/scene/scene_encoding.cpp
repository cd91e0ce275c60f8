#include "cubecam/scene/scene_encoding.hpp"

#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace cubecam {
namespace {

/// Walks over everything that a picture shows until something linear is found.
class EncodingFinder {
public:
    explicit EncodingFinder(const SceneSnapshot& first)
        : first_(first), textures_(first.textures.size(), false) {}

    /// Returns false as soon as anything is linear.
    template <class Seen>
    bool add_scene(std::size_t number, const Seen& seen) {
        const SceneSnapshot& scene = first_.scene(number);
        if (const auto* cube = std::get_if<CubeSnapshot>(&scene.background)) {
            if (!add(cube->data->encoding)) return false;
        } else if (!zeros_and_ones(std::get<glm::vec4>(scene.background))) {
            return false;
        }
        return std::all_of(scene.nodes.begin(), scene.nodes.end(), [&](const NodeSnapshot& node) {
            return !seen(node) || add_node(number, node);
        });
    }

    bool any_srgb() const { return any_srgb_; }

private:
    bool add(Encoding encoding) {
        any_srgb_ = any_srgb_ || encoding == Encoding::srgb;
        return encoding == Encoding::srgb;
    }

    /// A probe may show nodes that the picture itself excludes.
    bool add(std::size_t number, const CubeSourceSnapshot& source) {
        if (const auto* cube = std::get_if<CubeSnapshot>(&source)) return add(cube->data->encoding);
        if (std::holds_alternative<PlanarMirrorIndex>(source)) return add_mirrored(number);
        const SceneSnapshot& scene = first_.scene(number);
        if (std::holds_alternative<ProbeBlendSnapshot>(source) && !add(number, scene.environment)) {
            return false;
        }
        const auto probes = probes_of(source);
        return std::all_of(probes.begin(), probes.end(), [&](std::size_t probe) {
            if (!probes_.emplace(number, probe).second) return true;
            return add_scene(number,
                             [&](const NodeSnapshot& node) { return is_seen(scene, node, probe); });
        });
    }

    /// Planar mirrors may show all that captures show, and the scene's environment.
    bool add_mirrored(std::size_t number) {
        if (!mirrored_.insert(number).second) return true;
        const SceneSnapshot& scene = first_.scene(number);
        return add(number, scene.environment) &&
               add_scene(number, [](const NodeSnapshot& node) { return node.in_captures; });
    }

    /// Two textures of one scene may show different nodes of it.
    bool add(std::size_t, const MapSnapshot& source) {
        if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&source)) {
            return add((*image)->encoding());
        }
        const auto* place = std::get_if<std::size_t>(&source);
        if (place == nullptr || textures_[*place]) return true;
        textures_[*place] = true;
        const RenderTextureSnapshot& texture = first_.textures[*place];
        return add_scene(texture.scene,
                         [&](const NodeSnapshot& node) { return is_seen(texture, node); });
    }

    bool add_node(std::size_t number, const NodeSnapshot& node) {
        const MaterialTraits& traits = node.material.value.traits();
        if (traits.uses_lights) return false;
        // Maps of colours are decoded, so that what they show is linear.
        if (std::any_of(traits.textures.begin(), traits.textures.end(),
                        [](const NamedTexture& texture) { return texture.srgb; })) {
            return false;
        }
        if (traits.vertex_colors != VertexColors::ignored && node.mesh->colors() != nullptr) {
            return false;
        }
        const CubeSourceSnapshot& environment = environment_of(first_.scene(number), node);
        const bool pictured =
            environment.index() != 0 ||
            std::any_of(node.textures.begin(), node.textures.end(),
                        [](const TextureSourceSnapshot& texture) { return !is_none(texture); });
        if (!pictured) return traits.zeros_and_ones;
        return add(number, environment) &&
               std::all_of(node.textures.begin(), node.textures.end(),
                           [&](const TextureSourceSnapshot& texture) {
                               return std::visit(
                                   [&](const auto& source) { return add(number, source); },
                                   texture);
                           });
    }

    const SceneSnapshot& first_;
    std::vector<bool> textures_;                            ///< those that were walked over
    std::set<std::pair<std::size_t, std::size_t>> probes_;  ///< the same, by scene and place
    std::set<std::size_t> mirrored_;  ///< scenes whose planar mirrors were walked over
    bool any_srgb_ = false;
};

}  // namespace

Encoding scene_encoding(const SceneSnapshot& scenes, std::size_t number,
                        const std::function<bool(const NodeSnapshot&)>& seen) {
    EncodingFinder finder(scenes);
    return finder.add_scene(number, seen) && finder.any_srgb() ? Encoding::srgb : Encoding::linear;
}

}  // namespace cubecam
