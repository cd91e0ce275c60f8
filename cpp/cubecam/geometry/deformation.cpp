#include "cubecam/geometry/deformation.hpp"

#include "cubecam/core/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <utility>

namespace cubecam {

namespace {

constexpr std::size_t vertex_lanes = 64;  ///< vertices that a loop of the kernels has
/// A thread costs as much as a few thousand vertices.
constexpr std::size_t vertices_at_once = 8192;

/// A number of each vertex of a block.
using VertexLane = std::array<float, vertex_lanes>;

/// The mean matrices of a block of vertices, number by number.
using MeanMatrices = std::array<VertexLane, 12>;

void blend(const Influences& influences, std::span<const JointMatrix> joints, std::size_t begin,
           std::size_t count, MeanMatrices& means) {
    const std::size_t each = influences.count();
    const std::uint16_t* joint = influences.joints().data() + begin * each;
    const float* weight = influences.weights().data() + begin * each;
    for (std::size_t v = 0; v < count; ++v, joint += each, weight += each) {
        JointMatrix mean{};
        float total = 0.0F;
        for (std::size_t i = 0; i < each; ++i) {
            if (weight[i] == 0.0F) continue;
            const JointMatrix& matrix = joints[joint[i]];
            for (std::size_t n = 0; n < 12; ++n) mean[n] += weight[i] * matrix[n];
            total += weight[i];
        }
        if (total == 0.0F) {
            mean = joints[0];
            total = 1.0F;
        }
        for (std::size_t n = 0; n < 12; ++n) means[n][v] = mean[n] / total;
    }
}

void move_positions(const MeanMatrices& m, const glm::vec3* from, std::size_t count,
                    glm::vec3* to) {
    for (std::size_t v = 0; v < count; ++v) {
        const float x = from[v].x;
        const float y = from[v].y;
        const float z = from[v].z;
        to[v].x = m[0][v] * x + m[1][v] * y + m[2][v] * z + m[3][v];
        to[v].y = m[4][v] * x + m[5][v] * y + m[6][v] * z + m[7][v];
        to[v].z = m[8][v] * x + m[9][v] * y + m[10][v] * z + m[11][v];
    }
}

/// Divides the linear parts by their greatest number, so that products of two numbers neither
/// overflow nor vanish. Directions do not depend on the factor.
void scale_linear_parts(MeanMatrices& m) {
    for (std::size_t v = 0; v < vertex_lanes; ++v) {
        float most = 0.0F;
        for (const std::size_t n : {0, 1, 2, 4, 5, 6, 8, 9, 10}) {
            most = std::max(most, std::abs(m[n][v]));
        }
        const float factor = most > 0.0F ? 1.0F / most : 0.0F;
        for (const std::size_t n : {0, 1, 2, 4, 5, 6, 8, 9, 10}) m[n][v] *= factor;
    }
}

/// The cofactors of the linear parts, row by row.
using Cofactors = std::array<VertexLane, 9>;

void find_cofactors(const MeanMatrices& m, Cofactors& c, VertexLane& side) {
    for (std::size_t v = 0; v < vertex_lanes; ++v) {
        c[0][v] = m[5][v] * m[10][v] - m[6][v] * m[9][v];
        c[1][v] = m[6][v] * m[8][v] - m[4][v] * m[10][v];
        c[2][v] = m[4][v] * m[9][v] - m[5][v] * m[8][v];
        c[3][v] = m[9][v] * m[2][v] - m[10][v] * m[1][v];
        c[4][v] = m[10][v] * m[0][v] - m[8][v] * m[2][v];
        c[5][v] = m[8][v] * m[1][v] - m[9][v] * m[0][v];
        c[6][v] = m[1][v] * m[6][v] - m[2][v] * m[5][v];
        c[7][v] = m[2][v] * m[4][v] - m[0][v] * m[6][v];
        c[8][v] = m[0][v] * m[5][v] - m[1][v] * m[4][v];
        const float determinant = m[0][v] * c[0][v] + m[1][v] * c[1][v] + m[2][v] * c[2][v];
        side[v] = determinant < 0.0F ? -1.0F : 1.0F;
    }
}

/// Directions below this length, of numbers of about 1, are rounding errors.
constexpr float least_square = 1e-30F;

/// The factor that gives a vector unit length; 0 for one without a length.
inline float unit_factor(float x, float y, float z) {
    const float square = x * x + y * y + z * z;
    return square > least_square ? 1.0F / std::sqrt(square) : 0.0F;
}

bool move_normals(const Cofactors& c, const VertexLane& side, const glm::vec3* from,
                  std::size_t count, glm::vec3* to) {
    bool lost = false;
    for (std::size_t v = 0; v < count; ++v) {
        const float x = c[0][v] * from[v].x + c[1][v] * from[v].y + c[2][v] * from[v].z;
        const float y = c[3][v] * from[v].x + c[4][v] * from[v].y + c[5][v] * from[v].z;
        const float z = c[6][v] * from[v].x + c[7][v] * from[v].y + c[8][v] * from[v].z;
        const float factor = side[v] * unit_factor(x, y, z);
        lost |= factor == 0.0F;
        to[v].x = factor * x;
        to[v].y = factor * y;
        to[v].z = factor * z;
    }
    return lost;
}

bool move_tangents(const MeanMatrices& m, const VertexLane& side, const glm::vec4* from,
                   std::size_t count, glm::vec4* to) {
    bool lost = false;
    for (std::size_t v = 0; v < count; ++v) {
        const float x = m[0][v] * from[v].x + m[1][v] * from[v].y + m[2][v] * from[v].z;
        const float y = m[4][v] * from[v].x + m[5][v] * from[v].y + m[6][v] * from[v].z;
        const float z = m[8][v] * from[v].x + m[9][v] * from[v].y + m[10][v] * from[v].z;
        const float factor = unit_factor(x, y, z);
        lost |= factor == 0.0F;
        to[v].x = factor * x;
        to[v].y = factor * y;
        to[v].z = factor * z;
        // cross(M a, M b) is the cofactors times cross(a, b): mirrored, the normal changes its side
        // and the third direction does not.
        to[v].w = side[v] * from[v].w;
    }
    return lost;
}

}  // namespace

JointMatrix to_joint_matrix(const glm::dmat4& matrix) {
    JointMatrix rows;
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 4; ++column) {
            rows[static_cast<std::size_t>(4 * row + column)] =
                static_cast<float>(matrix[column][row]);
        }
    }
    return rows;
}

