#pragma once

#include "cubecam/render/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace cubecam {

/// One node and the views that may see it (indices into the views planned for, ascending).
struct PlannedNode {
    std::size_t node;  ///< index into SceneSnapshot::nodes
    std::vector<std::size_t> views;
};

/// What is drawn, in order: opaque nodes near to far, then translucent ones far to near.
struct DrawPlan {
    std::vector<PlannedNode> opaque;
    /// Back to front for the views it lists. Views that stand in one place share one sequence;
    /// others follow each other, sequence by sequence, so a node may come several times.
    std::vector<PlannedNode> translucent;
};

/// Culls every node that `wanted` lets through against every view and sorts what is left, ties by
/// id: the order depends on the scene alone.
DrawPlan make_plan(const SceneSnapshot& scene, std::span<const View> views,
                   const std::function<bool(const NodeSnapshot&)>& wanted);

}  // namespace cubecam
