#include "cubecam/render/screen_bounds.hpp"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cubecam {
namespace {

/// The GPU computes in float and covers a pixel from its centre or its samples.
constexpr double margin = 2.0;

int clamped(double pixel, int size) {
    return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(size)));
}

}  // namespace

Rect screen_bounds(const View& view, const Bounds& bounds, int width, int height) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(infinity);
    glm::dvec2 high(-infinity);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 point((corner & 1) != 0 ? bounds.high.x : bounds.low.x,
                               (corner & 2) != 0 ? bounds.high.y : bounds.low.y,
                               (corner & 4) != 0 ? bounds.high.z : bounds.low.z, 1.0);
        const glm::dvec4 clip = view.view_projection * point;
        // Beside or behind the eye a corner's projection bounds nothing.
        const double size = std::max({std::abs(clip.x), std::abs(clip.y), std::abs(clip.z)});
        if (!(clip.w > 1e-4 * size)) return {0, 0, width, height};
        const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
        low = glm::min(low, ndc);
        high = glm::max(high, ndc);
    }
    const glm::dvec2 size(width, height);
    const glm::dvec2 first = (low * 0.5 + 0.5) * size - margin;
    const glm::dvec2 last = (high * 0.5 + 0.5) * size + margin;
    return {clamped(std::floor(first.x), width), clamped(std::floor(first.y), height),
            clamped(std::ceil(last.x), width), clamped(std::ceil(last.y), height)};
}

}  // namespace cubecam
