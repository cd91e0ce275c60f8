#pragma once

#include "cubecam/image/pixels.hpp"
#include "cubecam/render/graph/dependencies.hpp"
#include "cubecam/render/graph/picture_graph.hpp"
#include "cubecam/render/graph/planar_mirrors.hpp"
#include "cubecam/render/graph/probe_circles.hpp"
#include "cubecam/render/graph/renderer_state.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace cubecam {

struct BatchTarget;
class ProbePicture;
class ScenePicture;
class TexturePicture;

/// One call of a renderer: its scenes, and the graph of the pictures that it draws.
class FrameContext {
public:
    /// @throws std::invalid_argument if the lights of a scene have more or larger shadows than the
    /// driver allows, or for a planar mirror on a mesh that is not flat.
    /// @param max_lod_error see LevelChoice.
    FrameContext(RendererState& gpu, const SceneSnapshot& scenes, double max_lod_error = 0.0);
    FrameContext(const FrameContext&) = delete;
    FrameContext& operator=(const FrameContext&) = delete;

    // A call uses one of these functions.

    /// Draws `views` of the nodes for which `wanted` is true into `target`, after the pictures that
    /// they depend on.
    ///
    /// `wanted_key` differs whenever `wanted` selects other nodes. `screen_reflections`: what
    /// surfaces reflect is looked up on the screen first.
    void draw(std::vector<View> views, Target& target,
              std::function<bool(const NodeSnapshot&)> wanted, Key wanted_key,
              PostProcess post_process = {}, bool screen_reflections = false);

    /// Draws a capture of a batch into the layers of its cube.
    void draw(std::vector<View> views, BatchTarget& batch, std::size_t cube,
              std::function<bool(const NodeSnapshot&)> wanted);

    /// Draws these probes of the first scene, whether they are due or not, after the pictures that
    /// they depend on.
    void update_probes(const std::vector<std::size_t>& probes);

    /// Draw the picture of an object again that was lost with the context. Return false if no node
    /// shows the object.
    bool draw_again(const Probe& probe);
    bool draw_again(const RenderTexture& texture);

    /// Returns the shadow map of a light of the first scene; see Renderer::shadow_map.
    Buffer<float> shadow_map(std::size_t light);

    // The pictures use the following members.

    RendererState& gpu;
    const SceneSnapshot& scenes;  ///< the first scene, which holds the others
    /// Of the frame or the capture, and what it shows behind panes, in planar mirrors and on the
    /// screen. Probes, render textures and shadow maps serve other calls, too: they are exact.
    const double max_lod_error;
    Stats stats;
    PictureGraph pictures;

    ProbePicture& probe(const PictureId& id);
    TexturePicture& texture(std::size_t place);
    /// The picture of a scene with this id.
    ScenePicture& scene_picture(const PictureId& id);
    /// The shadow maps of a scene, in the order of its lights; they are up to date.
    std::vector<ShadowUse> shadows(std::size_t scene);

    /// The picture of a probe that another picture, `viewer`, shows; none: the scene's environment
    /// takes its place. Asking for it counts the call, since the probe is needed.
    std::optional<PictureId> shown_probe(const PictureId& viewer, std::size_t scene,
                                         std::size_t probe);
    /// Puts the shown picture in the place of each probe of a scene; those without one are left
    /// out.
    Dependencies with_shown_probes(const PictureId& viewer, std::size_t scene,
                                   const Dependencies& shown);
    /// All pictures of a probe, one for each bounce.
    std::vector<PictureId> probe_pictures(std::size_t scene, std::size_t probe);
    const ProbeCircles& probe_circles(std::size_t scene);

    /// The renderer's states of a probe, or of a light's shadow map, for a scene of this call.
    ProbeLevels& probe_levels(std::size_t scene, std::size_t probe);
    ShadowState& shadow_state(std::size_t scene, std::size_t light);

    /// The planar mirrors of a scene.
    const PlanarMirrors& mirrors(std::size_t scene) const { return mirrors_[scene]; }

    const SceneContents& contents(std::size_t scene);
    /// Whether any scene's shadow maps depend on a picture.
    bool moves_casters(const PictureId& picture) const;

private:
    std::unique_ptr<Picture> make(const PictureId& id);
    /// Whether the picture depends only on the scene and the renderer's contents, and not on the
    /// number of calls.
    bool counts_no_calls() const;
    /// Refuses circles, then draws the pictures.
    void update(const std::vector<PictureId>& roots);
    /// Measures how much each round of bounces changed what mirrors show.
    void measure_bounces();

    /// For each probe and each light of a scene: how many earlier scenes of the call use it.
    struct Ranks {
        std::vector<std::size_t> probes, lights;
    };

    std::vector<Ranks> ranks_;            // for each scene
    std::vector<PlanarMirrors> mirrors_;  // for each scene
    std::size_t mirror_pictures_ = 0;     // of mirrors in mirrors, that were made
    std::vector<std::optional<SceneContents>>
        contents_;  // for each scene, made when a picture needs it
    std::vector<std::optional<ProbeCircles>> circles_;  // the same
    Dependencies caster_dependencies_;                  // of all scenes
};

}  // namespace cubecam
