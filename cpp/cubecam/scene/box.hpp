#pragma once

#include "cubecam/core/checks.hpp"
#include "cubecam/geometry/mesh_data.hpp"

#include <glm/glm.hpp>

#include <string>
#include <string_view>

namespace cubecam {

/// @throws std::invalid_argument unless the corners of a box that a user gave are finite, and the
/// low one is below the high one on each axis.
inline void expect_box(const Bounds& box, std::string_view name) {
    expect_finite(box.low, name);
    expect_finite(box.high, name);
    expect(glm::all(glm::lessThan(box.low, box.high)),
           std::string(name) + "=(low, high) with low < high on each axis",
           "low " + describe(box.low) + ", high " + describe(box.high));
}

}  // namespace cubecam
