#pragma once

#include "cubecam/render/graph/scene_picture.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// What lies behind the transmissive surfaces of another picture, its viewer: the same views of the
/// same nodes, except those surfaces, in half floats and with mip levels for rough surfaces
/// (docs/adr/0020). It is drawn only if the viewer has such a surface in view.
class BehindPicture final : public ScenePicture {
public:
    BehindPicture(FrameContext& context, const PictureId& id);

    bool sees(const NodeSnapshot& node) const override;
    TargetDescription describe() const override;
    /// Its own surfaces have nothing behind them, since it shows no transmissive ones.
    Target::Behind& kept_behind() override { return none_; }

    std::vector<PictureId> possible_dependencies() override { return possible(); }
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return false; }
    /// Empty: messages name the viewer.
    std::string label(std::size_t place) const override;

private:
    ScenePicture& viewer_;
    Target::Behind none_;
};

}  // namespace cubecam
