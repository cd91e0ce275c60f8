/// How skins and morph targets move vertices (glTF 2.0, sections 3.7.2.2 and 3.7.3). The functions
/// are pure, run on all cores and compute in float32, in loops that compilers turn into SIMD.
#pragma once

#include "cubecam/geometry/influences.hpp"

#include <glm/glm.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace cubecam {

/// The first three rows of an affine matrix, from the mesh's space to that in which it is drawn.
using JointMatrix = std::array<float, 12>;

JointMatrix to_joint_matrix(const glm::dmat4& matrix);

/// The arrays of a mesh that joints change; null: the mesh has none, or the result is not needed.
struct SkinInput {
    const std::vector<glm::vec3>* positions;
    const std::vector<glm::vec3>* normals;
    const std::vector<glm::vec4>* tangents;
};

struct SkinnedVertices {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;   ///< of unit length, or 0 where a matrix is singular
    std::vector<glm::vec4> tangents;  ///< likewise, except their signs
    std::vector<std::int8_t> sides;   ///< -1 where the joints mirror, else 1
    bool mirrors = false;             ///< whether any side is -1
    bool lost = false;                ///< whether any normal or tangent has the length 0
};

/// Moves vertices by the means of their joints' matrices, weighted and divided by the sum of the
/// weights. A vertex without weight goes with joint 0. Normals are multiplied by the inverse of the
/// transposed mean, whose direction is that of its cofactors times the sign of its determinant.
SkinnedVertices skin(const SkinInput& mesh, const Influences& influences,
                     std::span<const JointMatrix> joints);

/// The triangles, those turned round whose corners mostly lie where joints mirror.
std::vector<glm::uvec3> turned_triangles(const std::vector<glm::uvec3>& triangles,
                                         const std::vector<std::int8_t>& sides);

/// Displacements with the weight by which they are added.
template <class Vector>
struct Displacement {
    const std::vector<Vector>* values;
    float weight;
};

/// base + the sum of weight * displacement.
template <class Vector>
std::vector<Vector> displaced(const std::vector<Vector>& base,
                              const std::vector<Displacement<Vector>>& displacements);

/// Gives the vectors unit length; returns whether any has no length and becomes 0.
bool normalize_each(std::vector<glm::vec3>& vectors);

}  // namespace cubecam
