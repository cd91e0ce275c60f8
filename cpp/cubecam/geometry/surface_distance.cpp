#include "cubecam/geometry/surface_distance.hpp"

#include "cubecam/core/interrupts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>

namespace cubecam {
namespace {

constexpr std::size_t triangles_of_leaf = 4;
/// How much larger than the distance the bound may be.
constexpr double slack = 1.05;
/// Distances below this share of the extent are not told from 0.
constexpr double least_share = 1e-4;
/// A triangle is cut at most so many times, one cut in the other.
constexpr int deepest_cut = 40;
constexpr int steps_of_cut = 24;
constexpr double thinnest_cut = 0.01;
/// Distances that differ by less, as a share of the least one, are equal.
constexpr double share_of_tie = 1e-3;

/// The point of a triangle that is nearest to another point (C. Ericson, "Real-Time Collision
/// Detection", 2005, section 5.1.5).
glm::dvec3 nearest_point(const glm::dvec3& p, const std::array<glm::dvec3, 3>& t) {
    const glm::dvec3 ab = t[1] - t[0];
    const glm::dvec3 ac = t[2] - t[0];
    const glm::dvec3 ap = p - t[0];
    const double d1 = glm::dot(ab, ap);
    const double d2 = glm::dot(ac, ap);
    if (d1 <= 0.0 && d2 <= 0.0) return t[0];
    const glm::dvec3 bp = p - t[1];
    const double d3 = glm::dot(ab, bp);
    const double d4 = glm::dot(ac, bp);
    if (d3 >= 0.0 && d4 <= d3) return t[1];
    const double vc = d1 * d4 - d3 * d2;
    if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return t[0] + d1 / (d1 - d3) * ab;
    const glm::dvec3 cp = p - t[2];
    const double d5 = glm::dot(ab, cp);
    const double d6 = glm::dot(ac, cp);
    if (d6 >= 0.0 && d5 <= d6) return t[2];
    const double vb = d5 * d2 - d1 * d6;
    if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return t[0] + d2 / (d2 - d6) * ac;
    const double va = d3 * d6 - d5 * d4;
    if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
        return t[1] + (d4 - d3) / ((d4 - d3) + (d5 - d6)) * (t[2] - t[1]);
    }
    const double whole = va + vb + vc;
    if (!(whole > 0.0)) return t[0];
    return t[0] + vb / whole * ab + vc / whole * ac;
}

double squared_distance(const glm::dvec3& point, const glm::dvec3& low, const glm::dvec3& high) {
    const glm::dvec3 away = glm::max(glm::max(low - point, point - high), 0.0);
    return glm::dot(away, away);
}

/// A point of a triangle, and what is nearest to it on the other surface.
struct CutCorner {
    glm::dvec3 place;
    NearestTriangles::Found nearest;

    double distance() const { return nearest.distance; }
    std::span<const std::uint32_t> triangles() const {
        return {nearest.triangles.data(), nearest.count};
    }
};

struct CutPiece {
    std::array<CutCorner, 3> corners;
    int cuts;
};

/// The greatest distance of one surface from another.
class OneSided {
public:
    OneSided(const std::vector<glm::vec3>& positions, const std::vector<glm::uvec3>& from,
             const NearestTriangles& to, double least)
        : positions_(positions), from_(from), to_(to), least_(least) {}

    /// @param known a distance that is reached elsewhere; smaller ones do not count. It grows.
    double bound(double& known) {
        std::vector<CutCorner> corners(positions_.size());
        std::vector<bool> found(positions_.size(), false);
        for (std::size_t i = 0; i < from_.size(); ++i) {
            poll_interrupts(i);
            for (int c = 0; c < 3; ++c) {
                const std::uint32_t vertex = from_[i][c];
                if (found[vertex]) continue;
                found[vertex] = true;
                corners[vertex] = corner_at(glm::dvec3(positions_[vertex]));
                known = std::max(known, corners[vertex].distance());
            }
        }
        double bound = 0.0;
        std::vector<CutPiece> waiting;
        std::size_t steps = 0;
        for (const glm::uvec3& triangle : from_) {
            waiting.push_back({{corners[triangle.x], corners[triangle.y], corners[triangle.z]}, 0});
            while (!waiting.empty()) {
                poll_interrupts(steps++);
                const CutPiece piece = waiting.back();
                waiting.pop_back();
                const double enough = std::max(slack * known, least_);
                const double most = bound_of(piece, enough);
                if (most <= enough || piece.cuts >= deepest_cut) {
                    bound = std::max(bound, most);
                } else {
                    cut(piece, known, waiting);
                }
            }
        }
        return bound;
    }

private:
    CutCorner corner_at(const glm::dvec3& place) const {
        return {place, to_.find(place, share_of_tie * least_)};
    }

