#pragma once

#include "cubecam/image/depth_format.hpp"
#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cubecam {

/// One node and the views that may see it.
struct PlannedNode {
    struct Visibility {
        std::size_t view;  ///< index into the views planned for
        Rect bounds;       ///< the pixels it can touch there
    };
    std::size_t node;                      ///< index into SceneSnapshot::nodes
    std::vector<Visibility> visibilities;  ///< by view, ascending
};

/// Whether a pass tests depth, or paints one node over the other.
enum class DepthMode { by_depth, by_order };

/// What a target with such a buffer can do.
inline DepthMode depth_mode(DepthFormat format) {
    return has_depth(format) ? DepthMode::by_depth : DepthMode::by_order;
}

/// What is drawn, in order: opaque nodes near to far, then those of
/// NodeSnapshot::drawn_as_transparent far to near; of nodes that differ in Node's render_order, the
/// lower first.
///
/// Views that stand in one place share one sequence; others follow each other, sequence by
/// sequence, so a node may come several times.
struct DrawPlan {
    DepthMode depth_mode = DepthMode::by_depth;
    std::vector<PlannedNode> opaque;  ///< by_order: all, by render_order and id
    std::vector<PlannedNode> transparent;
};

/// Whether two views stand in one place, so that distances from them are equal bit for bit.
bool same_place(const View& a, const View& b);

/// For pictures of `width` x `height`: culls every node that `wanted` lets through against every
/// view and sorts what is left, ties by id: the order depends on the scene alone.
DrawPlan make_plan(const SceneSnapshot& scene, std::span<const View> views, int width, int height,
                   const std::function<bool(const NodeSnapshot&)>& wanted,
                   DepthMode depth_mode = DepthMode::by_depth);

}  // namespace cubecam
