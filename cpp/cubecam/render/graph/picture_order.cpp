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

}  // namespace

bool PictureComponents::in_circle(std::size_t picture, const Edges& edges) const {
    return sizes[of[picture]] > 1 ||
           std::find(edges[picture].begin(), edges[picture].end(), picture) != edges[picture].end();
}

PictureComponents find_components(const Edges& edges) {
    Components components(edges);
    for (std::size_t picture = 0; picture < edges.size(); ++picture) components.visit(picture);
    return {std::move(components.of), std::move(components.sizes)};
}

std::vector<std::size_t> order_pictures(const Edges& edges) {
    std::vector<std::vector<std::size_t>> shown_by(edges.size());
    std::vector<std::size_t> waits_for(edges.size(), 0);
    std::priority_queue<std::size_t, std::vector<std::size_t>, std::greater<>> ready;
    for (std::size_t from = 0; from < edges.size(); ++from) {
        for (const std::size_t to : edges[from]) shown_by[to].push_back(from);
        waits_for[from] = edges[from].size();
        if (waits_for[from] == 0) ready.push(from);
    }
    std::vector<std::size_t> order;
    while (!ready.empty()) {
        const std::size_t next = ready.top();
        ready.pop();
        order.push_back(next);
        for (const std::size_t waiting : shown_by[next]) {
            if (--waits_for[waiting] == 0) ready.push(waiting);
        }
    }
    return order;
}

}  // namespace cubecam
