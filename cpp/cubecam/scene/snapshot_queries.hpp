#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// Answers from a snapshot alone: which pictures see a node, and what its material uses.
namespace cubecam {

/// Whether a node, or one above it, is among `excluded`.
bool is_excluded(const NodeSnapshot& node, const std::vector<std::int32_t>& excluded);

/// The probes that a node may ever look up as `source`: none, one, or all of a blend.
std::span<const std::size_t> probes_of(const CubeSourceSnapshot& source);

/// The probes of a node's blend that count in its bounds.
struct ReachingProbes {
    std::vector<std::size_t> probes;  ///< in the order of the blend
    bool whole = false;  ///< one of them counts fully in all of the bounds: they need nothing else
};

/// @throws std::invalid_argument for more than most_blended_probes.
ReachingProbes reaching_probes(const SceneSnapshot& scene, const NodeSnapshot& node,
                               const ProbeBlendSnapshot& blend);

/// Whether a node may look up a probe of its scene: also if it is in the node's blend but does not
/// reach the node. So a probe does not begin or cease to show a node that moves.
bool uses_probe(const NodeSnapshot& node, std::size_t probe);

/// The environment that a node's material looks up: none, the node's own or the scene's.
const CubeSourceSnapshot& environment_of(const SceneSnapshot& scene, const NodeSnapshot& node);

/// Whether a user's own source moves a node's vertices.
bool moves_vertices(const NodeSnapshot& node);

/// Whether that source may look up pictures that are drawn: those of render textures and probes.
bool vertices_see_pictures(const NodeSnapshot& node);

/// Whether the scene behind shows through a node, which is not blended.
bool shows_behind(const NodeSnapshot& node);

/// Whether a node looks up the light from all around, which a probe grid may give.
bool sees_probe_grid(const NodeSnapshot& node);

/// Whether a node shows shadows: its material must use the lights.
bool receive_shadow(const NodeSnapshot& node);

/// Whether a node is drawn into shadow maps. The keys of the maps, the bounds of a directional
/// light's view and the drawing all use this one answer: if two of them differed, a map could keep
/// a picture that is no longer right.
///
/// It depends neither on Material::depth_write nor on color_write or the stencil: these say how the
/// camera's picture is put together, while a surface stops light because it is opaque (three.js
/// decides in the same way).
bool casts_shadow(const NodeSnapshot& node);

/// Whether any light of a scene has a shadow.
bool has_shadows(const SceneSnapshot& scene);

/// The index of the texture whose alpha makes holes in a node; none: no such texture, or no mask.
std::optional<std::size_t> mask_texture(const NodeSnapshot& node);

/// Whether a node may have holes, so that its shadow needs more than its triangles.
bool has_holes(const NodeSnapshot& node);

/// The indices of a node's textures on which its shadow depends: those that its vertex function
/// looks up, and that of its mask.
std::vector<std::size_t> shadow_textures(const NodeSnapshot& node);

/// Whether a probe, or a render texture, of a node's scene sees the node.
bool is_seen(const SceneSnapshot& scene, const NodeSnapshot& node, std::size_t probe);
bool is_seen(const RenderTextureSnapshot& texture, const NodeSnapshot& node);

}  // namespace cubecam
