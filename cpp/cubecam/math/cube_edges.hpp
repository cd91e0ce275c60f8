/// Which texels touch across the twelve edges of a cube, derived from the axes of cube_face.hpp.
#pragma once

#include "cubecam/math/cube_face.hpp"

#include <array>
#include <cstddef>

namespace cubecam {

/// The sides of a face: left is before column 0, right is from column N on, top is before row 0,
/// bottom is from row N on.
enum class Side : int { left, right, top, bottom };

/// The neighbour beyond one side of a face.
struct CubeEdge {
    Face face;
    bool along_rows;  ///< the shared edge is a column of the neighbour, not a row
    bool at_end;      ///< the edge is the neighbour's last column (row), not its first
    bool reversed;    ///< moving along the edge, the neighbour's row (column) shrinks
};

namespace detail {

constexpr float dot3(const glm::vec3& a, const glm::vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

constexpr CubeEdge find_edge(Face from, Side side) {
    const FaceAxes& axes = face_axes(from);
    const bool columns = side == Side::left || side == Side::right;
    const float sign = side == Side::left || side == Side::top ? -1.0f : 1.0f;
    const glm::vec3 across = columns ? axes.s_axis : axes.t_axis;
    const glm::vec3 along = columns ? axes.t_axis : axes.s_axis;
    for (const Face face : all_faces) {
        const FaceAxes& other = face_axes(face);
        if (dot3(other.major, across) * sign < 0.5f) continue;
        const float on_s = dot3(other.s_axis, axes.major);
        if (on_s != 0) return {face, true, on_s > 0, dot3(other.t_axis, along) < 0};
        return {face, false, dot3(other.t_axis, axes.major) > 0, dot3(other.s_axis, along) < 0};
    }
    return {from, false, false, false};  // not reached: each side has a neighbour
}

constexpr std::array<std::array<CubeEdge, 4>, face_count> find_edges() {
    std::array<std::array<CubeEdge, 4>, face_count> edges{};
    for (const Face face : all_faces) {
        for (int side = 0; side < 4; ++side) {
            edges[face_index(face)][static_cast<std::size_t>(side)] =
                find_edge(face, static_cast<Side>(side));
        }
    }
    return edges;
}

}  // namespace detail

inline constexpr std::array<std::array<CubeEdge, 4>, face_count> cube_edges = detail::find_edges();

struct TexelPlace {
    Face face;
    int row;
    int column;
};

/// The texel at (row, column) if the neighbour were unfolded into the face's plane. Exactly one of
/// row and column is outside 0..N-1: -1 and N are the texels at the neighbour's edge, -2 and N + 1
/// those behind them, as far as its opposite edge.
constexpr TexelPlace texel_beyond_edge(Face face, int row, int column, int size) {
    const Side side = column < 0       ? Side::left
                      : column >= size ? Side::right
                      : row < 0        ? Side::top
                                       : Side::bottom;
    const bool columns = side == Side::left || side == Side::right;
    const int along = columns ? row : column;
    const int across = columns ? column : row;
    const int beyond = across < 0 ? -1 - across : across - size;
    const int depth = beyond < size ? beyond : size - 1;
    const CubeEdge& edge = cube_edges[face_index(face)][static_cast<std::size_t>(side)];
    const int moving = edge.reversed ? size - 1 - along : along;
    const int fixed = edge.at_end ? size - 1 - depth : depth;
    return edge.along_rows ? TexelPlace{edge.face, moving, fixed}
                           : TexelPlace{edge.face, fixed, moving};
}

}  // namespace cubecam
