#include "cubecam/render/passes/draw_plan.hpp"

#include "cubecam/math/frustum.hpp"
#include "cubecam/render/passes/screen_bounds.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace cubecam {
namespace {

struct Seen {
    PlannedNode planned;
    std::int32_t order;
    double distance;
};

double distance_to(const View& view, const glm::dvec3& point) {
    return view.parallel ? glm::dot(point - view.position, view.forward)
                         : glm::distance(point, view.position);
}

/// Nodes come in order of id, so a stable sort breaks ties by id.
template <class Before>
void append_sorted(std::vector<Seen>& seen, std::vector<PlannedNode>& to, Before before) {
    std::stable_sort(seen.begin(), seen.end(), [before](const Seen& a, const Seen& b) {
        return a.order != b.order ? a.order < b.order : before(a, b);
    });
    for (Seen& node : seen) to.push_back(std::move(node.planned));
}

}  // namespace

bool same_place(const View& a, const View& b) {
    return a.position == b.position && a.parallel == b.parallel &&
           (!a.parallel || a.forward == b.forward);
}

DrawPlan make_plan(const SceneSnapshot& scene, std::span<const View> views, int width, int height,
                   const std::function<bool(const NodeSnapshot&)>& wanted, DepthMode depth_mode) {
    std::vector<PlannedNode> all;
    for (std::size_t index = 0; index < scene.nodes.size(); ++index) {
        const NodeSnapshot& node = scene.nodes[index];
        if (!wanted(node)) continue;
        PlannedNode planned{index, {}};
        for (std::size_t v = 0; v < views.size(); ++v) {
            const glm::dvec4 error = clip_error(views[v], node);
            const Bounds& bounds = node.world_bounds;
            if (node.unbounded) {
                planned.visibilities.push_back({v, {0, 0, width, height}});
                continue;
            }
            if (!may_show(views[v].view_projection, bounds.low, bounds.high, error)) continue;
            planned.visibilities.push_back(
                {v, screen_bounds(views[v], bounds, error, width, height)});
        }
        if (!planned.visibilities.empty()) all.push_back(std::move(planned));
    }

    DrawPlan plan;
    plan.depth_mode = depth_mode;
    plan.opaque.reserve(all.size());
    const bool one_place = std::all_of(views.begin(), views.end(), [&views](const View& view) {
        return same_place(views.front(), view);
    });
    std::vector<bool> done(views.size(), false);
    for (std::size_t first = 0; first < views.size(); ++first) {
        if (done[first]) continue;
        // What a view draws must not hang on views that stand elsewhere.
        for (std::size_t v = first; v < views.size(); ++v) {
            if (same_place(views[first], views[v])) done[v] = true;
        }
        std::vector<Seen> opaque;
        std::vector<Seen> transparent;
        for (PlannedNode& planned : all) {
            PlannedNode part{planned.node, {}};
            if (one_place) {
                part.visibilities.swap(planned.visibilities);
            } else {
                for (const PlannedNode::Visibility& visibility : planned.visibilities) {
                    if (same_place(views[first], views[visibility.view]))
                        part.visibilities.push_back(visibility);
                }
            }
            if (part.visibilities.empty()) continue;
            const NodeSnapshot& node = scene.nodes[planned.node];
            const double distance = distance_to(views[first], node.world_bounds.center());
            const bool later = node.drawn_as_transparent() && depth_mode == DepthMode::by_depth;
            (later ? transparent : opaque)
                .push_back({std::move(part), node.render_order, distance});
        }
        if (depth_mode == DepthMode::by_order) {
            append_sorted(opaque, plan.opaque, [](const Seen&, const Seen&) { return false; });
            continue;
        }
        append_sorted(opaque, plan.opaque,
                      [](const Seen& a, const Seen& b) { return a.distance < b.distance; });
        append_sorted(transparent, plan.transparent,
                      [](const Seen& a, const Seen& b) { return a.distance > b.distance; });
    }
    return plan;
}

}  // namespace cubecam
