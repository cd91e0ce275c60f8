#include "cubecam/render/passes/screen_bounds.hpp"

#include "cubecam/math/frustum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cubecam {
namespace {

/// A pixel is covered from its center or its samples, and rasterisers snap vertices to a fraction
/// of it.
constexpr double margin = 2.0;

/// Rounding of matrices and of a product of four terms, with room to spare: in units of what the
/// terms' sizes add up to (N. Higham, "Accuracy and Stability of Numerical Algorithms",
/// section 3.1).
constexpr double rounding = 8.0 / (1 << 24);

int clamped(double pixel, int size) {
    return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(size)));
}

}  // namespace

glm::dvec4 clip_error(const View& view, const NodeSnapshot& node) {
    // As the shader works: local to the world seen from the view's position, then to clip space.
    const glm::dvec3 local = glm::max(glm::abs(node.bounds.low), glm::abs(node.bounds.high));
    glm::dvec3 size = glm::abs(glm::dvec3(node.world[3]) - view.position);
    for (int axis = 0; axis < 3; ++axis)
        size += glm::abs(glm::dvec3(node.world[axis])) * local[axis];

    glm::dvec4 error(0.0);
    for (int axis = 0; axis < 3; ++axis) {
        error += glm::abs(view.view_projection[axis]) * (2.0 * rounding * size[axis]);
    }
    const glm::dvec4 moved = view.view_projection * glm::dvec4(view.position, 1.0);
    return error + rounding * glm::abs(moved);
}

Rect screen_bounds(const View& view, const Bounds& world_bounds, const glm::dvec4& error, int width,
                   int height) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    glm::dvec2 low(infinity);
    glm::dvec2 high(-infinity);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec4 clip =
            view.view_projection * box_corner(world_bounds.low, world_bounds.high, corner);
        // Beside or behind the eye a corner's projection bounds nothing.
        const double size = std::max(std::abs(clip.x), std::abs(clip.y));
        const double w = clip.w - error.w;
        if (!(w > 1e-4 * size)) return {0, 0, width, height};
        const glm::dvec2 ndc = glm::dvec2(clip) / clip.w;
        const glm::dvec2 off = (glm::dvec2(error) + glm::abs(ndc) * error.w) / w;
        low = glm::min(low, ndc - off);
        high = glm::max(high, ndc + off);
    }
    const glm::dvec2 size(width, height);
    const glm::dvec2 first = (low * 0.5 + 0.5) * size - margin;
    const glm::dvec2 last = (high * 0.5 + 0.5) * size + margin;
    return {clamped(std::floor(first.x), width), clamped(std::floor(first.y), height),
            clamped(std::ceil(last.x), width), clamped(std::ceil(last.y), height)};
}

}  // namespace cubecam
