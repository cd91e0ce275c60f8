#include "cubecam/scene/crowds.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <variant>

namespace cubecam {
namespace {

/// The smallest crowd: for fewer nodes that look the same, the order from near to far is faster.
constexpr std::size_t least_crowd = 16;

/// The properties that all nodes of a crowd share; see NodeSnapshot::crowd.
using Look = std::vector<std::uintptr_t>;

template <class Object>
std::uintptr_t number_of(const std::shared_ptr<Object>& object) {
    return reinterpret_cast<std::uintptr_t>(object.get());
}

void add_source(const CubeSourceSnapshot& source, Look& look) {
    look.push_back(source.index());
    if (const auto* cube = std::get_if<CubeSnapshot>(&source)) {
        look.push_back(number_of(cube->object));
    } else if (const auto* probe = std::get_if<std::size_t>(&source)) {
        look.push_back(*probe);
    }
}

void add_source(const MapSnapshot& source, Look& look) {
    look.push_back(source.index());
    if (const auto* image = std::get_if<std::shared_ptr<const Image>>(&source)) {
        look.push_back(number_of(*image));
    } else if (const auto* texture = std::get_if<std::size_t>(&source)) {
        look.push_back(*texture);
    }
}

/// Only opaque nodes whose order does not change the picture may join a crowd: those that test and
/// write depth and write all channels, without stencil.
bool may_join_crowd(const NodeSnapshot& node) {
    const SurfaceOptions& surface = node.material.value.surface;
    return !node.deforms && node.blend == Blend::opaque && node.depth_write && surface.depth_test &&
           !surface.stencil && glm::all(surface.color_write) &&
           !node.material.value.traits().user_code &&
           // Each node has its own probes of a blend.
           !std::holds_alternative<ProbeBlendSnapshot>(node.environment);
}

Look look_of(const NodeSnapshot& node) {
    const MaterialTraits& material = node.material.value.traits();
    Look look{number_of(node.mesh),
              reinterpret_cast<std::uintptr_t>(material.kind),
              material.switches,
              static_cast<std::uintptr_t>(material.vertex_colors),
              std::uintptr_t{node.material.value.surface.double_sided},
              std::uintptr_t{node.receive_shadow},
              std::uintptr_t{material.environment_parts.filtered},
              std::uintptr_t{material.environment_parts.mipmaps}};
    add_source(node.environment, look);
    // Each planar mirror has its own plane.
    if (std::holds_alternative<PlanarMirrorIndex>(node.environment)) {
        look.push_back(static_cast<std::uintptr_t>(node.id));
    }
    for (std::size_t i = 0; i < node.textures.size(); ++i) {
        std::visit([&look](const auto& source) { add_source(source, look); }, node.textures[i]);
        look.push_back(static_cast<std::uintptr_t>(uv_set_of(material.textures[i])));
    }
    return look;
}

}  // namespace

void find_crowds(std::vector<NodeSnapshot>& nodes) {
    if (nodes.size() < least_crowd) return;
    std::map<Look, std::vector<NodeSnapshot*>> looks;
    Look last_look;
    std::vector<NodeSnapshot*>* last = nullptr;
    for (NodeSnapshot& node : nodes) {
        if (!may_join_crowd(node)) continue;
        Look look = look_of(node);
        if (last == nullptr || look != last_look) {
            last = &looks[look];
            last_look = std::move(look);
        }
        last->push_back(&node);
    }
    std::vector<const std::vector<NodeSnapshot*>*> crowds;
    for (const auto& [look, members] : looks) {
        if (members.size() >= least_crowd) crowds.push_back(&members);
    }
    std::sort(crowds.begin(), crowds.end(),
              [](const auto* a, const auto* b) { return a->front()->id < b->front()->id; });
    std::uint32_t number = 0;
    for (const auto* members : crowds) {
        ++number;
        for (NodeSnapshot* node : *members) node->crowd = number;
    }
}

}  // namespace cubecam
