#include "cubecam/geometry/simplify.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/interrupts.hpp"
#include "cubecam/geometry/surface_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <queue>
#include <span>
#include <tuple>
#include <utility>

namespace cubecam {
namespace {

/// The most that a difference of 1 of an attribute is worth, as a share of the mesh's extent.
constexpr double longest_share = 0.25;
/// How much the sides of borders and seams count, relative to the area of a square over them.
constexpr double border_weight = 10.0;
constexpr double seam_weight = 1.0;
/// A triangle may not turn farther than by the angle with this cosine.
constexpr double least_cosine = 0.25;
/// Prefers short edges where all errors are 0.
constexpr double share_of_length = 1e-6;
/// No edge is contracted at a greater error, as a share of the extent.
constexpr double greatest_share = 0.25;
/// More neighbours of one vertex are only kept: work grows with their square.
constexpr std::size_t most_neighbours = 24;
/// A level has at most this share of the triangles of the one before, or it is left out.
constexpr double worthwhile = 0.95;

/// The sum of squared distances from planes, weighted by areas.
struct Quadric {
    double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
    glm::dvec3 linear{0.0};
    double constant = 0;
    double weight = 0;

    /// Adds weight * (dot(normal, x) + offset)^2.
    void add(const glm::dvec3& normal, double offset, double by) {
        xx += by * normal.x * normal.x;
        xy += by * normal.x * normal.y;
        xz += by * normal.x * normal.z;
        yy += by * normal.y * normal.y;
        yz += by * normal.y * normal.z;
        zz += by * normal.z * normal.z;
        linear += by * offset * normal;
        constant += by * offset * offset;
    }
    Quadric& operator+=(const Quadric& other) {
        xx += other.xx;
        xy += other.xy;
        xz += other.xz;
        yy += other.yy;
        yz += other.yz;
        zz += other.zz;
        linear += other.linear;
        constant += other.constant;
        weight += other.weight;
        return *this;
    }
    double at(const glm::dvec3& p) const {
        return xx * p.x * p.x + yy * p.y * p.y + zz * p.z * p.z +
               2.0 * (xy * p.x * p.y + xz * p.x * p.z + yz * p.y * p.z + glm::dot(linear, p)) +
               constant;
    }
};

/// A linear function of the place: an attribute over a plane.
struct Gradient {
    glm::dvec3 slope{0.0};
    double constant = 0;
};

/// The attributes of vertices, in lengths: so many numbers for each.
struct Attributes {
    std::size_t count = 0;
    std::vector<double> values;

    std::span<const double> of(std::uint32_t vertex) const {
        return {values.data() + vertex * count, count};
    }
};

/// The slopes along two sides e and f of a triangle, with this normal, of functions that change by
/// 1 along the one and not along the other: the gradient in its plane is a sum of both.
struct SideSlopes {
    glm::dvec3 along_e, along_f;

    SideSlopes(const glm::dvec3& e, const glm::dvec3& f, const glm::dvec3& normal, double area)
        : along_e(glm::cross(f, normal) / (2.0 * area)),
          along_f(glm::cross(normal, e) / (2.0 * area)) {}
};

/// Numbers of each vertex that belong together, such as normals.
struct AttributePart {
    const float* from;
    std::size_t numbers;

