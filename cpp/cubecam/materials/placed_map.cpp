#include "cubecam/materials/placed_map.hpp"

#include "cubecam/core/checks.hpp"

#include <string>
#include <string_view>

namespace cubecam {

namespace {

void expect_finite_pair(const glm::vec2& pair, std::string_view name) {
    if (fits_float(pair.x) && fits_float(pair.y)) return;
    expect(false, std::string(name).append(" of 2 finite numbers within float32's range"),
           "(" + describe(pair.x) + ", " + describe(pair.y) + ")");
}

}  // namespace

void check(const MapPlacing& placing) {
    expect(placing.uv_set == 0 || placing.uv_set == 1, "uv_set 0 or 1",
           std::to_string(placing.uv_set));
    expect_finite_pair(placing.offset, "offset");
    expect_finite(placing.rotation, "rotation");
    expect_finite_pair(placing.scale, "scale");
}

}  // namespace cubecam
