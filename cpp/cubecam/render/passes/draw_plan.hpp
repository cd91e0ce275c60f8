#pragma once

#include "cubecam/image/depth_format.hpp"
#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace cubecam {

/// Where a node may show.
struct Visibility {
    std::uint32_t view;  ///< index into the views planned for
    Rect bounds;         ///< the pixels it can touch there
};

/// One node and the views that may see it.
struct PlannedNode {
    std::uint32_t node;   ///< index into SceneSnapshot::nodes
    std::uint32_t first;  ///< index into DrawPlan::visibilities
    std::uint32_t count;
};

/// Whether a pass tests depth, or paints one node over the other.
enum class DepthMode { by_depth, by_order };

/// What a target with such a buffer can do.
inline DepthMode depth_mode(DepthFormat format) {
    return has_depth(format) ? DepthMode::by_depth : DepthMode::by_order;
}

/// What is drawn, in order; of nodes that differ in Node's render_order, the lower first:
///  - opaque nodes near to far, after them those of a crowd (NodeSnapshot::crowd), crowd by crowd
///  and
///    near to far in each: all of a crowd become one draw call;
///  - those of NodeSnapshot::drawn_as_transparent, far to near.
///
/// Views that stand in one place share one sequence; others follow each other, sequence by
/// sequence, so a node may come several times.
struct DrawPlan {
    DepthMode depth_mode = DepthMode::by_depth;
    std::vector<PlannedNode> opaque;  ///< by_order: all, by render_order and id
    std::vector<PlannedNode> transparent;
    std::vector<Visibility> visibilities;  ///< of each planned node, by view, ascending

    std::span<const Visibility> visible_in(const PlannedNode& planned) const {
        return {visibilities.data() + planned.first, planned.count};
    }
    /// Calls `visit` with each planned node, in the order of drawing.
    template <class Visit>
    void for_each(Visit&& visit) const {
        for (const PlannedNode& planned : opaque) visit(planned);
        for (const PlannedNode& planned : transparent) visit(planned);
    }
};

/// Whether two views stand in one place, so that distances from them are equal bit for bit.
bool same_place(const View& a, const View& b);

/// For pictures of `width` x `height`: culls every node that `wanted` lets through against every
/// view and sorts what is left, ties by id: the order depends on the scene alone.
DrawPlan make_plan(const SceneSnapshot& scene, std::span<const View> views, int width, int height,
                   const std::function<bool(const NodeSnapshot&)>& wanted,
                   DepthMode depth_mode = DepthMode::by_depth);

}  // namespace cubecam
