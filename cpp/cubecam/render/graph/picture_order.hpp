#pragma once

#include <cstddef>
#include <vector>

namespace cubecam {

/// Which pictures depend on each other, directly or through others.
struct PictureComponents {
    std::vector<std::size_t> of;     ///< for each picture; the same for all in one circle
    std::vector<std::size_t> sizes;  ///< of each component, by its number in `of`

    /// Whether a picture depends on itself, directly or through others.
    bool in_circle(std::size_t picture, const std::vector<std::vector<std::size_t>>& edges) const;
};

/// Finds the circles of pictures; `edges[p]` are the pictures that picture p depends on.
/// R. Tarjan, "Depth-First Search and Linear Graph Algorithms", SIAM J. Comput. 1(2), 1972.
PictureComponents find_components(const std::vector<std::vector<std::size_t>>& edges);

/// Sorts pictures so that dependencies come before their users. Of pictures that do not depend on
/// each other, the lower number comes first, so that the order is the same wherever the search for
/// the pictures began. Pictures in circles, and those that depend on them, are not in the result.
/// A. B. Kahn, "Topological Sorting of Large Networks", Comm. ACM 5(11), 1962.
std::vector<std::size_t> order_pictures(const std::vector<std::vector<std::size_t>>& edges);

}  // namespace cubecam
