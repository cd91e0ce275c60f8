/// Tests the filter that all resampling uses: the average over a box along one axis.

#include "check.hpp"

#include "cubecam/cubemap/box_filter.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

using namespace cubecam;

namespace {

/// The average over a box of a step function that is texels[i] from i - 1/2 to i + 1/2.
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

/// Filters four equal channels, since texels have four.
float filtered(const std::vector<double>& texels, double center, double wide) {
    const BoxTap tap = box_tap(center, BoxWidth(wide));
    const auto texel = [&](int i) {
        const auto value = static_cast<float>(texels[static_cast<std::size_t>(tap.first + i)]);
        return Float4{value, value, value, value};
    };
    const Float4 found = with_reach(reach_of(wide), [&](auto reach) {
        return Float4(apply_tap<decltype(reach)::value>(tap, texel));
    });
    return found[0];
}

}  // namespace

int main() {
    const std::vector<double> texels = {3, -1, 4, 1, -5, 9, 2, 6, 5, 3, 5, 8, 9, 7, 9, 3};
    for (const double wide : {1.0, 1.3, 2.0, 2.7, 5.0, 9.5}) {
        for (double center = 5.0; center < 9.0; center += 0.173) {
            const double got = filtered(texels, center, wide);
            CHECK(std::abs(got - average(texels, center, wide)) < 1e-5);
        }
    }
    // Width 1 is linear interpolation, and narrower boxes get this width.
    CHECK(filtered(texels, 2.25, 1.0) == 3.25F);
    CHECK_EQUAL(BoxWidth(0.2).texels, 1.0);
    // Equal texels give exactly that texel.
    CHECK_EQUAL(filtered(std::vector<double>(16, 0.1), 7.31, 3.7), 0.1F);
    return test::result();
}
