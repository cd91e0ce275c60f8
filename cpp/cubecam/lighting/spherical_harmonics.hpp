/// Radiance as a sum of spherical harmonics.
#pragma once

#include "cubecam/cubemap/cubemap.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace cubecam {

inline constexpr int largest_sh_order = 64;

/// Basis functions up to an order: (order + 1)^2.
constexpr std::size_t sh_count(int order) {
    return static_cast<std::size_t>(order + 1) * static_cast<std::size_t>(order + 1);
}

/// The real orthonormal basis at a direction of length 1, function (l, m) at l (l + 1) + m:
/// 1/sqrt(4 pi); then sqrt(3/4pi) times y, z, x; then xy, yz, 3zz-1, xz, xx-yy with their factors;
/// and so on up to `order`. `values` has sh_count(order) elements.
void sh_basis(const glm::dvec3& direction, int order, std::span<double> values);

/// The integral of radiance * basis over the sphere, [function][channel], the sum over texels with
/// their exact solid angles; uint8 as value/255, and what is not finite as FilteredCube has it.
std::vector<double> cube_to_sh(const CubeMapData& cube, int order);

/// The sum of coefficient * basis at the texels' centers: [6][size][size][channels].
Buffer<float> sh_to_faces(std::span<const double> coefficients, int order, int channels, int size);

}  // namespace cubecam
