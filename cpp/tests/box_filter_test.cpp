/// The filter of all resampling: the average over a box along one axis.

#include "check.hpp"

#include "cubecam/cubemap/box_filter.hpp"

#include <cmath>
#include <vector>

using namespace cubecam;

namespace {

/// The integral of steps texels[i] from i - 1/2 to i + 1/2 over a box, divided by its width.
double average(const std::vector<double>& texels, double center, double wide) {
    const double begin = center + 0.5 - wide / 2;
    const double end = center + 0.5 + wide / 2;
    double sum = 0;
    for (std::size_t i = 0; i < texels.size(); ++i) {
        const auto low = static_cast<double>(i);
        sum += texels[i] * std::max(0.0, std::min(end, low + 1) - std::max(begin, low));
    }
    return sum / wide;
}

double filtered(const std::vector<double>& texels, double center, double wide) {
    const BoxTap tap = box_tap(center, BoxWidth(wide));
    const auto texel = [&](int i) { return texels[static_cast<std::size_t>(tap.first + i)]; };
    return with_reach(reach_of(wide), [&](auto reach) {
        return static_cast<double>(apply_tap<decltype(reach)::value>(tap, texel));
    });
}

}  // namespace

int main() {
    const std::vector<double> texels = {3, -1, 4, 1, -5, 9, 2, 6, 5, 3, 5, 8, 9, 7, 9, 3};
    for (const double wide : {1.0, 1.3, 2.0, 2.7, 5.0, 9.5}) {
        for (double center = 5.0; center < 9.0; center += 0.173) {
            CHECK(std::abs(filtered(texels, center, wide) - average(texels, center, wide)) < 1e-5);
        }
    }
    // Width 1 is linear interpolation; narrower boxes are no narrower than that.
    CHECK(std::abs(filtered(texels, 2.25, 1.0) - (0.75 * 4 + 0.25 * 1)) < 1e-6);
    CHECK_EQUAL(BoxWidth(0.2).texels, 1.0);
    // Equal texels give exactly that texel.
    CHECK_EQUAL(filtered(std::vector<double>(16, 0.1), 7.31, 3.7), 0.1);
    return test::result();
}