    glm::dvec4 of(std::uint32_t vertex) const {
        glm::dvec4 found(0.0);
        for (std::size_t i = 0; i < numbers; ++i) {
            found[static_cast<int>(i)] = static_cast<double>(from[vertex * numbers + i]);
        }
        return found;
    }
};

/// The length on the surface over which an attribute changes by 1 on average, at most `longest`.
double length_of(const AttributePart& part, const MeshData& mesh, double longest) {
    const std::vector<glm::vec3>& positions = *mesh.positions();
    double whole = 0.0;
    double change = 0.0;
    for (const glm::uvec3& t : *mesh.triangles()) {
        const glm::dvec3 e(positions[t.y] - positions[t.x]);
        const glm::dvec3 f(positions[t.z] - positions[t.x]);
        const glm::dvec3 cross = glm::cross(e, f);
        const double area = 0.5 * glm::length(cross);
        if (!(area > 0.0)) continue;
        const SideSlopes sides(e, f, cross / (2.0 * area), area);
        const glm::dvec4 by_e = part.of(t.y) - part.of(t.x);
        const glm::dvec4 by_f = part.of(t.z) - part.of(t.x);
        double squared = 0.0;
        for (int i = 0; i < 4; ++i) {
            const glm::dvec3 slope = by_e[i] * sides.along_e + by_f[i] * sides.along_f;
            squared += glm::dot(slope, slope);
        }
        whole += area;
        change += area * std::sqrt(squared);
    }
    return whole < longest * change ? whole / change : longest;
}

Attributes attributes_of(const MeshData& mesh, double extent) {
    std::vector<AttributePart> parts{{&mesh.normals()->front().x, 3}};
    if (mesh.colors()) parts.push_back({&mesh.colors()->front().x, 4});
    for (const int set : {0, 1}) {
        if (mesh.uvs(set)) parts.push_back({&mesh.uvs(set)->front().x, 2});
    }
    std::vector<double> lengths;
    for (const AttributePart& part : parts) {
        lengths.push_back(length_of(part, mesh, longest_share * extent));
    }
    Attributes made;
    for (const AttributePart& part : parts) made.count += part.numbers;
    const std::size_t vertices = mesh.positions()->size();
    made.values.reserve(made.count * vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
        for (std::size_t p = 0; p < parts.size(); ++p) {
            const glm::dvec4 values = parts[p].of(static_cast<std::uint32_t>(v));
            for (std::size_t i = 0; i < parts[p].numbers; ++i) {
                made.values.push_back(lengths[p] * values[static_cast<int>(i)]);
            }
        }
    }
    return made;
}

/// For each vertex the first vertex at its place.
std::vector<std::uint32_t> find_places(const std::vector<glm::vec3>& positions) {
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    const auto key = [&](std::uint32_t v) {
        const glm::vec3& p = positions[v];
        return std::tuple(p.x, p.y, p.z);
    };
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        return key(a) < key(b) || (key(a) == key(b) && a < b);
    });
    std::vector<std::uint32_t> places(positions.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
        places[order[i]] = same ? places[order[i - 1]] : order[i];
    }
    return places;
}

class Simplifier {
public:
    explicit Simplifier(const MeshData& mesh)
        : positions_(*mesh.positions()), triangles_(*mesh.triangles()),
          places_(find_places(positions_)) {
        const glm::dvec3 middle = mesh.bounds().center();
        extent_ = glm::length(mesh.bounds().extent());
        points_.reserve(positions_.size());
        for (const glm::vec3& p : positions_) points_.push_back(glm::dvec3(p) - middle);
        attributes_ = attributes_of(mesh, extent_);
        alive_.assign(triangles_.size(), true);
        around_.resize(positions_.size());
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            const glm::uvec3 at = places_of(t);
            if (at.x == at.y || at.y == at.z || at.z == at.x) {
                alive_[t] = false;
                continue;
            }
            for (int i = 0; i < 3; ++i) around_[at[i]].push_back(static_cast<std::uint32_t>(t));
            ++count_;
        }
        make_quadrics();
    }

    std::size_t count() const { return count_; }
    /// The greatest error of attributes so far.
    double attribute_error() const { return std::sqrt(attribute_error_); }

    /// Contracts edges until so many triangles are left, or nothing can be contracted any more.
    void reduce(std::size_t wanted) {
        if (!queued_) {
            queued_ = true;
            stamps_.assign(positions_.size(), 0);
            for (std::uint32_t p = 0; p < positions_.size(); ++p) {
                poll_interrupts(p);
                queue(p);
            }
        }
        std::size_t steps = 0;
        while (count_ > wanted && !waiting_.empty()) {
            poll_interrupts(steps++);
            const Candidate next = waiting_.top();
            waiting_.pop();
            if (next.stamp != stamps_[next.from]) continue;
            const double greatest = greatest_share * extent_;
            if (next.cost > greatest * greatest) return;
            const std::optional<Contraction> found = contraction(
                next.from, next.to, neighbours(next.from), std::numeric_limits<double>::infinity());
            if (!found) {
                queue(next.from);
                continue;
            }
            contract(*found);
        }
    }

    std::vector<glm::uvec3> triangles() const {
        std::vector<glm::uvec3> left;
        left.reserve(count_);
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            if (alive_[t]) left.push_back(triangles_[t]);
        }
        return left;
    }

