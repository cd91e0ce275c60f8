#pragma once

#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/key.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace cubecam {

/// All that a node adds to a picture, and the pixels it can touch.
struct NodeKey {
    std::int32_t id;
    Key key;
    Rect bounds;

    bool operator==(const NodeKey&) const = default;
};

/// Everything a view's picture is a function of: what concerns every pixel, and each node drawn, in
/// the order of drawing.
struct PictureKey {
    Key common;
    std::vector<NodeKey> nodes;

    bool operator==(const PictureKey&) const = default;
};

/// Rectangles, at most `max_damage`, that hold every pixel in which the picture of `now` differs
/// from that of `before`; they do not overlap. `whole` if anything differs that concerns every
/// pixel, or if nothing is held yet; none if no pixel differs.
///
/// Outside them the picture is the old one, bit for bit: a pixel hangs on the nodes that cover it,
/// and no node that changed covers it in either picture.
std::vector<Rect> damage(const std::optional<PictureKey>& before, const PictureKey& now,
                         const Rect& whole);

inline constexpr std::size_t max_damage = 4;

}  // namespace cubecam
