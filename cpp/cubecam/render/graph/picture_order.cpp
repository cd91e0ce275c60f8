#include "cubecam/render/graph/picture_order.hpp"

#include <algorithm>
#include <limits>

namespace cubecam {
namespace {

constexpr std::size_t unseen = std::numeric_limits<std::size_t>::max();

/// Tarjan's search with a stack of its own: a chain of probes may be long.
class Components {
public:
    explicit Components(const std::vector<std::vector<std::size_t>>& needs)
        : needs_(needs), of(needs.size(), unseen), index_(needs.size(), unseen),
          low_(needs.size(), 0) {}

    void visit(std::size_t root) {
        if (index_[root] != unseen) return;
        enter(root);
        while (!path_.empty()) {
            auto& [probe, next] = path_.back();
            if (next < needs_[probe].size()) {
                const std::size_t needed = needs_[probe][next++];
                if (index_[needed] == unseen) {
                    enter(needed);
                } else if (of[needed] == unseen) {
                    low_[probe] = std::min(low_[probe], index_[needed]);
                }
                continue;
            }
            leave();
        }
    }

private:
    struct Step {
        std::size_t probe;
        std::size_t next;
    };

    void enter(std::size_t probe) {
        index_[probe] = low_[probe] = count_++;
        open_.push_back(probe);
        path_.push_back({probe, 0});
    }

    void leave() {
        const std::size_t probe = path_.back().probe;
        path_.pop_back();
        if (!path_.empty())
            low_[path_.back().probe] = std::min(low_[path_.back().probe], low_[probe]);
        if (low_[probe] != index_[probe]) return;
        for (std::size_t member = unseen; member != probe;) {
            member = open_.back();
            open_.pop_back();
            of[member] = probe;
        }
    }

    const std::vector<std::vector<std::size_t>>& needs_;

public:
    std::vector<std::size_t> of;

private:
    std::vector<std::size_t> index_, low_, open_;
    std::vector<Step> path_;
    std::size_t count_ = 0;
};

}  // namespace

PictureOrder order_pictures(const std::vector<std::vector<std::size_t>>& needs,
                            const std::vector<std::size_t>& roots) {
    Components components(needs);
    for (const std::size_t root : roots) components.visit(root);

    PictureOrder result{{}, std::move(components.of)};
    // Without the edges back nothing goes in circles: a walk that leaves after all it needs gives
    // the order.
    std::vector<bool> seen(needs.size(), false);
    std::vector<std::pair<std::size_t, std::size_t>> path;
    for (const std::size_t root : roots) {
        if (seen[root]) continue;
        seen[root] = true;
        path.emplace_back(root, 0);
        while (!path.empty()) {
            auto& [probe, next] = path.back();
            if (next == needs[probe].size()) {
                result.order.push_back(probe);
                path.pop_back();
                continue;
            }
            const std::size_t needed = needs[probe][next++];
            if (seen[needed] || result.is_edge_back(probe, needed)) continue;
            seen[needed] = true;
            path.emplace_back(needed, 0);
        }
    }
    return result;
}

}  // namespace cubecam
