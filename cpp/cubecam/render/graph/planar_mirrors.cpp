#include "cubecam/render/graph/planar_mirrors.hpp"

#include "cubecam/geometry/mesh_plane.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace cubecam {
namespace {

/// Planes of one mirror differ by less than this: in direction, and relative to the mirror's size.
constexpr double same_plane = 1e-6;

/// A polygon in clip space, cut by all planes of the view: I. Sutherland and G. Hodgman, "Reentrant
/// Polygon Clipping", CACM 17(1), 1974.
std::vector<glm::dvec4> in_view(std::vector<glm::dvec4> polygon) {
    // What is out of view by less than the rounding of floats counts as in view.
    const auto height = [](const glm::dvec4& p, int axis, double side) {
        return p.w + side * p[axis] + 1e-5 * (std::abs(p.w) + std::abs(p[axis]));
    };
    for (int plane = 0; plane < 6 && !polygon.empty(); ++plane) {
        const int axis = plane / 2;
        const double side = plane % 2 == 0 ? 1.0 : -1.0;
        std::vector<glm::dvec4> kept;
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const glm::dvec4& here = polygon[i];
            const glm::dvec4& next = polygon[(i + 1) % polygon.size()];
            const double a = height(here, axis, side);
            const double b = height(next, axis, side);
            if (a >= 0.0) kept.push_back(here);
            if ((a >= 0.0) != (b >= 0.0)) kept.push_back(here + (next - here) * (a / (a - b)));
        }
        polygon = std::move(kept);
    }
    return polygon;
}

}  // namespace

Rect bounds_in_view(const View& view, const NodeSnapshot& node, int width, int height) {
    const glm::dvec3 eye = glm::inverse(node.world) * glm::dvec4(view.position, 1.0);
    const bool inside = glm::all(glm::greaterThanEqual(eye, node.bounds.low)) &&
                        glm::all(glm::lessThanEqual(eye, node.bounds.high));
    if (inside) return {0, 0, width, height};
    const glm::dmat4 to_clip = view.view_projection * node.world;
    const glm::dvec3 ends[2] = {node.bounds.low, node.bounds.high};
    glm::dvec2 low(std::numeric_limits<double>::infinity());
    glm::dvec2 high = -low;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (const glm::dvec3& end : ends) {
            std::vector<glm::dvec4> face;
            for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
                glm::dvec3 corner = end;
                corner[u] = ends[i][u];
                corner[v] = ends[j][v];
                face.push_back(to_clip * glm::dvec4(corner, 1.0));
            }
            for (const glm::dvec4& p : in_view(std::move(face))) {
                // On the near plane of a perspective, w is above 0.
                const glm::dvec2 at = glm::dvec2(p) / std::max(p.w, 1e-300);
                low = glm::min(low, at);
                high = glm::max(high, at);
            }
        }
    }
    if (!(low.x <= high.x)) return {};
    constexpr double margin = 2.0;  // pixels, as in passes/screen_bounds.cpp
    const glm::dvec2 size(width, height);
    const glm::dvec2 most = size + 1.0;
    const glm::dvec2 first = glm::clamp((low * 0.5 + 0.5) * size - margin, glm::dvec2(0.0), most);
    const glm::dvec2 last = glm::clamp((high * 0.5 + 0.5) * size + margin, glm::dvec2(0.0), most);
    return Rect{static_cast<int>(first.x), static_cast<int>(first.y),
                static_cast<int>(std::ceil(last.x)), static_cast<int>(std::ceil(last.y))}
        .intersected({0, 0, width, height});
}

PlanarMirrors::PlanarMirrors(const SceneSnapshot& scene, WeakCache<const MeshData, Plane>& planes) {
    if (scene.planar_mirrors.empty()) return;
    first_ = scene.nodes.data();
    places_.resize(scene.nodes.size());
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const NodeSnapshot& node = scene.nodes[i];
        if (!std::holds_alternative<PlanarMirrorIndex>(node.environment)) continue;
        try {
            const Plane& own = planes.get(node.mesh, [&] { return plane_of(*node.mesh); });
            places_[i] = place(scene, node, transformed(own, node.world));
        } catch (const std::invalid_argument& error) {
            throw std::invalid_argument("the environment of node " + std::to_string(node.id) +
                                        ": " + error.what());
        }
        const MaterialTraits& traits = node.material.value.traits();
        const EnvironmentParts& parts = traits.environment_parts;
        Mirror& mirror = all_[*places_[i]];
        mirror.looked_up_by_level =
            mirror.looked_up_by_level || parts.filtered || parts.mipmaps || parts.filtered_if_made;
    }
}

std::size_t PlanarMirrors::place(const SceneSnapshot& scene, const NodeSnapshot& node,
                                 const Plane& plane) {
    const PlanarMirrorSnapshot& mirror =
        scene.planar_mirrors[std::get<PlanarMirrorIndex>(node.environment).value];
    const std::uint64_t identity = mirror.object->identity();
    const double size = glm::length(node.world_bounds.extent());
    for (std::size_t m = 0; m < all_.size(); ++m) {
        const Mirror& known = all_[m];
        if (known.name.first != identity) continue;
        if (glm::distance(known.plane.normal, plane.normal) > same_plane) continue;
        const double off = std::abs(known.plane.height(plane.point));
        if (off <= same_plane * std::min(known.size, size)) return m;
    }
    all_.push_back({{identity, node.id}, mirror.value, plane, size});
    return all_.size() - 1;
}

std::optional<std::size_t> PlanarMirrors::of(const NodeSnapshot& node) const {
    if (places_.empty()) return std::nullopt;
    return places_[static_cast<std::size_t>(&node - first_)];
}

}  // namespace cubecam
