#pragma once

#include "cubecam/render/graph/scene_picture.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// What another picture, its viewer, sees in a planar mirror: the same views, each mirrored at the
/// mirror's plane and clipped there, so that a point of the mirror lies at the same pixel of both
/// (docs/adr/0027). It may itself show planar mirrors, as a viewer.
class PlanarMirrorPicture final : public ScenePicture {
public:
    PlanarMirrorPicture(FrameContext& context, const PictureId& id);

    /// The current picture.
    BoundTexture texture();

    /// All that captures show, except the nodes of this mirror.
    bool sees(const NodeSnapshot& node) const override;
    bool sees_in_mirrors(const NodeSnapshot& node) const override;
    TargetDescription describe() const override;
    Target::Behind& kept_behind() override { return kept().behind; }
    Target::Mirrors& kept_mirrors() override { return kept().mirrors; }
    std::size_t mirrors_met() const override { return viewer_.mirrors_met() + 1; }
    std::vector<Rect> windows() const override;

    std::vector<PictureId> possible_dependencies() override { return possible(); }
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return false; }
    /// Empty: messages name the viewer.
    std::string label(std::size_t place) const override;

private:
    Target::Mirrors::Kept& kept();

    ScenePicture& viewer_;
    const PlanarMirrors::Mirror& mirror_;
};

}  // namespace cubecam
