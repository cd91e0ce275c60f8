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

/// Where a node may be visible.
struct Visibility {
    std::uint32_t view;  ///< index into the views of the plan
    Rect bounds;         ///< the pixels it can touch there
};

/// A node and the views that may see it.
struct PlannedNode {
    std::uint32_t node;   ///< index into SceneSnapshot::nodes
    std::uint32_t first;  ///< index into DrawPlan::visibilities
    std::uint32_t count;
    std::uint32_t level = 0;  ///< 0: the mesh; i: its level of detail number i - 1
};

/// What a planned node draws.
inline const std::shared_ptr<const MeshData>& drawn_mesh(const NodeSnapshot& node,
                                                         const PlannedNode& planned) {
    return planned.level == 0 ? node.mesh : (*node.mesh->levels())[planned.level - 1].mesh;
}

/// Whether a pass tests depth or draws each node over the ones before.
enum class DepthMode { by_depth, by_order };

/// The mode of a target with a depth buffer of this format.
inline DepthMode depth_mode(DepthFormat format) {
    return has_depth(format) ? DepthMode::by_depth : DepthMode::by_order;
}

/// The nodes to draw, in order. Nodes with a lower Node::render_order come first; among equal ones:
///  - opaque nodes from near to far, then those of crowds (NodeSnapshot::crowd), crowd by crowd and
///    from near to far in each: one draw call draws a whole crowd;
///  - the nodes for which NodeSnapshot::drawn_as_transparent holds, from far to near.
///
/// Views at one position share one sequence. The sequences of different positions follow each
/// other, so a node may occur several times.
struct DrawPlan {
    DepthMode depth_mode = DepthMode::by_depth;
    std::vector<PlannedNode> opaque;  ///< by_order: all nodes, by render_order and id
    std::vector<PlannedNode> transparent;
    std::vector<Visibility> visibilities;  ///< of each planned node, ascending by view

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

/// Whether two views have the same position, so that distances from them are equal bit for bit.
bool same_place(const View& a, const View& b);

/// Plans pictures of `width` x `height`: culls every node for which `wanted` is true against every
/// view, and sorts the others. The id breaks ties, so the order depends only on the scene and the
/// views. Views at one position show the same level of detail of a node.
/// @param max_lod_error see LevelChoice.
DrawPlan make_plan(const SceneSnapshot& scene, std::span<const View> views, int width, int height,
                   const std::function<bool(const NodeSnapshot&)>& wanted,
                   DepthMode depth_mode = DepthMode::by_depth, double max_lod_error = 0.0);

}  // namespace cubecam
