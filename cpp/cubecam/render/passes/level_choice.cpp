#include "cubecam/render/passes/level_choice.hpp"

#include "cubecam/render/passes/draw_plan.hpp"
#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cubecam {
namespace {

constexpr double unbounded_error = std::numeric_limits<double>::infinity();

/// The largest factor by which a matrix of 2 x 2 stretches.
double largest_stretch(const glm::dmat2& m) {
    const double sum = glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]);
    const double product = glm::determinant(m);
    const double root = std::sqrt(std::max(0.0, sum * sum - 4.0 * product * product));
    return std::sqrt(0.5 * (sum + root));
}

/// The distance of a point from a box.
double distance_of(const glm::dvec3& point, const Bounds& box) {
    const glm::dvec3 nearest = glm::clamp(point, box.low, box.high);
    return glm::distance(point, nearest);
}

}  // namespace

double largest_scale(const glm::dmat3& matrix) {
    const glm::dmat3 product = glm::transpose(matrix) * matrix;
    double largest = 0.0;
    for (int column = 0; column < 3; ++column) {
        const glm::dvec3 sizes = glm::abs(product[column]);
        largest = std::max(largest, sizes.x + sizes.y + sizes.z);
    }
    return std::sqrt(largest);
}

LevelChoice::LevelChoice(const SceneSnapshot& scene, std::span<const View> views,
                         const glm::ivec2& size, double max_error)
    : views_(views), max_error_(max_error), shadows_(max_error > 0.0 && has_shadows(scene)) {
    if (max_error_ == 0.0) return;
    for (const View& view : views) scales_.push_back(scale_of(view, size));
}

/// In a perspective the pixel of a point is a linear function of (x, y) / depth, in a parallel view
/// of (x, y).
LevelChoice::Scale LevelChoice::scale_of(const View& view, const glm::ivec2& size) {
    const glm::dmat4& p = view.projection;
    const double weight = view.parallel ? p[3][3] : -p[2][3];
    const bool plain = p[0][3] == 0.0 && p[1][3] == 0.0 && weight > 0.0 &&
                       (view.parallel ? p[2][3] == 0.0 && p[2][0] == 0.0 && p[2][1] == 0.0
                                      : p[3][3] == 0.0 && p[3][0] == 0.0 && p[3][1] == 0.0);
    if (!plain) return {};
    const glm::dmat2 linear(p[0][0], p[0][1], p[1][0], p[1][1]);
    const glm::dvec2 half = 0.5 * glm::dvec2(size);
    glm::dmat2 to_pixels = linear / weight;
    for (int column = 0; column < 2; ++column) to_pixels[column] *= half;
    Scale scale{largest_stretch(to_pixels), 0.0, true};
    if (view.parallel) return scale;
    const glm::dvec2 middle(p[2][0], p[2][1]);
    const glm::dmat2 inverse = glm::inverse(linear);
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            const glm::dvec2 tangents = inverse * (weight * glm::dvec2(x, y) + middle);
            scale.widest = std::max(scale.widest, glm::dot(tangents, tangents));
        }
    }
    scale.known = std::isfinite(scale.pixels) && std::isfinite(scale.widest);
    return scale;
}

/// A surface that casts shadows on itself must be where its shadow map says: the map shows the
/// mesh. So must a body that light is followed through.
bool LevelChoice::may_simplify(const NodeSnapshot& node) const {
    if (node.mesh->levels() == nullptr || node.deforms || node.unbounded) return false;
    const MaterialTraits& traits = node.material.value.traits();
    if (traits.shows_far_side || traits.moves_vertices()) return false;
    if (traits.user_code && traits.user_code->counts_triangles) return false;
    return !(shadows_ && casts_shadow(node) && receive_shadow(node));
}

/// Let a point lie at (x, y) at the depth z, and another within `error` of it at the depth z'.
/// Their pixels differ by at most f error sqrt(1 + (x^2 + y^2) / z^2) / z', since
/// x'/z' - x/z = ((x' - x) z - x (z' - z)) / (z z').
double LevelChoice::pixels(std::size_t v, const NodeSnapshot& node, double error) const {
    const View& view = views_[v];
    const Scale& scale = scales_[v];
    if (!scale.known) return unbounded_error;
    if (view.parallel) return scale.pixels * error;
    const Bounds& box = node.world_bounds;
    double nearest = unbounded_error;
    double widest = 0.0;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::dvec3 place((corner & 1U) != 0 ? box.high.x : box.low.x,
                               (corner & 2U) != 0 ? box.high.y : box.low.y,
                               (corner & 4U) != 0 ? box.high.z : box.low.z);
        const glm::dvec3 seen(view.view * glm::dvec4(place, 1.0));
        const double depth = -seen.z;
        nearest = std::min(nearest, depth);
        widest = depth > 0.0 ? std::max(widest, (seen.x * seen.x + seen.y * seen.y) / depth / depth)
                             : unbounded_error;
        if (depth <= 0.0) break;
    }
    if (nearest <= 0.0) widest = unbounded_error;
    // What the view shows lies within its own widest angle.
    widest = std::min(widest, scale.widest);
    const double by_distance =
        distance_of(view.position, box) / std::sqrt(1.0 + scale.widest) - error;
    nearest = std::max(nearest, by_distance);
    if (!(nearest > 0.0)) return unbounded_error;
    return scale.pixels * error * std::sqrt(1.0 + widest) / nearest;
}

std::uint32_t LevelChoice::of(const NodeSnapshot& node, std::span<const Visibility> seen) const {
    if (max_error_ == 0.0 || !may_simplify(node)) return 0;
    const std::vector<DrawnLevel>& levels = *node.mesh->levels();
    const double scale = largest_scale(glm::dmat3(node.world));
    for (std::size_t i = levels.size(); i-- > 0;) {
        const double error = scale * levels[i].error;
        const bool fits = std::all_of(seen.begin(), seen.end(), [&](const Visibility& visibility) {
            return pixels(visibility.view, node, error) <= max_error_;
        });
        if (fits) return static_cast<std::uint32_t>(i + 1);
    }
    return 0;
}

}  // namespace cubecam
