#include "cubecam/scene/scene_encoding.hpp"

#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace cubecam {
namespace {

/// Walks over everything that a picture shows until something linear is found.
class EncodingFinder {
public:
    explicit EncodingFinder(const SceneSnapshot& first)
        : first_(first), visited_(first.others.size() + 1, false) {}

    /// Returns false as soon as anything is linear.
    template <class Seen>
    bool add_scene(std::size_t number, const Seen& seen) {
        if (visited_[number]) return true;
        visited_[number] = true;
        const SceneSnapshot& scene = first_.scene(number);
        if (const auto* cube = std::get_if<CubeSnapshot>(&scene.background)) {
            if (!add(cube->data->encoding)) return false;
        } else if (!zeros_and_ones(std::get<glm::vec4>(scene.background))) {
            return false;
        }
        return std::all_of(scene.nodes.begin(), scene.nodes.end(), [&](const NodeSnapshot& node) {
            return !seen(node) || add_node(scene, node);
        });
    }

    bool any_srgb() const { return any_srgb_; }

private:
    bool add(Encoding encoding) {
        any_srgb_ = any_srgb_ || encoding == Encoding::srgb;
        return encoding == Encoding::srgb;
    }

    /// A probe shows the scene itself, so that it adds nothing.
    bool add(const CubeSourceSnapshot& source) {
        const auto* cube = std::get_if<CubeSnapshot>(&source);
        return cube == nullptr || add(cube->data->encoding);
    }

    bool add(const MapSnapshot& source) {
        if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&source)) {
            return add((*image)->encoding());
        }
        const auto* place = std::get_if<std::size_t>(&source);
        if (place == nullptr) return true;
        const RenderTextureSnapshot& texture = first_.textures[*place];
        return add_scene(texture.scene,
                         [&](const NodeSnapshot& node) { return is_seen(texture, node); });
    }

    bool add_node(const SceneSnapshot& scene, const NodeSnapshot& node) {
        const MaterialTraits& traits = node.material.value.traits();
        if (traits.uses_lights) return false;
        if (traits.vertex_colors != VertexColors::ignored && node.mesh->colors() != nullptr) {
            return false;
        }
        const CubeSourceSnapshot& environment = environment_of(scene, node);
        const bool pictured =
            environment.index() != 0 ||
            std::any_of(node.textures.begin(), node.textures.end(),
                        [](const TextureSourceSnapshot& texture) { return !is_none(texture); });
        if (!pictured) return traits.zeros_and_ones;
        return add(environment) &&
               std::all_of(node.textures.begin(), node.textures.end(),
                           [this](const TextureSourceSnapshot& texture) {
                               return std::visit([this](const auto& source) { return add(source); },
                                                 texture);
                           });
    }

    const SceneSnapshot& first_;
    std::vector<bool> visited_;
    bool any_srgb_ = false;
};

}  // namespace

Encoding scene_encoding(const SceneSnapshot& scenes, std::size_t number,
                        const std::function<bool(const NodeSnapshot&)>& seen) {
    EncodingFinder finder(scenes);
    return finder.add_scene(number, seen) && finder.any_srgb() ? Encoding::srgb : Encoding::linear;
}

}  // namespace cubecam
