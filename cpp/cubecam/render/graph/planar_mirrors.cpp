#include "cubecam/render/graph/planar_mirrors.hpp"

#include "cubecam/geometry/mesh_plane.hpp"

#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

namespace cubecam {
namespace {

/// Planes of one mirror differ by less than this: in direction, and relative to the mirror's size.
constexpr double same_plane = 1e-6;

}  // namespace

PlanarMirrors::PlanarMirrors(const SceneSnapshot& scene,
                             WeakCache<const MeshData, Plane>& planes) {
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
        mirror.looked_up_by_level = mirror.looked_up_by_level || parts.filtered || parts.mipmaps ||
                                    parts.filtered_if_made;
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
