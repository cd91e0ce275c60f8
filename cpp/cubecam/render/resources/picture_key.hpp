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

/// The values by which a node contributes to a picture, and the pixels that it can touch. The
/// textures that it looks up are in the picture's list.
struct NodeKey {
    std::int32_t id;
    std::int32_t label;  ///< 0 in pictures without the output "label"
    bool receive_shadow;
    Rect bounds;
    std::uint64_t revision;  ///< NodeSnapshot::revision; equal revisions need no further comparison
    glm::dmat4 world;
    std::uint64_t mesh;  ///< revisions
    std::uint64_t material;
    std::uint32_t first_texture;
    std::uint32_t texture_count;
};

/// Adds the properties of a view on which its picture depends.
void add_view(Key& key, const View& view);

/// All values on which a view's picture depends: those that concern every pixel, and each drawn
/// node, in the order of drawing.
struct PictureKey {
    Key common;
    Key shadows;  ///< the additional key of nodes that receive shadows
    std::vector<NodeKey> nodes;
    std::vector<std::uint64_t> textures;  ///< revisions of the textures that the nodes look up

    std::span<const std::uint64_t> textures_of(const NodeKey& node) const {
        return {textures.data() + node.first_texture, node.texture_count};
    }
};

/// Returns at most `max_damage` rectangles that do not overlap and contain every pixel in which the
/// picture of `now` differs from that of `before`. The result is `whole` if a common value differs
/// or there is no picture yet, and empty if no pixel differs.
///
/// Outside the rectangles the two pictures are equal bit for bit: a pixel depends on the nodes that
/// cover it, and no changed node covers it in either picture.
std::vector<Rect> damage(const std::optional<PictureKey>& before, const PictureKey& now,
                         const Rect& whole);

inline constexpr std::size_t max_damage = 4;

}  // namespace cubecam