    /// An upper bound of the distances of a piece; the first one found that is `enough`.
    double bound_of(const CutPiece& piece, double enough) const {
        double least = std::numeric_limits<double>::infinity();
        for (const CutCorner& corner : piece.corners) {
            // No point is farther away than by the way to this corner.
            double reach = 0.0;
            for (const CutCorner& other : piece.corners) {
                reach = std::max(reach, glm::distance(other.place, corner.place));
            }
            least = std::min(least, corner.distance() + reach);
        }
        for (const CutCorner& corner : piece.corners) {
            for (const std::uint32_t triangle : corner.triangles()) {
                if (least <= enough) return least;
                double most = 0.0;
                for (const CutCorner& other : piece.corners) {
                    most = std::max(most, to_.distance(other.place, triangle));
                    if (most >= least) break;
                }
                least = std::min(least, most);
            }
        }
        return least;
    }

    /// Of the triangles that are nearest to a corner the one that is nearest to another.
    std::uint32_t towards(const CutCorner& from, const CutCorner& to) const {
        std::uint32_t best = from.triangles().front();
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t triangle : from.triangles()) {
            const double away = to_.distance(to.place, triangle);
            if (away < least) {
                least = away;
                best = triangle;
            }
        }
        return best;
    }

    static bool share_a_triangle(const CutCorner& a, const CutCorner& b) {
        const std::span<const std::uint32_t> known = b.triangles();
        return std::any_of(a.triangles().begin(), a.triangles().end(), [&](std::uint32_t t) {
            return std::find(known.begin(), known.end(), t) != known.end();
        });
    }

    /// Cuts the longest side whose ends are nearest to different triangles, where both are equally
    /// far; or the longest side in the middle.
    void cut(const CutPiece& piece, double& known, std::vector<CutPiece>& to) const {
        std::size_t side = 0;
        double longest = -1.0;
        bool differ = false;
        for (std::size_t i = 0; i < 3; ++i) {
            const CutCorner& a = piece.corners[i];
            const CutCorner& b = piece.corners[(i + 1) % 3];
            const double length = glm::distance(a.place, b.place);
            const bool apart = !share_a_triangle(a, b);
            if (differ && !apart) continue;
            if (apart == differ && length <= longest) continue;
            differ = apart;
            longest = length;
            side = i;
        }
        const CutCorner& a = piece.corners[side];
        const CutCorner& b = piece.corners[(side + 1) % 3];
        const CutCorner& c = piece.corners[(side + 2) % 3];
        double at = 0.5;
        if (differ) {
            const std::uint32_t near_a = towards(a, b);
            const std::uint32_t near_b = towards(b, a);
            double low = 0.0;
            double high = 1.0;
            for (int step = 0; step < steps_of_cut; ++step) {
                const double middle = 0.5 * (low + high);
                const glm::dvec3 place = glm::mix(a.place, b.place, middle);
                const bool nearer = to_.distance(place, near_a) < to_.distance(place, near_b);
                (nearer ? low : high) = middle;
            }
            // Not too near to an end, so that pieces get small.
            if (low > thinnest_cut && high < 1.0 - thinnest_cut) at = 0.5 * (low + high);
        }
        const CutCorner middle = corner_at(glm::mix(a.place, b.place, at));
        known = std::max(known, middle.distance());
        to.push_back({{a, middle, c}, piece.cuts + 1});
        to.push_back({{middle, b, c}, piece.cuts + 1});
    }

    const std::vector<glm::vec3>& positions_;
    const std::vector<glm::uvec3>& from_;
    const NearestTriangles& to_;
    const double least_;
};

}  // namespace

NearestTriangles::NearestTriangles(const std::vector<glm::vec3>& positions,
                                   const std::vector<glm::uvec3>& triangles)
    : positions_(positions), triangles_(triangles), order_(triangles.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    middles_.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        middles_.push_back((positions[t.x] + positions[t.y] + positions[t.z]) / 3.0F);
    }
    boxes_.reserve(triangles.size());
    build(0, triangles.size());
}

std::array<glm::dvec3, 3> NearestTriangles::corners(std::uint32_t triangle) const {
    const glm::uvec3& t = triangles_[triangle];
    return {glm::dvec3(positions_[t.x]), glm::dvec3(positions_[t.y]), glm::dvec3(positions_[t.z])};
}

