#include "cubecam/core/checks.hpp"
#include "cubecam/core/interrupts.hpp"
#include "cubecam/core/memory.hpp"
#include "cubecam/geometry/primitives.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cubecam::primitives {

namespace {

constexpr int most_subdivisions = 9;  // 5,242,880 triangles

/// Unit directions and the triangles between them; no direction occurs twice.
struct Icosahedron {
    std::vector<glm::dvec3> directions;
    std::vector<glm::uvec3> triangles;
};

/// The twelve corners (0, +-1, +-golden ratio) and their rotations.
Icosahedron icosahedron() {
    constexpr double g = std::numbers::phi;
    Icosahedron solid{
        {{-1, g, 0},
         {1, g, 0},
         {-1, -g, 0},
         {1, -g, 0},
         {0, -1, g},
         {0, 1, g},
         {0, -1, -g},
         {0, 1, -g},
         {g, 0, -1},
         {g, 0, 1},
         {-g, 0, -1},
         {-g, 0, 1}},
        {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
         {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
         {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}},
    };
    for (glm::dvec3& direction : solid.directions) direction = glm::normalize(direction);
    return solid;
}

/// Splits each triangle into four and moves the new corners out to the sphere.
void subdivide(Icosahedron& solid) {
    std::unordered_map<std::uint64_t, std::uint32_t> middles;
    middles.reserve(solid.triangles.size() * 3 / 2);
    const auto middle = [&](std::uint32_t a, std::uint32_t b) {
        const auto [low, high] = std::minmax(a, b);
        const std::uint64_t edge = (std::uint64_t{low} << 32) | high;
        const auto next = static_cast<std::uint32_t>(solid.directions.size());
        const auto [found, added] = middles.try_emplace(edge, next);
        if (added) {
            const glm::dvec3 sum = solid.directions[low] + solid.directions[high];
            solid.directions.push_back(glm::normalize(sum));
        }
        return found->second;
    };
    std::vector<glm::uvec3> finer;
    finer.reserve(4 * solid.triangles.size());
    for (const glm::uvec3& t : solid.triangles) {
        poll_interrupts(finer.size() / 4);
        const std::uint32_t ab = middle(t.x, t.y);
        const std::uint32_t bc = middle(t.y, t.z);
        const std::uint32_t ca = middle(t.z, t.x);
        finer.insert(finer.end(), {{t.x, ab, ca}, {t.y, bc, ab}, {t.z, ca, bc}, {ab, bc, ca}});
    }
    solid.triangles = std::move(finer);
}

/// The uv of a direction, as in sphere(): u runs from -Z through -X, +Z (0.5) and +X back to -Z, v
/// from the south pole up.
glm::dvec2 uv_of(const glm::dvec3& d) {
    return {0.5 + std::atan2(d.x, d.z) / (2.0 * std::numbers::pi),
            0.5 + std::asin(std::clamp(d.y, -1.0, 1.0)) / std::numbers::pi};
}

bool is_pole(const glm::dvec3& d) { return d.x * d.x + d.z * d.z < 1e-20; }

/// The u of a triangle's corners, continued beyond 1 where the triangle crosses the seam; a pole
/// gets the average of the other two.
std::array<double, 3> unwrapped_us(const std::array<glm::dvec3, 3>& corners) {
    std::array<double, 3> u{};
    double largest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        u[i] = uv_of(corners[i]).x;
        if (!is_pole(corners[i])) largest = std::max(largest, u[i]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (largest - u[i] > 0.5) u[i] += 1.0;
    }
    for (std::size_t i = 0; i < 3; ++i) {
        if (is_pole(corners[i])) u[i] = 0.5 * (u[(i + 1) % 3] + u[(i + 2) % 3]);
    }
    return u;
}

}  // namespace

MeshData icosphere(double radius, int subdivisions) {
    expect_positive(radius, "radius");
    expect(subdivisions >= 0 && subdivisions <= most_subdivisions,
           "subdivisions from 0 to " + std::to_string(most_subdivisions),
           std::to_string(subdivisions));
    // A triangle, half a vertex, and its share of the map of edges, twice where vectors grow.
    const std::int64_t triangles = std::int64_t{20} << (2 * subdivisions);
    check_memory(100.0 * static_cast<double>(triangles), std::to_string(triangles) + " triangles");
    Icosahedron solid = icosahedron();
    for (int i = 0; i < subdivisions; ++i) subdivide(solid);

    MeshData::Arrays arrays;
    for (const glm::dvec3& direction : solid.directions) {
        poll_interrupts(arrays.positions.size());
        arrays.positions.emplace_back(radius * direction);
        arrays.normals.emplace_back(direction);
        arrays.uvs.emplace_back(uv_of(direction));
    }
    // A corner whose triangle lies across the seam, or at a pole, needs a u of its own there.
    std::unordered_map<std::uint64_t, std::uint32_t> doubles;
    for (glm::uvec3 t : solid.triangles) {
        poll_interrupts(arrays.triangles.size());
        std::array<glm::dvec3, 3> corners{};
        for (int i = 0; i < 3; ++i) corners[std::size_t(i)] = solid.directions[t[i]];
        const std::array<double, 3> us = unwrapped_us(corners);
        for (int i = 0; i < 3; ++i) {
            const glm::vec2 uv(us[std::size_t(i)], arrays.uvs[t[i]].y);
            if (uv == arrays.uvs[t[i]]) continue;
            const auto next = static_cast<std::uint32_t>(arrays.positions.size());
            const bool pole = is_pole(corners[std::size_t(i)]);
            const std::uint64_t key = pole ? std::uint64_t{next} << 32 : t[i];
            const auto [found, added] = doubles.try_emplace(key, next);
            if (added) {
                arrays.positions.emplace_back(radius * corners[std::size_t(i)]);
                arrays.normals.emplace_back(corners[std::size_t(i)]);
                arrays.uvs.push_back(uv);
            }
            t[i] = found->second;
        }
        arrays.triangles.push_back(t);
    }
    return MeshData(std::move(arrays));
}

}  // namespace cubecam::primitives
