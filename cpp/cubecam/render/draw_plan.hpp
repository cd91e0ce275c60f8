#pragma once

#include "cubecam/math/rect.hpp"
#include "cubecam/render/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cubecam {

/// One node and the views that may see it.
struct PlannedNode {
    struct Sight {
        std::size_t view;  ///< index into the views planned for
        Rect bounds;       ///< the pixels it can touch there
    };
    std::size_t node;           ///< index into SceneSnapshot::nodes
    std::vector<Sight> sights;  ///< by view, ascending
};

/// What is drawn, in order: opaque nodes near to far, then those of NodeSnapshot::drawn_late far to
/// near.
struct DrawPlan {
    std::vector<PlannedNode> opaque;
    /// Back to front for the views it lists. Views that stand in one place share one sequence;
    /// others follow each other, sequence by sequence, so a node may come several times.
    std::vector<PlannedNode> late;
};

/// For pictures of `width` x `height`: culls every node that `wanted` lets through against every
/// view and sorts what is left, ties by id: the order depends on the scene alone.
DrawPlan make_plan(const SceneSnapshot& scene, std::span<const View> views, int width, int height,
                   const std::function<bool(const NodeSnapshot&)>& wanted);

}  // namespace cubecam