private:
    struct Candidate {
        double cost;
        std::uint32_t from, to;
        std::uint32_t stamp;

        bool operator<(const Candidate& other) const {  // the queue's top is the least
            return std::tie(cost, from, to) > std::tie(other.cost, other.from, other.to);
        }
    };
    /// A place that moves to a neighbour, with the vertices there.
    struct Contraction {
        std::uint32_t from, to;
        std::vector<std::pair<std::uint32_t, std::uint32_t>> vertices;
        double cost, attributes;
    };
    /// A neighbour of a place, and the number of triangles between them.
    struct Neighbour {
        std::uint32_t place;
        int triangles;
    };

    glm::uvec3 places_of(std::size_t t) const {
        const glm::uvec3& v = triangles_[t];
        return {places_[v.x], places_[v.y], places_[v.z]};
    }

    Gradient* gradients_of(std::uint32_t vertex) {
        return gradients_.data() + vertex * attributes_.count;
    }

    std::vector<Neighbour> neighbours(std::uint32_t place) const {
        std::vector<Neighbour> found;
        for (const std::uint32_t t : around_[place]) {
            const glm::uvec3 at = places_of(t);
            for (int i = 0; i < 3; ++i) {
                if (at[i] == place) continue;
                const auto known =
                    std::find_if(found.begin(), found.end(),
                                 [&](const Neighbour& other) { return other.place == at[i]; });
                if (known == found.end()) {
                    found.push_back({at[i], 1});
                } else {
                    ++known->triangles;
                }
            }
        }
        return found;
    }

    void make_quadrics() {
        quadrics_.resize(positions_.size());
        attribute_quadrics_.resize(positions_.size());
        gradients_.resize(positions_.size() * attributes_.count);
        for (std::size_t t = 0; t < triangles_.size(); ++t) {
            poll_interrupts(t);
            if (!alive_[t]) continue;
            const glm::uvec3 at = places_of(t);
            const glm::dvec3 p[3] = {points_[at.x], points_[at.y], points_[at.z]};
            const glm::dvec3 cross = glm::cross(p[1] - p[0], p[2] - p[0]);
            const double twice = glm::length(cross);
            if (!(twice > 0.0)) continue;
            const double area = 0.5 * twice;
            const glm::dvec3 normal = cross / twice;
            Quadric plane;
            plane.add(normal, -glm::dot(normal, p[0]), area);
            plane.weight = area;
            for (int i = 0; i < 3; ++i) quadrics_[at[i]] += plane;
            add_attributes(t, p, normal, area);
            for (int i = 0; i < 3; ++i) add_side(t, i, normal);
        }
    }

    void add_attributes(std::size_t t, const glm::dvec3 (&p)[3], const glm::dvec3& normal,
                        double area) {
        const glm::dvec3 e = p[1] - p[0];
        const glm::dvec3 f = p[2] - p[0];
        const SideSlopes sides(e, f, normal, area);
        const glm::uvec3& v = triangles_[t];
        Quadric sum;
        sum.weight = area;
        for (std::size_t k = 0; k < attributes_.count; ++k) {
            const double s = attributes_.of(v.x)[k];
            const glm::dvec3 slope = (attributes_.of(v.y)[k] - s) * sides.along_e +
                                     (attributes_.of(v.z)[k] - s) * sides.along_f;
            const double constant = s - glm::dot(slope, p[0]);
            sum.add(slope, constant, area);
            for (int i = 0; i < 3; ++i) {
                Gradient& gradient = gradients_of(v[i])[k];
                gradient.slope += area * slope;
                gradient.constant += area * constant;
            }
        }
        for (int i = 0; i < 3; ++i) attribute_quadrics_[v[i]] += sum;
    }

    /// A plane upright over a side that is a border or a seam: its ends may move along it.
    void add_side(std::size_t t, int i, const glm::dvec3& normal) {
        const std::uint32_t a = triangles_[t][i];
        const std::uint32_t b = triangles_[t][(i + 1) % 3];
        int triangles = 0;
        bool seam = false;
        for (const std::uint32_t other : around_[places_[a]]) {
            const glm::uvec3& v = triangles_[other];
            int ends = 0;
            bool same = true;
            for (int c = 0; c < 3; ++c) {
                if (places_[v[c]] == places_[a]) ++ends, same = same && v[c] == a;
                if (places_[v[c]] == places_[b]) ++ends, same = same && v[c] == b;
            }
            if (ends < 2) continue;
            ++triangles;
            seam = seam || !same;
        }
        if (triangles != 1 && !seam) return;
        const glm::dvec3 along = points_[b] - points_[a];
        const double length = glm::length(along);
        const glm::dvec3 upright = glm::cross(along, normal) / length;
        Quadric plane;
        plane.add(upright, -glm::dot(upright, points_[a]),
                  length * length * (triangles == 1 ? border_weight : seam_weight));
        quadrics_[places_[a]] += plane;
        quadrics_[places_[b]] += plane;
    }

    /// The mean square by which the attributes of a vertex would be off at another vertex.
    double attribute_cost(std::uint32_t vertex, std::uint32_t at) {
        const Quadric& quadric = attribute_quadrics_[vertex];
        if (!(quadric.weight > 0.0)) return 0.0;
        const glm::dvec3& p = points_[at];
        double sum = quadric.at(p);
        const std::span<const double> values = attributes_.of(at);
        const Gradient* gradients = gradients_of(vertex);
        for (std::size_t k = 0; k < attributes_.count; ++k) {
            const double s = values[k];
            sum += s * (quadric.weight * s -
                        2.0 * (glm::dot(gradients[k].slope, p) + gradients[k].constant));
        }
        return std::max(0.0, sum / quadric.weight);
    }

    /// The contraction of an edge, if it costs less than `most` and leaves no tear and no fold.
    /// @param near the neighbours of `from`.
    std::optional<Contraction> contraction(std::uint32_t from, std::uint32_t to,
                                           const std::vector<Neighbour>& near, double most) {
        int shared = 0;
        bool border = false;
        for (const Neighbour& neighbour : near) {
            if (neighbour.triangles > 2) return std::nullopt;
            border = border || neighbour.triangles == 1;
            if (neighbour.place == to) shared = neighbour.triangles;
        }
        if (shared == 0 || (border && shared != 1)) return std::nullopt;
        Contraction made{from, to, {}, 0.0, 0.0};
        if (!find_vertices(made)) return std::nullopt;
        const Quadric& quadric = quadrics_[from];
        const double moved = glm::distance(points_[from], points_[to]);
        const double planes =
            quadric.weight > 0.0 ? std::max(0.0, quadric.at(points_[to]) / quadric.weight) : 0.0;
        for (const auto& [vertex, other] : made.vertices) {
            made.attributes = std::max(made.attributes, attribute_cost(vertex, other));
        }
        made.cost = planes + made.attributes + share_of_length * moved * moved;
        if (!(made.cost < most)) return std::nullopt;
        // The link condition (T. Dey et al., "Topology Preserving Edge Contraction", 1999).
        const std::vector<Neighbour> beyond = neighbours(to);
        int common = 0;
        for (const Neighbour& neighbour : beyond) {
            common +=
                static_cast<int>(std::any_of(near.begin(), near.end(), [&](const Neighbour& other) {
                    return other.place == neighbour.place;
                }));
        }
        if (common != shared) return std::nullopt;
        const std::size_t joined =
            near.size() + beyond.size() - 2 - static_cast<std::size_t>(common);
        if (joined > std::max(most_neighbours, beyond.size())) return std::nullopt;
        if (folds(from, to)) return std::nullopt;
        return made;
    }

    /// Each vertex at the place must have one neighbour at the other.
    bool find_vertices(Contraction& made) const {
        for (const std::uint32_t t : around_[made.from]) {
            std::uint32_t own = 0;
            std::optional<std::uint32_t> other;
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t v = triangles_[t][i];
                if (places_[v] == made.from) own = v;
                if (places_[v] == made.to) other = v;
            }
            if (!other) continue;
            const auto known = std::find_if(made.vertices.begin(), made.vertices.end(),
                                            [&](const auto& pair) { return pair.first == own; });
            if (known == made.vertices.end()) {
                made.vertices.emplace_back(own, *other);
            } else if (known->second != *other) {
                return false;
            }
        }
        return std::all_of(
            around_[made.from].begin(), around_[made.from].end(), [&](std::uint32_t t) {
                for (int i = 0; i < 3; ++i) {
                    const std::uint32_t v = triangles_[t][i];
                    if (places_[v] != made.from) continue;
                    const bool known =
                        std::any_of(made.vertices.begin(), made.vertices.end(),
                                    [&](const auto& pair) { return pair.first == v; });
                    if (!known) return false;
                }
                return true;
            });
    }

    /// Whether a triangle would turn too far, or lose its area.
    bool folds(std::uint32_t from, std::uint32_t to) const {
        for (const std::uint32_t t : around_[from]) {
            const glm::uvec3 at = places_of(t);
            if (at.x == to || at.y == to || at.z == to) continue;
            glm::dvec3 before[3];
            glm::dvec3 after[3];
            for (int i = 0; i < 3; ++i) {
                before[i] = points_[at[i]];
                after[i] = at[i] == from ? points_[to] : before[i];
            }
            const glm::dvec3 old = glm::cross(before[1] - before[0], before[2] - before[0]);
            const glm::dvec3 made = glm::cross(after[1] - after[0], after[2] - after[0]);
            if (!(glm::dot(made, old) > least_cosine * glm::length(made) * glm::length(old))) {
                return true;
            }
        }
        return false;
    }

    /// Queues the best contraction of a place.
    void queue(std::uint32_t place) {
        ++stamps_[place];
        if (around_[place].empty()) return;
        const std::vector<Neighbour> near = neighbours(place);
        std::optional<Contraction> best;
        for (const Neighbour& neighbour : near) {
            auto found = contraction(place, neighbour.place, near,
                                     best ? best->cost : std::numeric_limits<double>::infinity());
            if (found) best = std::move(found);
        }
        if (best) waiting_.push({best->cost, place, best->to, stamps_[place]});
    }

    void contract(const Contraction& made) {
        attribute_error_ = std::max(attribute_error_, made.attributes);
        for (const auto& [vertex, other] : made.vertices) {
            attribute_quadrics_[other] += attribute_quadrics_[vertex];
            const Gradient* from = gradients_of(vertex);
            Gradient* to = gradients_of(other);
            for (std::size_t k = 0; k < attributes_.count; ++k) {
                to[k].slope += from[k].slope;
                to[k].constant += from[k].constant;
            }
        }
        quadrics_[made.to] += quadrics_[made.from];
        std::vector<std::uint32_t> touched;
        for (const Neighbour& neighbour : neighbours(made.from)) touched.push_back(neighbour.place);
        for (const std::uint32_t t : around_[made.from]) {
            const glm::uvec3 at = places_of(t);
            if (at.x == made.to || at.y == made.to || at.z == made.to) {
                alive_[t] = false;
                --count_;
                for (int i = 0; i < 3; ++i) {
                    if (at[i] != made.from) std::erase(around_[at[i]], t);
                }
                continue;
            }
            for (int i = 0; i < 3; ++i) {
                std::uint32_t& v = triangles_[t][i];
                for (const auto& [vertex, other] : made.vertices) {
                    if (v == vertex) {
                        v = other;
                        break;
                    }
                }
            }
            around_[made.to].push_back(t);
        }
        around_[made.from].clear();
        ++stamps_[made.from];
        for (const Neighbour& neighbour : neighbours(made.to)) touched.push_back(neighbour.place);
        std::sort(touched.begin(), touched.end());
        touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
        for (const std::uint32_t place : touched) queue(place);
    }

    const std::vector<glm::vec3>& positions_;
    std::vector<glm::uvec3> triangles_;  ///< with vertices as they are now
    std::vector<std::uint32_t> places_;
    std::vector<glm::dvec3> points_;  ///< relative to the middle
    double extent_ = 0.0;
    Attributes attributes_;
    std::vector<bool> alive_;
    std::vector<std::vector<std::uint32_t>> around_;  ///< the triangles at each place
    std::size_t count_ = 0;
    std::vector<Quadric> quadrics_;            ///< of places
    std::vector<Quadric> attribute_quadrics_;  ///< of vertices
    std::vector<Gradient> gradients_;          ///< of vertices: one for each attribute
    std::priority_queue<Candidate> waiting_;
    std::vector<std::uint32_t> stamps_;  ///< a candidate with an older one does not count
    bool queued_ = false;
    double attribute_error_ = 0.0;  ///< squared
};

}  // namespace

std::vector<MeshLevel> simplified_levels(const MeshData& mesh, double ratio) {
    expect(ratio >= 0.1 && ratio <= 0.9, "a ratio from 0.1 to 0.9", describe(ratio));
    std::vector<MeshLevel> levels;
    Simplifier simplifier(mesh);
    double last = static_cast<double>(mesh.triangles()->size());
    double error = 0.0;
    while (true) {
        const auto wanted = static_cast<std::size_t>(ratio * last);
        simplifier.reduce(wanted);
        const auto left = static_cast<double>(simplifier.count());
        if (left == 0.0 || left > worthwhile * last) return levels;
        std::vector<glm::uvec3> triangles = simplifier.triangles();
        error = std::max({error, simplifier.attribute_error(),
                          surface_distance(*mesh.positions(), *mesh.triangles(), triangles)});
        levels.push_back({std::move(triangles), error});
        last = left;
        if (simplifier.count() > wanted) return levels;  // nothing more can be contracted
    }
}

}  // namespace cubecam
