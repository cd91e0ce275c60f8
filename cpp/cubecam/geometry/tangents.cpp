#include "cubecam/geometry/tangents.hpp"

#include "cubecam/core/interrupts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <tuple>

namespace cubecam {

namespace {

constexpr std::uint32_t no_one = std::numeric_limits<std::uint32_t>::max();

/// A triangle in the plane of its texture coordinates.
struct MappedTriangle {
    glm::dvec3 along_u{0.0};  ///< towards +u, unit length
    bool mirrored = false;    ///< its uvs run clockwise
    bool pliable = true;      ///< without a direction of its own, so it joins any group
    std::array<std::uint32_t, 3> corners{};
    /// The triangle at the other side of the edge from each corner to the next.
    std::array<std::uint32_t, 3> neighbors{no_one, no_one, no_one};
    std::array<std::uint32_t, 3> groups{no_one, no_one, no_one};  ///< of each corner

    int place_of(std::uint32_t vertex) const {
        return corners[0] == vertex ? 0 : corners[1] == vertex ? 1 : 2;
    }
};

struct TangentGroup {
    std::uint32_t vertex;
    bool mirrored;
    glm::dvec3 sum{0.0};
};

glm::dvec3 unit_or_zero(const glm::dvec3& vector) {
    const double length = glm::length(vector);
    return length > 0.0 ? vector / length : glm::dvec3(0.0);
}

glm::dvec3 in_plane(const glm::dvec3& vector, const glm::dvec3& normal) {
    return unit_or_zero(vector - glm::dot(normal, vector) * normal);
}

/// The number of the first vertex with the same values, for each vertex.
std::vector<std::uint32_t> welded(const std::vector<glm::vec3>& positions,
                                  const std::vector<glm::vec3>& normals,
                                  const std::vector<glm::vec2>& uvs) {
    const auto values = [&](std::uint32_t i) {
        const glm::vec3& p = positions[i];
        const glm::vec3& n = normals[i];
        return std::tuple(p.x, p.y, p.z, n.x, n.y, n.z, uvs[i].x, uvs[i].y);
    };
    std::vector<std::uint32_t> order(positions.size());
    std::iota(order.begin(), order.end(), 0U);
    std::size_t step = 0;
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
        poll_interrupts(step++);
        const auto left = values(a);
        const auto right = values(b);
        return left != right ? left < right : a < b;
    });
    std::vector<std::uint32_t> first(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        poll_interrupts(i);
        const bool same = i > 0 && values(order[i]) == values(order[i - 1]);
        first[order[i]] = same ? first[order[i - 1]] : order[i];
    }
    return first;
}

MappedTriangle mapped(const std::array<glm::dvec3, 3>& p, const std::array<glm::dvec2, 3>& t) {
    MappedTriangle made;
    const glm::dvec2 t1 = t[1] - t[0];
    const glm::dvec2 t2 = t[2] - t[0];
    const double area = t1.x * t2.y - t1.y * t2.x;
    made.mirrored = area < 0.0;
    // The derivative of the position by u, times the area of the uvs.
    const glm::dvec3 by_u = t2.y * (p[1] - p[0]) - t1.y * (p[2] - p[0]);
    const glm::dvec3 by_v = t1.x * (p[2] - p[0]) - t2.x * (p[1] - p[0]);
    made.along_u = unit_or_zero(made.mirrored ? -by_u : by_u);
    made.pliable = !(area != 0.0 && glm::length(by_u) > 0.0 && glm::length(by_v) > 0.0);
    return made;
}

/// Finds the triangles that share an edge, each with at most one at every edge, and with the same
/// winding.
void find_neighbors(std::vector<MappedTriangle>& triangles) {
    struct Edge {
        std::uint32_t low, high, triangle, corner;
        bool operator<(const Edge& other) const {
            return std::tie(low, high, triangle, corner) <
                   std::tie(other.low, other.high, other.triangle, other.corner);
        }
    };
    std::vector<Edge> edges;
    edges.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        poll_interrupts(t);
        for (std::uint32_t c = 0; c < 3; ++c) {
            const std::uint32_t from = triangles[t].corners[c];
            const std::uint32_t to = triangles[t].corners[(c + 1) % 3];
            if (from != to) edges.push_back({std::min(from, to), std::max(from, to), t, c});
        }
    }
    std::size_t step = 0;
    std::sort(edges.begin(), edges.end(), [&step](const Edge& a, const Edge& b) {
        poll_interrupts(step++);
        return a < b;
    });
    const auto start_of = [&](const Edge& edge) {
        return triangles[edge.triangle].corners[edge.corner];
    };
    for (std::size_t begin = 0; begin < edges.size();) {
        poll_interrupts(step++);
        std::size_t end = begin + 1;
        while (end < edges.size() && edges[end].low == edges[begin].low &&
               edges[end].high == edges[begin].high) {
            ++end;
        }
        for (std::size_t a = begin; a < end; ++a) {
            auto& mine = triangles[edges[a].triangle].neighbors[edges[a].corner];
            for (std::size_t b = a + 1; b < end && mine == no_one; ++b) {
                auto& other = triangles[edges[b].triangle].neighbors[edges[b].corner];
                if (other != no_one || start_of(edges[a]) == start_of(edges[b])) continue;
                mine = edges[b].triangle;
                other = edges[a].triangle;
            }
        }
        begin = end;
    }
}

