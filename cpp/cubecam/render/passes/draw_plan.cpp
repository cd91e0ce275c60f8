#include "cubecam/render/passes/draw_plan.hpp"

#include "cubecam/render/passes/level_choice.hpp"
#include "cubecam/render/passes/screen_bounds.hpp"

#include <algorithm>
#include <tuple>

namespace cubecam {
namespace {

/// The key by which planned nodes are sorted.
struct SortKey {
    std::int32_t order;
    std::uint32_t crowd;
    double distance;
    PlannedNode planned;
};

double distance_to(const View& view, const glm::dvec3& point) {
    return view.parallel ? glm::dot(point - view.position, view.forward)
                         : glm::distance(point, view.position);
}

/// Nodes are in the order of their ids, so the index breaks ties.
void sort_and_append(std::vector<SortKey>& keys, std::vector<PlannedNode>& to) {
    std::sort(keys.begin(), keys.end(), [](const SortKey& a, const SortKey& b) {
        return std::tie(a.order, a.crowd, a.distance, a.planned.node) <
               std::tie(b.order, b.crowd, b.distance, b.planned.node);
    });
    to.reserve(to.size() + keys.size());
    for (const SortKey& key : keys) to.push_back(key.planned);
}

/// The views at one position, each with its data for culling.
struct Place {
    std::vector<std::uint32_t> views;
    std::vector<Culling> culling;
};

std::vector<Place> places_of(std::span<const View> views) {
    std::vector<Place> places;
    for (std::uint32_t v = 0; v < views.size(); ++v) {
        const auto here = std::find_if(places.begin(), places.end(), [&](const Place& place) {
            return same_place(views[place.views.front()], views[v]);
        });
        Place& place = here == places.end() ? places.emplace_back() : *here;
        place.views.push_back(v);
        place.culling.emplace_back(views[v]);
    }
    return places;
}

}  // namespace

bool same_place(const View& a, const View& b) {
    return a.position == b.position && a.parallel == b.parallel &&
           (!a.parallel || a.forward == b.forward) && a.clip == b.clip;
}

DrawPlan make_plan(const SceneSnapshot& scene, std::span<const View> views, int width, int height,
                   const std::function<bool(const NodeSnapshot&)>& wanted, DepthMode depth_mode,
                   double max_lod_error) {
    const LevelChoice levels(scene, views, {width, height}, max_lod_error);
    DrawPlan plan;
    plan.depth_mode = depth_mode;
    std::vector<SortKey> opaque;
    std::vector<SortKey> transparent;
    // The picture of a view must not depend on views at other positions.
    for (const Place& place : places_of(views)) {
        const View& here = views[place.views.front()];
        opaque.clear();
        transparent.clear();
        for (std::uint32_t index = 0; index < scene.nodes.size(); ++index) {
            const NodeSnapshot& node = scene.nodes[index];
            if (!wanted(node)) continue;
            const auto first = static_cast<std::uint32_t>(plan.visibilities.size());
            for (std::size_t i = 0; i < place.views.size(); ++i) {
                if (node.unbounded) {
                    plan.visibilities.push_back({place.views[i], {0, 0, width, height}});
                } else if (place.culling[i].may_show(node)) {
                    plan.visibilities.push_back(
                        {place.views[i], place.culling[i].screen_bounds(node, width, height)});
                }
            }
            const auto count = static_cast<std::uint32_t>(plan.visibilities.size()) - first;
            if (count == 0) continue;

            SortKey key{node.render_order, 0, 0.0, {index, first, count}};
            key.planned.level = levels.of(node, plan.visible_in(key.planned));
            if (depth_mode == DepthMode::by_order) {
                opaque.push_back(key);
                continue;
            }
            key.distance = distance_to(here, node.world_bounds.center());
            if (node.drawn_as_transparent()) {
                key.distance = -key.distance;
                transparent.push_back(key);
            } else {
                // A draw call has one winding.
                if (node.crowd != 0) key.crowd = 2 * node.crowd + (node.turned ? 1 : 0);
                opaque.push_back(key);
            }
        }
        sort_and_append(opaque, plan.opaque);
        sort_and_append(transparent, plan.transparent);
    }
    return plan;
}

}  // namespace cubecam
