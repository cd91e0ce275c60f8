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
    /// Its planar mirrors are those of the viewer, whose views it has.
    Target::Mirrors& kept_mirrors() override { return viewer_.kept_mirrors(); }
    std::size_t mirrors_met() const override { return viewer_.mirrors_met(); }
    std::vector<Rect> windows() const override { return viewer_.windows(); }

    std::vector<PictureId> possible_dependencies() override { return possible(); }
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return false; }
    /// Empty: messages name the viewer.
    std::string label(std::size_t place) const override;

protected:
    const PictureId& mirror_viewer() const override { return *id_.viewer; }

private:
    /// Whether a blended node lies before all transmissive ones, in all views: it is blended over
    /// them, and would count twice if it were also seen through them. Other nodes hide what they
    /// lie before.
    bool is_in_front(const NodeSnapshot& node) const;

    ScenePicture& viewer_;
    /// For each view, the distance from which there are transmissive nodes; empty: not yet known.
    std::vector<double> nearest_;
    Target::Behind none_;
};

}  // namespace cubecam
