#pragma once

#include <glm/glm.hpp>

#include <span>

namespace cubecam {

/// Nodes along each axis of the table; node i is at i / (brdf_table_size - 1).
inline constexpr int brdf_table_size = 64;

/// Integrals of reflection models under uniform light; row: roughness, column: N.V.
/// x, y: scale and bias of F0 for GGX with separable Smith (glTF 2.0, appendix B; B. Karis, "Real
/// Shading in Unreal Engine 4", 2013). z: the albedo of the sheen lobe of KHR_materials_sheen for
/// sheen roughness, at most 1. w: 0. The first column holds the values at N.V = 1e-4. Computed once
/// in a process, some 50 ms of CPU on all cores; within .001 of the integrals at each node.
std::span<const glm::vec4> brdf_table();

/// Looks up x and y, bilinearly, for values from 0 to 1.
glm::vec2 brdf(float n_dot_v, float roughness);

}  // namespace cubecam
