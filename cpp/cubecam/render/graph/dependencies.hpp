#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// What the pictures of a call need beside themselves: probes and render textures, of all its
/// scenes.
namespace cubecam {

/// Whether a node, or one above it, is among `excluded`.
bool is_excluded(const NodeSnapshot& node, const std::vector<std::int32_t>& excluded);

/// The environment that a node's material looks up: none, the node's own or the scene's.
const CubeSourceSnapshot& environment_of(const SceneSnapshot& scene, const NodeSnapshot& node);

/// Whether a user's own source moves a node's vertices.
bool moves_vertices(const NodeSnapshot& node);

/// Whether shadows show on a node: its material asks the lights.
bool receive_shadow(const NodeSnapshot& node);

/// Whether any light of a scene has a shadow.
bool has_shadows(const SceneSnapshot& scene);

/// The places, among a node's textures, of those that its vertices are moved by.
std::vector<std::size_t> vertex_textures(const NodeSnapshot& node);

/// Whether a probe, or a render texture, of a node's scene sees the node.
bool is_seen(const SceneSnapshot& scene, const NodeSnapshot& node, std::size_t probe);
bool is_seen(const RenderTextureSnapshot& texture, const NodeSnapshot& node);

/// One number for each probe of each scene, in the scenes' order and theirs, and after them for
/// each render texture.
class PictureNumbers {
public:
    explicit PictureNumbers(const SceneSnapshot& asked_for);

    struct Place {
        std::optional<std::size_t> scene;  ///< of a probe; none: a render texture
        std::size_t index;
    };

    std::size_t count() const { return count_; }
    std::size_t of_probe(std::size_t scene, std::size_t probe) const {
        return first_[scene] + probe;
    }
    std::size_t of_texture(std::size_t texture) const { return first_.back() + texture; }
    Place place(std::size_t picture) const;

    /// Adds the pictures that a node of a scene shows.
    void add_needs(const SceneSnapshot& scene, std::size_t number, const NodeSnapshot& node,
                   std::vector<std::size_t>& to) const;
    /// Adds those that the shadows of a scene hang on: by them what casts moves its vertices, in
    /// view or not, and shown elsewhere or not.
    void add_shadow_needs(const SceneSnapshot& scene, std::size_t number,
                          std::vector<std::size_t>& to) const;
    /// Adds those that effects show.
    void add_needs(const std::vector<EffectSnapshot>& effects, std::vector<std::size_t>& to) const;

private:
    void add_needs(std::size_t number, const TextureSourceSnapshot& texture,
                   std::vector<std::size_t>& to) const;
    void add_needs(const MapSnapshot& map, std::vector<std::size_t>& to) const;

    std::vector<std::size_t> first_;  // of each scene's probes, then of the textures
    std::size_t count_;
};

/// Each once, ascending.
std::vector<std::size_t> unique(std::vector<std::size_t> pictures);

/// Whether there may be anything for refuse_circles to find.
bool may_have_circles(const SceneSnapshot& asked_for, const PictureNumbers& numbers);

/// Refuses render textures that show themselves, directly or by others or by probes, among those
/// that the pictures `roots` may lead to; and probes that shadows hang on and that show those
/// shadows. It goes by what the scenes hold and not by what is in
/// view: turning a camera must not make an error appear.
/// @throws std::invalid_argument naming the chain.
void refuse_circles(const SceneSnapshot& asked_for, const PictureNumbers& numbers,
                    const std::vector<std::size_t>& roots);

}  // namespace cubecam
