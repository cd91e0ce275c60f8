/// Pictures of all directions, or of some: perspective, fisheye lenses, mirror ball, octahedral
/// map, dual paraboloid, cylinder. docs/howto/projections.md shows one of each and names the
/// sources.
///
/// A position (x, y) on a picture runs from -1 to 1: x from its left border to its right one, y
/// from its lower border to its upper one. Texel (row, col) of a (H, W) picture lies at x = 2 (col
/// + .5)/W - 1, y = 1 - 2 (row + .5)/H. A direction (right, up, forward) counts along the axes of
/// the viewer. No picture is mirrored, except the one of the mirror ball, which is what a camera
/// sees in a mirror.
#pragma once

#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace cubecam {

/// With a the angle from the center, r the distance from the center of the picture, 1 at the edge
/// of the field of view:
///
///     perspective      x, y ~ right / forward, up / forward
///     equidistant      r ~ a           lenses as Hugin and PanoTools define them;
///     equisolid        r ~ sin(a / 2)  equidistant over 360 degrees is Debevec's angular map
///     stereographic    r ~ tan(a / 2)
///     orthographic     r ~ sin(a)
///     mirror_ball      the reflection on a ball, seen from far away (Debevec 1998)
///     octahedral       |x| + |y| + |z| = 1, unfolded (Cigolle et al. 2014, "oct")
///     dual_paraboloid  x, y = (right, up) / (1 + forward), once for each way (Heidrich and Seidel
///                      1998); the left half looks forward, the right half back
///     cylindrical      x ~ longitude, y ~ tan(latitude)
enum class ProjectionKind : int {
    perspective,
    equidistant,
    equisolid,
    stereographic,
    orthographic,
    mirror_ball,
    octahedral,
    dual_paraboloid,
    cylindrical,
};

/// The distance from the center for an angle from the center, up to a factor.
inline double lens_radius(ProjectionKind kind, double angle) {
    switch (kind) {
        case ProjectionKind::equisolid: return std::sin(angle / 2);
        case ProjectionKind::stereographic: return std::tan(angle / 2);
        case ProjectionKind::orthographic: return std::sin(angle);
        default: return angle;
    }
}

class Projection {
public:
    /// `fov` is in radians: the whole height of a perspective, the width of a cylinder, the
    /// diameter of a lens; the other kinds ignore it. `aspect` is the picture's width by its
    /// height. The columns of `axes` are what the viewer calls right, up and forward.
    Projection(ProjectionKind kind, double fov, double aspect, const glm::dmat3& axes)
        : kind_(kind), half_(fov / 2), edge_(1), aspect_(aspect), axes_(axes) {
        if (kind == ProjectionKind::perspective) edge_ = std::tan(half_);
        if (is_lens()) edge_ = lens_radius(kind, half_);
    }

    ProjectionKind kind() const { return kind_; }
    bool is_lens() const {
        return kind_ >= ProjectionKind::equidistant && kind_ <= ProjectionKind::orthographic;
    }
    /// Whether the picture is a disc (or two), so that its corners show nothing.
    bool is_disc() const {
        return is_lens() || kind_ == ProjectionKind::mirror_ball ||
               kind_ == ProjectionKind::dual_paraboloid;
    }
    /// Whether the first column continues the last one.
    bool is_ring() const {
        return kind_ == ProjectionKind::cylindrical && half_ > std::numbers::pi - slack;
    }

    /// Whether the picture shows a direction at a position.
    bool contains(const glm::dvec2& p) const {
        if (!is_disc()) return std::abs(p.x) <= 1 + slack && std::abs(p.y) <= 1 + slack;
        const double x = kind_ == ProjectionKind::dual_paraboloid ? on_half(p.x) : p.x;
        return x * x + p.y * p.y <= 1 + slack;
    }

    /// Returns the unit direction at a position, in world axes, if the picture shows one there.
    std::optional<glm::dvec3> direction_at(const glm::dvec2& p) const {
        if (!contains(p)) return std::nullopt;
        return axes_ * seen_at(p);
    }

    /// Returns the position that shows a direction of any length but 0, in world axes, if one does.
    std::optional<glm::dvec2> position_of(const glm::dvec3& direction) const {
        const glm::dvec3 d = glm::normalize(direction * axes_);
        const std::optional<glm::dvec2> p = shown_at(d);
        return p && contains(*p) ? p : std::nullopt;
    }

private:
    static constexpr double slack = 1e-9;  ///< for positions and angles that lie on the very edge

    /// The coordinate across one half of a dual paraboloid.
    static double on_half(double x) { return x < 0 ? 2 * x + 1 : 2 * x - 1; }

