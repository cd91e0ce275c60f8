#include "cubecam/geometry/mesh_bounds.hpp"

#include <limits>

namespace cubecam {

namespace {

/// Whether each coordinate in the world depends on one coordinate of the mesh alone.
bool keeps_axes(const glm::dmat4& m) {
    for (int row = 0; row < 3; ++row) {
        if (int{m[0][row] != 0.0} + int{m[1][row] != 0.0} + int{m[2][row] != 0.0} > 1) return false;
    }
    return true;
}

}  // namespace

Bounds no_bounds() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {glm::dvec3(infinity), glm::dvec3(-infinity)};
}

bool is_empty(const Bounds& bounds) { return glm::any(glm::greaterThan(bounds.low, bounds.high)); }

Bounds united(const Bounds& a, const Bounds& b) {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

Bounds bounds_in_world(const MeshData& mesh, const glm::dmat4& world) {
    const auto moved = [&world](const glm::dvec3& p) {
        return glm::dvec3(world[0]) * p.x + glm::dvec3(world[1]) * p.y +
               glm::dvec3(world[2]) * p.z + glm::dvec3(world[3]);
    };
    if (keeps_axes(world)) {
        const glm::dvec3 a = moved(mesh.bounds().low);
        const glm::dvec3 b = moved(mesh.bounds().high);
        return {glm::min(a, b), glm::max(a, b)};
    }
    Bounds bounds = no_bounds();
    for (const glm::vec3& position : *mesh.positions()) {
        const glm::dvec3 p = moved(glm::dvec3(position));
        bounds.low = glm::min(bounds.low, p);
        bounds.high = glm::max(bounds.high, p);
    }
    return bounds;
}

}  // namespace cubecam
