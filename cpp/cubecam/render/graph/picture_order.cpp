#include "cubecam/render/graph/picture_order.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <queue>

namespace cubecam {
namespace {

constexpr std::size_t unseen = std::numeric_limits<std::size_t>::max();

using Edges = std::vector<std::vector<std::size_t>>;

/// Tarjan's search, with its own stack instead of recursion: a chain of pictures may be long.
class Components {
public:
    explicit Components(const Edges& edges)
        : of(edges.size(), unseen), sizes(edges.size(), 0), edges_(edges),
          index_(edges.size(), unseen), low_(edges.size(), 0) {}

    void visit(std::size_t root) {
        if (index_[root] != unseen) return;
        enter(root);
        while (!path_.empty()) {
            auto& [picture, next] = path_.back();
            if (next < edges_[picture].size()) {
                const std::size_t shown = edges_[picture][next++];
                if (index_[shown] == unseen) {
                    enter(shown);
                } else if (of[shown] == unseen) {
                    low_[picture] = std::min(low_[picture], index_[shown]);
                }
                continue;
            }
            leave();
        }
    }

    std::vector<std::size_t> of;
    std::vector<std::size_t> sizes;

private:
    struct Step {
        std::size_t picture;
        std::size_t next;
    };

    void enter(std::size_t picture) {
        index_[picture] = low_[picture] = count_++;
        open_.push_back(picture);
        path_.push_back({picture, 0});
    }

    void leave() {
        const std::size_t picture = path_.back().picture;
        path_.pop_back();
        if (!path_.empty()) {
            low_[path_.back().picture] = std::min(low_[path_.back().picture], low_[picture]);
        }
        if (low_[picture] != index_[picture]) return;
        for (std::size_t member = unseen; member != picture;) {
            member = open_.back();
            open_.pop_back();
            of[member] = picture;
            ++sizes[picture];
        }
    }

    const Edges& edges_;
    std::vector<std::size_t> index_, low_, open_;
    std::vector<Step> path_;
    std::size_t count_ = 0;
};

/// The pictures that `roots` depend on without edges back.
std::vector<std::size_t> drawn_from(const PictureOrder& order, const Edges& edges,
                                    const std::vector<std::size_t>& roots) {
    std::vector<bool> seen(edges.size(), false);
    std::vector<std::size_t> reached;
    const auto reach = [&](std::size_t picture) {
        if (!seen[picture]) reached.push_back(picture);
        seen[picture] = true;
    };
    for (const std::size_t root : roots) reach(root);
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const std::size_t from = reached[i];
        for (const std::size_t to : edges[from]) {
            if (!order.is_edge_back(from, to)) reach(to);
        }
    }
    return reached;
}

}  // namespace

bool PictureOrder::in_circle(std::size_t picture, const Edges& edges) const {
    if (components[picture] == unseen) return false;
    return sizes[components[picture]] > 1 ||
           std::find(edges[picture].begin(), edges[picture].end(), picture) != edges[picture].end();
}

PictureOrder order_pictures(const Edges& edges, const std::vector<std::size_t>& roots) {
    Components components(edges);
    for (const std::size_t root : roots) components.visit(root);
    PictureOrder result{{}, std::move(components.of), std::move(components.sizes)};

    // Without the edges back there are no circles.
    const std::vector<std::size_t> drawn = drawn_from(result, edges, roots);
    std::vector<std::vector<std::size_t>> shown_by(edges.size());
    std::vector<std::size_t> waits_for(edges.size(), 0);
    for (const std::size_t from : drawn) {
        for (const std::size_t to : edges[from]) {
            if (result.is_edge_back(from, to)) continue;
            shown_by[to].push_back(from);
            ++waits_for[from];
        }
    }
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    for (const std::size_t picture : drawn) {
        if (waits_for[picture] == 0) ready.push(picture);
    }
    while (!ready.empty()) {
        const std::size_t next = ready.top();
        ready.pop();
        result.order.push_back(next);
        for (const std::size_t waiting : shown_by[next]) {
            if (--waits_for[waiting] == 0) ready.push(waiting);
        }
    }
    return result;
}

}  // namespace cubecam
