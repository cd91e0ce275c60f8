#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <vector>

namespace cubecam {

/// Sets NodeSnapshot::crowd. Crowds are numbered in the order of their first nodes. The result does
/// not depend on the order of addresses, which only distinguish looks.
void find_crowds(std::vector<NodeSnapshot>& nodes);

}  // namespace cubecam
