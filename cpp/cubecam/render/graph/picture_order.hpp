#pragma once

#include <cstddef>
#include <vector>

namespace cubecam {

/// Which pictures are drawn in a call, and in what order.
struct PictureOrder {
    std::vector<std::size_t> order;       ///< what a picture depends on comes before it
    std::vector<std::size_t> components;  ///< of each picture; those in one circle share one

    /// Whether `from` must not look at `to`: they depend on each other, and `to` comes first (or is
    /// `from`). There something else stands in, so no picture shows what was drawn in an earlier
    /// call.
    ///
    /// It depends on the pictures' numbers and not on where the search began, so a picture is the
    /// same whatever it is drawn for.
    bool is_edge_back(std::size_t from, std::size_t to) const {
        return components[from] == components[to] && to <= from;
    }

    /// Whether a picture depends on itself, directly or by others.
    bool in_circle(std::size_t picture, const std::vector<std::vector<std::size_t>>& edges) const;

    std::vector<std::size_t> sizes;  ///< of each component, at the place of its name
};

/// `edges[p]` are the pictures that picture p depends on. Only those reachable from `roots` without
/// edges back are ordered: of pictures that do not depend on each other, the lower number first.
/// R. Tarjan, "Depth-First Search and Linear Graph Algorithms", SIAM J. Comput. 1(2), 1972, and
/// A. B. Kahn, "Topological Sorting of Large Networks", Comm. ACM 5(11), 1962.
PictureOrder order_pictures(const std::vector<std::vector<std::size_t>>& edges,
                            const std::vector<std::size_t>& roots);

}  // namespace cubecam