/// Halves the triangles along the longest axis of their middles; the depth is the logarithm of
/// their number.
std::uint32_t NearestTriangles::build(std::size_t first, std::size_t last) {
    poll_interrupts(boxes_.size());
    const auto place = static_cast<std::uint32_t>(boxes_.size());
    Box box{glm::dvec3(std::numeric_limits<double>::infinity()),
            glm::dvec3(-std::numeric_limits<double>::infinity()), 0, 0};
    glm::vec3 low(std::numeric_limits<float>::infinity());
    glm::vec3 high = -low;
    for (std::size_t i = first; i < last; ++i) {
        for (const glm::dvec3& corner : corners(order_[i])) {
            box.low = glm::min(box.low, corner);
            box.high = glm::max(box.high, corner);
        }
        low = glm::min(low, middles_[order_[i]]);
        high = glm::max(high, middles_[order_[i]]);
    }
    if (last - first <= triangles_of_leaf) {
        box.first = static_cast<std::uint32_t>(first);
        box.count = static_cast<std::uint32_t>(last - first);
        boxes_.push_back(box);
        return place;
    }
    const glm::vec3 extent = high - low;
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
        if (extent[i] > extent[axis]) axis = i;
    }
    const auto at = [this](std::size_t i) {
        return order_.begin() + static_cast<std::ptrdiff_t>(i);
    };
    const std::size_t half = first + (last - first) / 2;
    std::nth_element(at(first), at(half), at(last), [&](std::uint32_t a, std::uint32_t b) {
        const float left = middles_[a][axis];
        const float right = middles_[b][axis];
        return left < right || (left == right && a < b);
    });
    boxes_.push_back(box);
    build(first, half);
    const std::uint32_t second = build(half, last);
    boxes_[place].first = second;
    return place;
}

double NearestTriangles::distance(const glm::dvec3& point, std::uint32_t triangle) const {
    return glm::distance(point, nearest_point(point, corners(triangle)));
}

NearestTriangles::Found NearestTriangles::find(const glm::dvec3& point, double tie) const {
    double best = std::numeric_limits<double>::infinity();
    double limit = best;  // squared: farther ones do not count
    Found found{best, {}, 0};
    std::array<double, Found::most> distances{};
    const auto add = [&](double squared, std::uint32_t triangle) {
        const double away = std::sqrt(squared);
        if (away < best) {
            best = away;
            limit = (best + tie) * (best + tie);
        }
        std::size_t place = found.count;
        if (place < Found::most) {
            ++found.count;
        } else {
            const auto worst = std::max_element(distances.begin(), distances.end());
            if (*worst <= away) return;
            place = static_cast<std::size_t>(worst - distances.begin());
        }
        distances[place] = away;
        found.triangles[place] = triangle;
    };
    struct Waiting {
        std::uint32_t box;
        double distance;
    };
    std::array<Waiting, 128> stack;  // twice the depth of 2^32 triangles
    std::size_t count = 0;
    stack[count++] = {0, 0.0};
    while (count > 0) {
        const Waiting next = stack[--count];
        if (next.distance > limit) continue;
        const Box& box = boxes_[next.box];
        if (box.count > 0) {
            for (std::uint32_t i = box.first; i < box.first + box.count; ++i) {
                const glm::dvec3 away = point - nearest_point(point, corners(order_[i]));
                const double squared = glm::dot(away, away);
                if (squared <= limit) add(squared, order_[i]);
            }
            continue;
        }
        const std::uint32_t children[2] = {next.box + 1, box.first};
        double away[2];
        for (int i = 0; i < 2; ++i) {
            away[i] = squared_distance(point, boxes_[children[i]].low, boxes_[children[i]].high);
        }
        const int nearer = away[0] <= away[1] ? 0 : 1;
        if (away[1 - nearer] <= limit) stack[count++] = {children[1 - nearer], away[1 - nearer]};
        if (away[nearer] <= limit) stack[count++] = {children[nearer], away[nearer]};
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < found.count; ++i) {
        if (distances[i] <= best + tie) found.triangles[kept++] = found.triangles[i];
    }
    found.count = kept;
    found.distance = best;
    return found;
}

double surface_distance(const std::vector<glm::vec3>& positions,
                        const std::vector<glm::uvec3>& first,
                        const std::vector<glm::uvec3>& second) {
    glm::dvec3 low(std::numeric_limits<double>::infinity());
    glm::dvec3 high = -low;
    for (const glm::uvec3& triangle : first) {
        for (int i = 0; i < 3; ++i) {
            low = glm::min(low, glm::dvec3(positions[triangle[i]]));
            high = glm::max(high, glm::dvec3(positions[triangle[i]]));
        }
    }
    const double least = least_share * glm::length(high - low);
    const NearestTriangles of_first(positions, first);
    const NearestTriangles of_second(positions, second);
    double known = 0.0;
    const double away = OneSided(positions, first, of_second, least).bound(known);
    const double back = OneSided(positions, second, of_first, least).bound(known);
    return std::max(away, back);
}

}  // namespace cubecam