SkinnedVertices skin(const SkinInput& mesh, const Influences& influences,
                     std::span<const JointMatrix> joints) {
    const std::size_t vertices = mesh.positions->size();
    SkinnedVertices result;
    result.positions.resize(vertices);
    if (mesh.normals != nullptr) result.normals.resize(vertices);
    if (mesh.tangents != nullptr) result.tangents.resize(vertices);
    result.sides.resize(vertices);
    std::atomic<bool> mirrors{false};
    std::atomic<bool> lost{false};
    struct Scratch {
        MeanMatrices means{};
        Cofactors cofactors{};
        VertexLane side{};
    };
    const auto body = [&](std::size_t from, std::size_t to, Scratch& s) {
        for (std::size_t begin = from; begin < to; begin += vertex_lanes) {
            const std::size_t count = std::min(vertex_lanes, to - begin);
            blend(influences, joints, begin, count, s.means);
            move_positions(s.means, mesh.positions->data() + begin, count,
                           result.positions.data() + begin);
            scale_linear_parts(s.means);
            find_cofactors(s.means, s.cofactors, s.side);
            bool here = false;
            for (std::size_t v = 0; v < count; ++v) {
                result.sides[begin + v] = static_cast<std::int8_t>(s.side[v]);
                here |= s.side[v] < 0.0F;
            }
            if (here) mirrors = true;
            if (mesh.normals != nullptr &&
                move_normals(s.cofactors, s.side, mesh.normals->data() + begin, count,
                             result.normals.data() + begin)) {
                lost = true;
            }
            if (mesh.tangents != nullptr &&
                move_tangents(s.means, s.side, mesh.tangents->data() + begin, count,
                              result.tangents.data() + begin)) {
                lost = true;
            }
        }
    };
    parallel_for_with<Scratch>(0, vertices, vertices_at_once, body);
    result.mirrors = mirrors;
    result.lost = lost;
    return result;
}

std::vector<glm::uvec3> turned_triangles(const std::vector<glm::uvec3>& triangles,
                                         const std::vector<std::int8_t>& sides) {
    std::vector<glm::uvec3> turned = triangles;
    for (glm::uvec3& triangle : turned) {
        if (sides[triangle.x] + sides[triangle.y] + sides[triangle.z] >= 0) continue;
        std::swap(triangle.x, triangle.z);
    }
    return turned;
}

template <class Vector>
std::vector<Vector> displaced(const std::vector<Vector>& base,
                              const std::vector<Displacement<Vector>>& displacements) {
    std::vector<Vector> sums(base.size());
    parallel_for(0, base.size(), vertices_at_once, [&](std::size_t from, std::size_t to) {
        for (std::size_t begin = from; begin < to; begin += vertex_lanes) {
            const std::size_t first = begin * Vector::length();
            const std::size_t count = std::min(vertex_lanes, to - begin) * Vector::length();
            std::array<float, vertex_lanes * 4> sum;
            const float* start = &base.front()[0] + first;
            for (std::size_t i = 0; i < count; ++i) sum[i] = start[i];
            for (const auto& [values, weight] : displacements) {
                const float* change = &values->front()[0] + first;
                for (std::size_t i = 0; i < count; ++i) sum[i] += weight * change[i];
            }
            std::copy_n(sum.begin(), count, &sums.front()[0] + first);
        }
    });
    return sums;
}

template std::vector<glm::vec2> displaced(const std::vector<glm::vec2>&,
                                          const std::vector<Displacement<glm::vec2>>&);
template std::vector<glm::vec3> displaced(const std::vector<glm::vec3>&,
                                          const std::vector<Displacement<glm::vec3>>&);
template std::vector<glm::vec4> displaced(const std::vector<glm::vec4>&,
                                          const std::vector<Displacement<glm::vec4>>&);

bool normalize_each(std::vector<glm::vec3>& vectors) {
    bool lost = false;
    for (glm::vec3& vector : vectors) {
        const float factor = unit_factor(vector.x, vector.y, vector.z);
        lost |= factor == 0.0F;
        vector *= factor;
    }
    return lost;
}

}  // namespace cubecam
