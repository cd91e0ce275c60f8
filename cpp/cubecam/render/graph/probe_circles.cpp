#include "cubecam/render/graph/probe_circles.hpp"

#include "cubecam/render/graph/picture_order.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <numeric>

namespace cubecam {
namespace {

using Places = std::vector<std::size_t>;

void sort_once(Places& places) {
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
}

/// The probes that a node's material may look up: all of a blend, so that circles do not change
/// where nodes move.
Places looked_up(const SceneSnapshot& scene, const NodeSnapshot& node) {
    Places probes;
    const auto add = [&probes](const CubeSourceSnapshot& source) {
        const auto found = probes_of(source);
        probes.insert(probes.end(), found.begin(), found.end());
    };
    add(environment_of(scene, node));
    for (const TextureSourceSnapshot& texture : node.textures) {
        if (const auto* source = std::get_if<CubeSourceSnapshot>(&texture)) add(*source);
    }
    sort_once(probes);
    return probes;
}

/// Whether no probe but this one leaves the node out, unless by `exclude`.
bool uses_no_other(const NodeSnapshot& node, std::size_t probe) {
    const auto is_other = [probe](const CubeSourceSnapshot& source) {
        const auto places = probes_of(source);
        return std::any_of(places.begin(), places.end(),
                           [probe](std::size_t place) { return place != probe; });
    };
    return !is_other(node.environment) &&
           std::none_of(node.textures.begin(), node.textures.end(),
                        [&is_other](const TextureSourceSnapshot& texture) {
                            const auto* source = std::get_if<CubeSourceSnapshot>(&texture);
                            return source != nullptr && is_other(*source);
                        });
}

/// Whether a probe's picture may show a node. A planar mirror in it also shows the nodes that use
/// the probe; such a node has a blend, or it would only lead back to its own probe.
bool may_show(const SceneSnapshot& scene, const NodeSnapshot& node, std::size_t probe) {
    if (scene.planar_mirrors.empty()) return is_seen(scene, node, probe);
    return node.in_captures && !is_excluded(node, scene.probes[probe].excluded);
}

/// For each probe: the probes that its picture may show.
///
/// Most probes exclude nothing, and most nodes use one probe. Such probes see such nodes by way of
/// one more vertex, the last one, so that a thousand mirrors have two thousand edges and not a
/// million. It adds no circle: its only new way leads from a probe to itself.
std::vector<Places> edges_of(const SceneSnapshot& scene) {
    const std::size_t count = scene.probes.size();
    std::vector<Places> edges(count + 1);
    Places all(count);
    std::iota(all.begin(), all.end(), 0);
    Places excluding;
    for (const std::size_t probe : all) {
        if (scene.probes[probe].excluded.empty()) {
            edges[probe].push_back(count);
        } else {
            excluding.push_back(probe);
        }
    }
    for (const NodeSnapshot& node : scene.nodes) {
        if (!node.in_captures) continue;
        const Places shown = looked_up(scene, node);
        if (shown.empty()) continue;
        const bool simple = shown.size() == 1 && uses_no_other(node, shown.front());
        if (simple) edges[count].push_back(shown.front());
        for (const std::size_t probe : simple ? excluding : all) {
            if (!may_show(scene, node, probe)) continue;
            edges[probe].insert(edges[probe].end(), shown.begin(), shown.end());
        }
    }
    for (Places& to : edges) sort_once(to);
    return edges;
}

}  // namespace

ProbeCircles::ProbeCircles(const SceneSnapshot& scene) {
    const std::size_t count = scene.probes.size();
    const std::vector<Places> edges = edges_of(scene);
    circle_ = find_components(edges).of;
    Places sizes(edges.size(), 0);  // in probes, without the vertex between them
    for (std::size_t probe = 0; probe < count; ++probe) ++sizes[circle_[probe]];
    levels_.assign(edges.size(), 1);
    for (std::size_t probe = 0; probe < count; ++probe) {
        std::size_t& levels = levels_[circle_[probe]];
        const auto bounces = static_cast<std::size_t>(scene.probes[probe].value.bounces);
        if (sizes[circle_[probe]] > 1) levels = std::max(levels, bounces);
    }
}

bool ProbeCircles::together(std::size_t first, std::size_t second) const {
    return circle_[first] == circle_[second];
}

}  // namespace cubecam
