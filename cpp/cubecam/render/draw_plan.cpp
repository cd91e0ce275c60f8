#include "cubecam/render/draw_plan.hpp"

#include "cubecam/math/frustum.hpp"
#include "cubecam/render/screen_bounds.hpp"

#include <algorithm>
#include <limits>

namespace cubecam {
namespace {

struct Seen {
    PlannedNode planned;
    double distance;
};

double distance_to(const View& view, const glm::dvec3& point) {
    return view.parallel ? glm::dot(point - view.position, view.forward)
                         : glm::distance(point, view.position);
}

/// Views are sorted for alike if they stand in one place: then distances are equal, bit for bit.
bool same_order(const View& a, const View& b) {
    return a.position == b.position && a.parallel == b.parallel &&
           (!a.parallel || a.forward == b.forward);
}

}  // namespace

DrawPlan make_plan(const SceneSnapshot& scene, std::span<const View> views, int width, int height,
                   const std::function<bool(const NodeSnapshot&)>& wanted) {
    std::vector<Seen> opaque;
    std::vector<PlannedNode> late;
    for (std::size_t index = 0; index < scene.nodes.size(); ++index) {
        const NodeSnapshot& node = scene.nodes[index];
        if (!wanted(node)) continue;
        PlannedNode planned{index, {}};
        for (std::size_t v = 0; v < views.size(); ++v) {
            const glm::dvec4 error = clip_error(views[v], node);
            const Bounds& bounds = node.world_bounds;
            if (node.unbounded) {
                planned.sights.push_back({v, {0, 0, width, height}});
                continue;
            }
            if (!may_show(views[v].view_projection, bounds.low, bounds.high, error)) continue;
            planned.sights.push_back({v, screen_bounds(views[v], bounds, error, width, height)});
        }
        if (planned.sights.empty()) continue;
        if (node.drawn_late()) {
            late.push_back(std::move(planned));
            continue;
        }
        // Of all views, also those that do not see it: what one view draws must not hang on which
        // others are drawn.
        double nearest = std::numeric_limits<double>::infinity();
        for (const View& view : views)
            nearest = std::min(nearest, distance_to(view, node.world_bounds.centre()));
        opaque.push_back({std::move(planned), nearest});
    }

    DrawPlan plan;
    // Nodes come in order of id, so a stable sort breaks ties by id.
    std::stable_sort(opaque.begin(), opaque.end(),
                     [](const Seen& a, const Seen& b) { return a.distance < b.distance; });
    plan.opaque.reserve(opaque.size());
    for (Seen& seen : opaque) plan.opaque.push_back(std::move(seen.planned));
    if (late.empty()) return plan;

    std::vector<bool> done(views.size(), false);
    for (std::size_t first = 0; first < views.size(); ++first) {
        if (done[first]) continue;
        std::vector<Seen> sequence;
        for (const PlannedNode& planned : late) {
            PlannedNode part{planned.node, {}};
            for (const PlannedNode::Sight& sight : planned.sights) {
                if (same_order(views[first], views[sight.view])) part.sights.push_back(sight);
            }
            if (part.sights.empty()) continue;
            const glm::dvec3 centre = scene.nodes[planned.node].world_bounds.centre();
            sequence.push_back({std::move(part), distance_to(views[first], centre)});
        }
        std::stable_sort(sequence.begin(), sequence.end(),
                         [](const Seen& a, const Seen& b) { return a.distance > b.distance; });
        for (Seen& seen : sequence) plan.late.push_back(std::move(seen.planned));
        for (std::size_t v = first; v < views.size(); ++v) {
            if (same_order(views[first], views[v])) done[v] = true;
        }
    }
    return plan;
}

}  // namespace cubecam
