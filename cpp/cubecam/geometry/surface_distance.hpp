#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cubecam {

/// Triangles in a tree of boxes, in which the nearest point of their surface is found.
///
/// The triangles may not change while it lives.
class NearestTriangles {
public:
    NearestTriangles(const std::vector<glm::vec3>& positions,
                     const std::vector<glm::uvec3>& triangles);

    /// The distance of a point, and triangles that are so near: one, or some of those that share
    /// the nearest point.
    struct Found {
        static constexpr std::size_t most = 8;
        double distance;
        std::array<std::uint32_t, most> triangles;
        std::size_t count;
    };
    /// @param tie triangles may be farther away than the nearest one by so much.
    Found find(const glm::dvec3& point, double tie) const;
    /// The distance of a point from one triangle.
    double distance(const glm::dvec3& point, std::uint32_t triangle) const;

private:
    struct Box {
        glm::dvec3 low, high;
        std::uint32_t first;  ///< of a leaf: into order_; else: the second child, after the first
        std::uint32_t count;  ///< of a leaf: of triangles; else 0
    };
    std::array<glm::dvec3, 3> corners(std::uint32_t triangle) const;
    std::uint32_t build(std::size_t first, std::size_t last);

    const std::vector<glm::vec3>& positions_;
    const std::vector<glm::uvec3>& triangles_;
    std::vector<glm::vec3> middles_;
    std::vector<std::uint32_t> order_;
    std::vector<Box> boxes_;
};

/// An upper bound for the greatest distance of a point of either surface from the other one, their
/// Hausdorff distance. Both are triangles between the same vertices. It is at most 5 % larger than
/// the distance itself, where that is more than 1e-4 of the vertices' extent.
///
/// A point of a triangle is at most as far from another triangle as the farthest of the corners,
/// since that distance is convex. Where this bound is too large for the triangles that are nearest
/// to the corners, the triangle is cut where the nearest one changes (after M. Tang, M. Lee and
/// Y. Kim, "Interactive Hausdorff Distance Computation for General Polygonal Models", SIGGRAPH
/// 2009). Polls for interrupts.
double surface_distance(const std::vector<glm::vec3>& positions,
                        const std::vector<glm::uvec3>& first,
                        const std::vector<glm::uvec3>& second);

}  // namespace cubecam
