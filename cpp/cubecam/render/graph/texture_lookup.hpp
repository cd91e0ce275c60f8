#pragma once

#include "cubecam/render/graph/picture.hpp"
#include "cubecam/render/passes/post_process_pass.hpp"
#include "cubecam/render/resources/bound_texture.hpp"
#include "cubecam/render/resources/environment.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace cubecam {

class FrameContext;

/// The textures that one picture of a scene looks up. Those that are pictures are already up to
/// date.
class TextureLookup {
public:
    /// `viewer` is the picture that looks them up, `scene` the number of the scene that it shows.
    TextureLookup(FrameContext& context, const PictureId& viewer, std::size_t scene);

    BoundTexture find(const CubeSourceSnapshot& source);
    /// @param colors whether a map of colours looks it up, which gets decoded numbers.
    BoundTexture find(const MapSnapshot& map, bool colors = false);
    BoundTexture find(const TextureSourceSnapshot& texture, bool colors = false);
    /// Finds all textures that a node's material looks up.
    NodeTextures find(const NodeSnapshot& node);
    /// Finds the textures on which a node's shadow depends, in the order of its inputs; the others
    /// stay empty.
    std::vector<BoundTexture> find_for_shadow(const NodeSnapshot& node);
    /// Finds the textures of each effect, in the order of its inputs.
    std::vector<std::vector<BoundTexture>> find(const std::vector<EffectSnapshot>& effects);
    /// The cube behind everything; empty if the background is a colour.
    Environment background();

private:
    Environment find_environment(const CubeSourceSnapshot& source, const EnvironmentParts& parts);
    Environment find_cube(const CubeSnapshot& cube, const EnvironmentParts& parts);
    /// The probes of a blend that reach a node, and the scene's environment where they do not.
    Environment find_blend(const NodeSnapshot& node, const ProbeBlendSnapshot& blend,
                           const EnvironmentParts& parts);
    /// The scene's own environment, as the scene places it.
    Environment find_scene_environment(const EnvironmentParts& parts);
    /// The picture of a probe that the viewer shows; none: the scene's environment.
    const std::optional<PictureId>& shown(std::size_t probe);

    FrameContext& context_;
    PictureId viewer_;
    std::size_t number_;
    const SceneSnapshot& scene_;
    /// For each probe of the scene; none: not yet known.
    std::vector<std::optional<std::optional<PictureId>>> shown_;
};

}  // namespace cubecam
