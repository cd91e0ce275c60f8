#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <vector>

namespace cubecam {

/// Sets NodeSnapshot::crowd. Crowds are numbered in the order of their first node: addresses tell
/// looks apart, and decide nothing else.
void find_crowds(std::vector<NodeSnapshot>& nodes);

}  // namespace cubecam
