#pragma once

#include <cstddef>
#include <vector>

namespace cubecam {

/// Which pictures are drawn in a call, and in what order.
struct PictureOrder {
    std::vector<std::size_t> order;       ///< dependencies come before their users
    std::vector<std::size_t> components;  ///< for each picture; the same for all in one circle

    /// Whether `from` must not look at `to`: they depend on each other, and `to` comes first (or is
    /// `from`). Something else then replaces `to`, so that no picture shows contents of an earlier
    /// call.
    ///
    /// The result depends on the pictures' numbers and not on where the search began, so a picture
    /// has the same contents for every root.
    bool is_edge_back(std::size_t from, std::size_t to) const {
        return components[from] == components[to] && to <= from;
    }

    /// Whether a picture depends on itself, directly or through others.
    bool in_circle(std::size_t picture, const std::vector<std::vector<std::size_t>>& edges) const;

    std::vector<std::size_t> sizes;  ///< of each component, by its number in `components`
};

/// Sorts the pictures that `roots` depend on without edges back; `edges[p]` are the pictures that
/// picture p depends on. Of pictures that do not depend on each other, the lower number comes
/// first. R. Tarjan, "Depth-First Search and Linear Graph Algorithms", SIAM J. Comput. 1(2), 1972,
/// and A. B. Kahn, "Topological Sorting of Large Networks", Comm. ACM 5(11), 1962.
PictureOrder order_pictures(const std::vector<std::vector<std::size_t>>& edges,
                            const std::vector<std::size_t>& roots);

}  // namespace cubecam
