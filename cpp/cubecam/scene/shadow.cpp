#include "cubecam/scene/shadow.hpp"

#include "cubecam/core/checks.hpp"

#include <cmath>
#include <string>

namespace cubecam {

namespace {

constexpr double largest_radius = 16.0;  // a thousand texels for each fragment

}  // namespace

int border_of(const Shadow& shadow) { return static_cast<int>(std::ceil(shadow.radius)) + 2; }

void check(const Shadow& shadow) {
    expect(shadow.radius >= 0.0 && shadow.radius <= largest_radius, "a radius from 0 to 16 texels",
           describe(shadow.radius));
    // At least half of a map's side must lie within its borders.
    const int least = 4 * border_of(shadow);
    expect(shadow.size >= least,
           "a size of at least " + std::to_string(least) + " texels for a radius of " +
               describe(shadow.radius),
           std::to_string(shadow.size));
    expect_not_negative(shadow.bias, "bias");
    expect_positive(shadow.near, "near");
    if (shadow.far) {
        expect_positive(*shadow.far, "far");
        expect(*shadow.far > shadow.near, "near below far",
               "near " + describe(shadow.near) + " and far " + describe(*shadow.far));
    }
    if (shadow.extent) expect_positive(*shadow.extent, "extent");
}

}  // namespace cubecam
