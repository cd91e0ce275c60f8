#pragma once

#include "cubecam/render/graph/picture_kind.hpp"
#include "cubecam/render/graph/scene_picture.hpp"
#include "cubecam/render/resources/bound_texture.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cubecam {

/// A cube of a probe, as one scene of the call shows it. A probe in a circle of probes that see
/// each other has one for each bounce: PictureId::bounce 0 shows the other mirrors of the circle
/// with the scene's environment, b with their bounce b - 1 (docs/adr/0003-probe-cycles.md). The
/// policy of the probe counts for all of them; the picture of bounce 0 decides.
class ProbePicture final : public ScenePicture {
public:
    ProbePicture(FrameContext& context, const PictureId& id);

    /// Makes this call draw the whole probe, whatever its policy is.
    void force() { first_.forced_ = true; }
    /// Whether the probe is drawn in this call if its picture would change. Asking counts the call.
    bool due();
    /// Whether a face of any picture of the probe was drawn in this call.
    bool probe_updated() const { return first_.updated_; }
    /// Whether this picture is as the scene of the call is; false for one that keeps its contents.
    bool up_to_date() const { return up_to_date_; }
    /// The highest bounce below `end` whose picture was drawn, in whatever call.
    std::optional<std::size_t> drawn_below(std::size_t end) const {
        return levels_.drawn_below(end);
    }

    bool drawn() const { return state_.target != nullptr; }
    /// The current cube; it must be drawn.
    GLuint cube() const { return state_.target->color().id(); }
    /// The current cube as a surface with these parts reflects it; it must be drawn.
    Environment environment(const EnvironmentParts& parts);

    bool sees(const NodeSnapshot& node) const override;
    TargetDescription describe() const override;
    Target::Behind& kept_behind() override { return state_.behind; }
    Target::Mirrors& kept_mirrors() override { return state_.mirrors; }
    /// A mirror may show the nodes that use the probe: they lie before it.
    bool sees_in_mirrors(const NodeSnapshot& node) const override;

    std::vector<PictureId> possible_dependencies() override { return possible(); }
    std::vector<PictureId> dependencies() override;
    std::vector<PictureId> companions() override;
    void update() override;
    /// Nothing can replace a probe that moves casters.
    bool strict() const override { return context_.moves_casters(probe_id(id_.scene, id_.object)); }
    std::string label(std::size_t place) const override;

private:
    bool count_and_decide();
    bool due_by_count();
    void draw();
    /// Whether the farthest surfaces have to be drawn, too.
    bool has_layers() const { return probe_.value.parallax.method == Parallax::layers; }
    TargetDescription describe_farthest() const;
    std::size_t draw_farthest(std::optional<Budget> budget);
    /// How surfaces find what they reflect; `rough`: some look the probe up by
    /// roughness or by mipmaps, so that the farthest surfaces need levels, too.
    LocalLookup local_lookup(bool rough);
    /// Filters the faces that were drawn since the last time.
    const FilteredTexture& filter();
    std::vector<glm::vec4> read_face(Face face) const;
    GLuint box_mipmaps();

    const ProbeSnapshot& probe_;
    ProbeLevels& levels_;
    const std::shared_ptr<ProbeState> kept_;
    ProbeState& state_;
    bool up_to_date_ = false;
    ProbePicture& first_;  // the picture of bounce 0, which holds the following members for all

    bool forced_ = false;
    bool updated_ = false;
    std::optional<bool> due_;
};

}  // namespace cubecam
