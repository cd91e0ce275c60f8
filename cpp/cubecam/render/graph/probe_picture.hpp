#pragma once

#include "cubecam/render/graph/scene_picture.hpp"
#include "cubecam/render/resources/bound_texture.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// The cube of a probe, as one scene of the call shows it. If probes depend on each other, the
/// scene's environment replaces those that are not drawn yet (docs/adr/0003-probe-cycles.md).
class ProbePicture final : public ScenePicture {
public:
    ProbePicture(FrameContext& context, const PictureId& id);

    /// Makes this call draw the whole probe, whatever its policy is.
    void force() { forced_ = true; }

    bool drawn() const { return state_.target != nullptr; }
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
    void update() override;
    /// Nothing can replace a probe that moves casters.
    bool strict() const override { return context_.moves_casters(id_); }
    std::string label(std::size_t place) const override;

private:
    bool count_and_decide();
    bool due_by_count();
    void draw();
    /// Filters the faces that were drawn since the last time.
    const FilteredTexture& filter();
    std::vector<glm::vec4> read_face(Face face) const;
    GLuint box_mipmaps();

    const ProbeSnapshot& probe_;
    ProbeState& state_;
    bool forced_ = false;
    bool due_ = false;
};

}  // namespace cubecam
