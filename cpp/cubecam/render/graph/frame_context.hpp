#pragma once

#include "cubecam/image/pixels.hpp"
#include "cubecam/render/graph/dependencies.hpp"
#include "cubecam/render/graph/picture_graph.hpp"
#include "cubecam/render/graph/renderer_state.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace cubecam {

class ProbePicture;
class TexturePicture;

/// One call of a renderer: the scenes that take part, and the graph of the pictures that it draws.
class FrameContext {
public:
    /// @throws std::invalid_argument if the lights of a scene have more, or larger, shadows than
    /// the driver can hold.
    FrameContext(RendererState& gpu, const SceneSnapshot& scenes);
    FrameContext(const FrameContext&) = delete;
    FrameContext& operator=(const FrameContext&) = delete;

    // A call is one of these three.

    /// Draws `views` of the nodes that `wanted` lets through into `target`, and before that what
    /// they depend on.
    ///
    /// `wanted_key` says which nodes that are.
    void draw(std::vector<View> views, Target& target,
              std::function<bool(const NodeSnapshot&)> wanted, Key wanted_key,
              PostProcess post_process = {});

    /// Draws these probes of the first scene, due or not, and before each what it depends on.
    void update_probes(const std::vector<std::size_t>& probes);

    /// The shadow map of a light of the first scene; see Renderer::shadow_map.
    Buffer<float> shadow_map(std::size_t light);

    // For the pictures.

    RendererState& gpu;
    const SceneSnapshot& scenes;  ///< the first one, and by it the others
    Stats stats;
    PictureGraph pictures;

    ProbePicture& probe(std::size_t scene, std::size_t place);
    TexturePicture& texture(std::size_t place);
    /// The shadow maps of a scene's lights that have one, in their order; they are up to date.
    std::vector<ShadowUse> shadows(std::size_t scene);

    /// What the renderer holds of a probe, or of a light's shadow map, for a scene of this call.
    ProbeState& probe_state(std::size_t scene, std::size_t probe);
    ShadowState& shadow_state(std::size_t scene, std::size_t light);

    const SceneContents& contents(std::size_t scene);
    /// Whether any scene's shadow maps depend on a picture.
    bool moves_casters(const PictureId& picture) const;

private:
    std::unique_ptr<Picture> make(const PictureId& id);
    /// Whether the picture is a function of the scene and of what the renderer holds alone, and not
    /// of how many calls there were.
    bool counts_no_calls() const;
    /// Refuses circles, then draws.
    void update(const std::vector<PictureId>& roots);

    /// How many scenes before it use a scene's probes, and its lights, too.
    struct Ranks {
        std::vector<std::size_t> probes, lights;
    };

    std::vector<Ranks> ranks_;  // of each scene
    std::vector<std::optional<SceneContents>>
        contents_;                      // the same, made when a picture wants them
    Dependencies caster_dependencies_;  // of all scenes
};

}  // namespace cubecam
