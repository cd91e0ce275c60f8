#pragma once

#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/key.hpp"
#include "cubecam/render/resources/view.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cubecam {

/// All that a node adds to a picture, and the pixels it can touch. What it looks up stands in the
/// picture's list of textures.
struct NodeKey {
    std::int32_t id;
    bool receive_shadow;
    Rect bounds;
    std::uint64_t revision;  ///< NodeSnapshot::revision; equal ones need no further look
    glm::dmat4 world;
    std::uint64_t mesh;  ///< revisions
    std::uint64_t material;
    std::uint32_t first_texture;
    std::uint32_t texture_count;
};

/// Adds all that a picture depends on of the view it is taken with.
void add_view(Key& key, const View& view);

/// Everything a view's picture is a function of: what concerns every pixel, and each node drawn, in
/// the order of drawing.
struct PictureKey {
    Key common;
    Key shadows;  ///< what the pixels of nodes that receive shadows depend on besides
    std::vector<NodeKey> nodes;
    std::vector<std::uint64_t> textures;  ///< revisions of what the nodes look up

    std::span<const std::uint64_t> textures_of(const NodeKey& node) const {
        return {textures.data() + node.first_texture, node.texture_count};
    }
};

/// Rectangles, at most `max_damage`, that hold every pixel in which the picture of `now` differs
/// from that of `before`; they do not overlap. `whole` if anything differs that concerns every
/// pixel, or if nothing is held yet; none if no pixel differs.
///
/// Outside them the picture is the old one, bit for bit: a pixel depends on the nodes that cover
/// it, and no node that changed covers it in either picture.
std::vector<Rect> damage(const std::optional<PictureKey>& before, const PictureKey& now,
                         const Rect& whole);

inline constexpr std::size_t max_damage = 4;

}  // namespace cubecam
