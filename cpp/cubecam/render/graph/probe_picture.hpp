#pragma once

#include "cubecam/render/graph/scene_picture.hpp"
#include "cubecam/render/resources/bound_texture.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// The cube of a probe, as one scene of the call shows it. Where probes depend on each other, the
/// scene's environment stands in for those that come too late (docs/adr/0003-probe-cycles.md).
class ProbePicture final : public ScenePicture {
public:
    ProbePicture(FrameContext& context, const PictureId& id);

    /// Draws it whole in this call, whatever its policy says.
    void force() { forced_ = true; }

    /// What it holds now; empty before it is drawn for the first time.
    BoundTexture texture() const;
    /// The same as what a surface reflects.
    Environment environment() const;

    std::vector<PictureId> possible_dependencies() override;
    std::vector<PictureId> dependencies() override;
    void update() override;
    /// Nothing stands in for it where casters are moved by it.
    bool strict() const override { return context_.moves_casters(id_); }
    std::string label(std::size_t place) const override;

private:
    bool count_and_decide();
    bool sees(const NodeSnapshot& node) const;
    TargetDescription describe() const;

    const ProbeSnapshot& probe_;
    ProbeState& state_;
    bool forced_ = false;
    bool due_ = false;
};

}  // namespace cubecam
