#pragma once

#include <algorithm>
#include <memory>
#include <vector>

namespace cubecam {

class Node;

/// References to nodes that do not keep the nodes alive.
using WeakNodes = std::vector<std::weak_ptr<Node>>;

/// Whether both refer to the same node, even if it is destroyed.
inline bool same_node(const std::weak_ptr<Node>& a, const std::weak_ptr<Node>& b) {
    return !a.owner_before(b) && !b.owner_before(a);
}

inline bool same_nodes(const WeakNodes& a, const WeakNodes& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), same_node);
}

}  // namespace cubecam
