#pragma once

#include <cstddef>
#include <vector>

namespace cubecam {

/// Which probes are drawn in a call, and in what order.
struct PictureOrder {
    std::vector<std::size_t> order;       ///< what a probe needs comes before it
    std::vector<std::size_t> components;  ///< of each probe; probes that need each other share one

    /// Whether `from` must not look at `to`: they need each other, and `to` comes first (or is
    /// `from`). There the scene's environment stands in, so no picture shows what was drawn in an
    /// earlier call.
    ///
    /// It hangs on the probes' order in the scene and not on where the search began, so a probe's
    /// picture is the same whatever frame asks for it.
    bool is_edge_back(std::size_t from, std::size_t to) const {
        return components[from] == components[to] && to <= from;
    }
};

/// `needs[p]` are the probes that probe p shows; only those reachable from `roots` are ordered.
/// R. Tarjan, "Depth-First Search and Linear Graph Algorithms", SIAM J. Comput. 1(2), 1972.
PictureOrder order_pictures(const std::vector<std::vector<std::size_t>>& needs,
                            const std::vector<std::size_t>& roots);

}  // namespace cubecam