/// Collects the triangles around one corner, over edges at that corner.
void fill_group(std::vector<MappedTriangle>& triangles, std::uint32_t first,
                const TangentGroup& group, std::uint32_t number) {
    std::vector<std::uint32_t> open{first};
    while (!open.empty()) {
        const std::uint32_t next = open.back();
        open.pop_back();
        if (next == no_one) continue;
        MappedTriangle& triangle = triangles[next];
        const auto place = static_cast<std::size_t>(triangle.place_of(group.vertex));
        if (triangle.groups[place] != no_one) continue;
        const bool free = std::all_of(triangle.groups.begin(), triangle.groups.end(),
                                      [](std::uint32_t g) { return g == no_one; });
        // The first group that such a triangle joins decides its orientation.
        if (triangle.pliable && free) triangle.mirrored = group.mirrored;
        if (triangle.mirrored != group.mirrored) continue;
        triangle.groups[place] = number;
        open.push_back(triangle.neighbors[place]);
        open.push_back(triangle.neighbors[(place + 2) % 3]);
    }
}

}  // namespace

glm::dvec3 any_tangent(const glm::dvec3& normal) {
    const glm::dvec3 size = glm::abs(normal);
    const glm::dvec3 axis = size.x <= size.y && size.x <= size.z ? glm::dvec3(1.0, 0.0, 0.0)
                            : size.y <= size.z                   ? glm::dvec3(0.0, 1.0, 0.0)
                                                                 : glm::dvec3(0.0, 0.0, 1.0);
    return in_plane(axis, normal);
}

TangentSpace find_tangents(const std::vector<glm::vec3>& positions,
                           const std::vector<glm::vec3>& normals, const std::vector<glm::vec2>& uvs,
                           const std::vector<glm::uvec3>& triangles) {
    const std::vector<std::uint32_t> first = welded(positions, normals, uvs);
    std::vector<MappedTriangle> faces;
    faces.reserve(triangles.size());
    for (const glm::uvec3& t : triangles) {
        poll_interrupts(faces.size());
        const auto position = [&](int i) { return glm::dvec3(positions[t[i]]); };
        const auto uv = [&](int i) { return glm::dvec2(uvs[t[i]]); };
        faces.push_back(mapped({position(0), position(1), position(2)}, {uv(0), uv(1), uv(2)}));
        faces.back().corners = {first[t.x], first[t.y], first[t.z]};
    }
    find_neighbors(faces);

    std::vector<TangentGroup> groups;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        poll_interrupts(f);
        if (faces[f].pliable) continue;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            if (faces[f].groups[corner] != no_one) continue;
            const auto number = static_cast<std::uint32_t>(groups.size());
            groups.push_back({faces[f].corners[corner], faces[f].mirrored});
            fill_group(faces, f, groups.back(), number);
        }
    }
    std::size_t step = 0;
    for (const MappedTriangle& face : faces) {
        poll_interrupts(step++);
        if (face.pliable) continue;
        for (std::size_t corner = 0; corner < 3; ++corner) {
            TangentGroup& group = groups[face.groups[corner]];
            const glm::dvec3 normal(normals[group.vertex]);
            const auto at = [&](std::size_t c) {
                return glm::dvec3(positions[face.corners[c % 3]]);
            };
            const glm::dvec3 to_next = in_plane(at(corner + 1) - at(corner), normal);
            const glm::dvec3 to_last = in_plane(at(corner + 2) - at(corner), normal);
            const double angle = std::acos(std::clamp(glm::dot(to_next, to_last), -1.0, 1.0));
            group.sum += angle * in_plane(face.along_u, normal);
        }
    }

    // Triangles that joined no group take a tangent that another triangle has at the same vertex.
    std::vector<std::uint32_t> some_group(positions.size(), no_one);
    for (std::uint32_t g = 0; g < groups.size(); ++g) {
        std::uint32_t& known = some_group[groups[g].vertex];
        if (known == no_one) known = g;
    }
    const auto tangent_at = [&](std::uint32_t vertex, std::uint32_t group) {
        if (group == no_one) group = some_group[first[vertex]];
        const glm::dvec3 normal(normals[vertex]);
        const glm::dvec3 found =
            group == no_one ? glm::dvec3(0.0) : in_plane(groups[group].sum, normal);
        const bool mirrored = group != no_one && groups[group].mirrored;
        const glm::vec3 tangent(found == glm::dvec3(0.0) ? any_tangent(normal) : found);
        return glm::vec4(tangent, mirrored ? -1.0F : 1.0F);
    };

    TangentSpace space;
    space.triangles = triangles;
    space.tangents.resize(positions.size());
    space.sources.resize(positions.size());
    std::iota(space.sources.begin(), space.sources.end(), 0U);
    std::vector<bool> known(positions.size(), false);
    std::vector<std::uint32_t> next(positions.size(), no_one);  // the next copy of the same vertex
    for (std::size_t f = 0; f < triangles.size(); ++f) {
        poll_interrupts(f);
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t vertex = triangles[f][corner];
            const glm::vec4 tangent =
                tangent_at(vertex, faces[f].groups[static_cast<std::size_t>(corner)]);
            if (!known[vertex]) {
                known[vertex] = true;
                space.tangents[vertex] = tangent;
            }
            std::uint32_t at = vertex;
            while (space.tangents[at] != tangent && next[at] != no_one) at = next[at];
            if (space.tangents[at] != tangent) {
                const auto added = static_cast<std::uint32_t>(space.tangents.size());
                next[at] = added;
                next.push_back(no_one);
                space.tangents.push_back(tangent);
                space.sources.push_back(vertex);
                at = added;
            }
            space.triangles[f][corner] = at;
        }
    }
    for (std::uint32_t vertex = 0; vertex < positions.size(); ++vertex) {
        if (!known[vertex]) space.tangents[vertex] = tangent_at(vertex, no_one);
    }
    if (space.sources.size() == positions.size()) space.sources.clear();
    return space;
}

}  // namespace cubecam