    static glm::dvec2 folded(const glm::dvec2& p) {
        return {std::copysign(1 - std::abs(p.y), p.x), std::copysign(1 - std::abs(p.x), p.y)};
    }

    /// The unit vector (right, up, forward) at a position.
    glm::dvec3 seen_at(const glm::dvec2& p) const {
        switch (kind_) {
            case ProjectionKind::perspective:
                return glm::normalize(glm::dvec3(p.x * edge_ * aspect_, p.y * edge_, 1));
            case ProjectionKind::cylindrical: {
                const double longitude = p.x * half_;
                const double height = p.y * half_ / aspect_;
                return glm::normalize(glm::dvec3(std::sin(longitude), height, std::cos(longitude)));
            }
            case ProjectionKind::octahedral: {
                const double z = 1 - std::abs(p.x) - std::abs(p.y);
                const glm::dvec2 xy = z < 0 ? folded(p) : p;
                return glm::normalize(glm::dvec3(xy, z));
            }
            case ProjectionKind::mirror_ball: {
                // The normal is (x, y, -n) in these axes; the ray that looks forward is reflected.
                const double square = std::min(glm::dot(p, p), 1.0);
                return {p * (2 * std::sqrt(1 - square)), 2 * square - 1};
            }
            case ProjectionKind::dual_paraboloid: {
                const glm::dvec2 q(on_half(p.x), p.y);
                const double square = glm::dot(q, q);
                const double way = p.x < 0 ? 1 : -1;
                return glm::dvec3(way * 2 * q.x, 2 * q.y, way * (1 - square)) / (1 + square);
            }
            default: return seen_by_lens(p);
        }
    }

    glm::dvec3 seen_by_lens(const glm::dvec2& p) const {
        const double r = glm::length(p);
        if (r < 1e-12) return {0, 0, 1};
        const double at = r * edge_;
        double sine, cosine;
        if (kind_ == ProjectionKind::equisolid) {
            sine = 2 * at * std::sqrt(std::max(1 - at * at, 0.0));
            cosine = 1 - 2 * at * at;
        } else if (kind_ == ProjectionKind::stereographic) {
            sine = 2 * at / (1 + at * at);
            cosine = (1 - at * at) / (1 + at * at);
        } else if (kind_ == ProjectionKind::orthographic) {
            sine = at;
            cosine = std::sqrt(std::max(1 - at * at, 0.0));
        } else {
            sine = std::sin(at);
            cosine = std::cos(at);
        }
        return {p * (sine / r), cosine};
    }

    /// Where a unit vector (right, up, forward) is shown; the position may lie outside the picture.
    std::optional<glm::dvec2> shown_at(const glm::dvec3& d) const {
        const glm::dvec2 xy(d);
        switch (kind_) {
            case ProjectionKind::perspective:
                if (d.z <= 0) return std::nullopt;
                return glm::dvec2(d.x / aspect_, d.y) / (edge_ * d.z);
            case ProjectionKind::cylindrical: {
                const double level = std::hypot(d.x, d.z);
                return glm::dvec2(std::atan2(d.x, d.z), d.y / level * aspect_) / half_;
            }
            case ProjectionKind::octahedral: {
                const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
                return d.z < 0 ? folded(xy / sum) : xy / sum;
            }
            case ProjectionKind::mirror_ball: {
                const double sine = glm::length(xy);
                if (sine < 1e-12) return glm::dvec2(d.z > 0 ? 1 : 0, 0);
                const double half =
                    d.z > 0 ? std::sqrt((1 + d.z) / 2) : sine / std::sqrt(2 * (1 - d.z));
                return xy * (half / sine);
            }
            case ProjectionKind::dual_paraboloid: {
                const double way = d.z >= 0 ? 1 : -1;
                const glm::dvec2 q = glm::dvec2(way * d.x, d.y) / (1 + std::abs(d.z));
                return glm::dvec2((q.x - way) / 2, q.y);
            }
            default: return shown_by_lens(d);
        }
    }

    std::optional<glm::dvec2> shown_by_lens(const glm::dvec3& d) const {
        const double sine = glm::length(glm::dvec2(d));
        const double angle = std::atan2(sine, d.z);
        if (angle > half_ + slack) return std::nullopt;
        const double r = lens_radius(kind_, angle) / edge_;
        if (sine < 1e-12) return glm::dvec2(d.z > 0 ? 0.0 : r, 0);
        return glm::dvec2(d) * (r / sine);
    }

    ProjectionKind kind_;
    double half_;  ///< half the field of view
    double edge_;  ///< what `lens_radius`, or the tangent, is at the edge of the field of view
    double aspect_;
    glm::dmat3 axes_;
};

}  // namespace cubecam
