#include "cubecam/scene/snapshot_queries.hpp"

#include <algorithm>

namespace cubecam {
namespace {

bool has(const std::vector<std::int32_t>& ids, std::int32_t id) {
    return std::find(ids.begin(), ids.end(), id) != ids.end();
}

bool uses_lights(const PhongParameters&) { return true; }
bool uses_lights(const ShaderParameters& p) { return p.uses_lights(); }
template <class Parameters>
bool uses_lights(const Parameters&) {
    return false;
}

}  // namespace

bool is_excluded(const NodeSnapshot& node, const std::vector<std::int32_t>& excluded) {
    if (excluded.empty()) return false;
    return has(excluded, node.id) ||
           std::any_of(node.ancestors.begin(), node.ancestors.end(),
                       [&excluded](std::int32_t id) { return has(excluded, id); });
}

bool uses_probe(const NodeSnapshot& node, std::size_t probe) {
    const auto is_probe = [probe](const CubeSourceSnapshot& source) {
        const auto* index = std::get_if<std::size_t>(&source);
        return index != nullptr && *index == probe;
    };
    return is_probe(node.environment) || is_probe(node.cubemap) ||
           std::any_of(node.textures.begin(), node.textures.end(),
                       [&is_probe](const TextureSourceSnapshot& texture) {
                           const auto* source = std::get_if<CubeSourceSnapshot>(&texture);
                           return source != nullptr && is_probe(*source);
                       });
}

const CubeSourceSnapshot& source_of(const SceneSnapshot& scene, const NodeSnapshot& node) {
    static const CubeSourceSnapshot none;
    const MaterialParameters& parameters = node.material.value.parameters;
    if (std::holds_alternative<BasicParameters>(parameters)) return node.cubemap;
    if (std::holds_alternative<PhongParameters>(parameters)) return none;
    const auto* shader = std::get_if<ShaderParameters>(&parameters);
    if (shader != nullptr && !shader->looks_up_environment()) return none;
    return node.environment.index() == 0 ? scene.environment : node.environment;
}

bool moves_vertices(const NodeSnapshot& node) {
    const auto* shader = std::get_if<ShaderParameters>(&node.material.value.parameters);
    return shader != nullptr && shader->moves_vertices();
}

bool receive_shadow(const NodeSnapshot& node) {
    return node.receive_shadow &&
           std::visit([](const auto& p) { return uses_lights(p); }, node.material.value.parameters);
}

bool has_shadows(const SceneSnapshot& scene) {
    return std::any_of(scene.lights.begin(), scene.lights.end(),
                       [](const LightSnapshot& light) { return light.value.shadow.has_value(); });
}

std::vector<std::size_t> vertex_textures(const NodeSnapshot& node) {
    std::vector<std::size_t> found;
    if (!moves_vertices(node)) return found;
    const auto& shader = std::get<ShaderParameters>(node.material.value.parameters);
    std::size_t place = 0;
    for (const auto& [name, source] : shader.inputs.textures) {
        if (mentions(shader.vertex.text, name)) found.push_back(place);
        ++place;
    }
    return found;
}

bool is_seen(const SceneSnapshot& scene, const NodeSnapshot& node, std::size_t probe) {
    return node.in_captures && !uses_probe(node, probe) &&
           !is_excluded(node, scene.probes[probe].excluded);
}

bool is_seen(const RenderTextureSnapshot& texture, const NodeSnapshot& node) {
    return !is_excluded(node, texture.excluded);
}

}  // namespace cubecam
