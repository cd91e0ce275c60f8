#include "cubecam/render/passes/screen_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cubecam {
namespace {

/// In pixels: coverage depends on a pixel's center or its samples, and rasterisers snap vertices to
/// a fraction of a pixel.
constexpr double margin = 2.0;

/// The same for a rectangle of whole pixels, in whose pixels centers and samples lie well inside.
constexpr double margin_of_part = 0.25;

/// An upper bound for the rounding of matrices and of a product of four terms, relative to the sum
/// of the terms' absolute values (N. Higham, "Accuracy and Stability of Numerical Algorithms",
/// section 3.1).
constexpr double rounding = 8.0 / (1 << 24);

int clamped(double pixel, int size) {
    return static_cast<int>(std::clamp(pixel, 0.0, static_cast<double>(size)));
}

}  // namespace

Culling::Culling(const View& view)
    : view_projection_(view.view_projection), position_(view.position),
      frustum_(view.view_projection), clip_(view.clip) {
    for (int axis = 0; axis < 3; ++axis) {
        error_of_size_[static_cast<std::size_t>(axis)] =
            glm::abs(view_projection_[axis]) * (2.0 * rounding);
    }
    least_error_ = rounding * glm::abs(view_projection_ * glm::dvec4(position_, 1.0));
}

glm::dvec4 Culling::clip_error(const NodeSnapshot& node) const {
    // As in the shader: from local space to the world relative to the view's position, then to clip
    // space.
    const glm::dvec3 size = glm::abs(glm::dvec3(node.world[3]) - position_) + node.reach;
    return least_error_ + error_of_size_[0] * size[0] + error_of_size_[1] * size[1] +
           error_of_size_[2] * size[2];
}

bool Culling::may_show(const NodeSnapshot& node) const {
    const Bounds& bounds = node.world_bounds;
    if (clip_) {
        const glm::dvec3 half = 0.5 * bounds.extent();
        const glm::dvec3 size = glm::abs(glm::dvec3(node.world[3]) - position_) + node.reach;
        const double error = rounding * (size.x + size.y + size.z);
        const double reach = glm::dot(glm::abs(clip_->normal), half);
        if (clip_->height(bounds.center()) + reach < -error) return false;
    }
    return frustum_.may_show(bounds.center(), 0.5 * bounds.extent(),
                             [&] { return clip_error(node); });
}

Rect Culling::screen_bounds(const NodeSnapshot& node, int width, int height) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const glm::dvec4 error = clip_error(node);
    const glm::dvec3& low_corner = node.world_bounds.low;
    const glm::dvec3 extent = node.world_bounds.extent();
    const glm::dvec4 base = view_projection_ * glm::dvec4(low_corner, 1.0);
    const glm::dvec4 edges[3] = {view_projection_[0] * extent.x, view_projection_[1] * extent.y,
                                 view_projection_[2] * extent.z};
    glm::dvec2 low(infinity);
    glm::dvec2 high(-infinity);
    for (unsigned corner = 0; corner < 8; ++corner) {
        glm::dvec4 clip = base;
        for (unsigned axis = 0; axis < 3; ++axis) {
            if ((corner >> axis & 1U) != 0) clip += edges[axis];
        }
        // If a corner is beside or behind the eye, its projection gives no bound.
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

PartFrustum Culling::part_frustum(const NodeSnapshot& node, const Rect& rect, int width,
                                  int height) const {
    const glm::dvec2 size(width, height);
    const glm::dvec2 low = 2.0 * (glm::dvec2(rect.x0, rect.y0) - margin_of_part) / size - 1.0;
    const glm::dvec2 high = 2.0 * (glm::dvec2(rect.x1, rect.y1) + margin_of_part) / size - 1.0;
    const glm::dvec2 center = 0.5 * (low + high);
    const glm::dvec2 half = 0.5 * (high - low);
    // The matrix that makes the rectangle the whole of clip space, of w and its own axes.
    glm::dmat4 to_part(1.0);
    for (int axis = 0; axis < 2; ++axis) {
        to_part[axis][axis] = 1.0 / half[axis];
        to_part[3][axis] = -center[axis] / half[axis];
    }
    glm::dvec4 error = clip_error(node);
    for (int axis = 0; axis < 2; ++axis) {
        error[axis] = (error[axis] + std::abs(center[axis]) * error.w) / half[axis];
    }
    return {Frustum(to_part * view_projection_ * node.world), error};
}

}  // namespace cubecam
