#pragma once

#include "cubecam/render/graph/frame_picture.hpp"
#include "cubecam/render/graph/scene_picture.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// What the reflections of a frame, its viewer, find on the screen: the same views of the same
/// nodes, without those that are blended, with the probes alone; colour in floats, depths, ids
/// (docs/adr/0032). It is drawn only if the frame asks for it and has a reflecting surface in view.
class ScreenPicture final : public ScenePicture {
public:
    ScreenPicture(FrameContext& context, const PictureId& id);

    /// A blended node would count with the depth of what lies behind it.
    bool sees(const NodeSnapshot& node) const override;
    TargetDescription describe() const override;
    /// It shows what the viewer shows behind panes and in planar mirrors: the views are the same.
    Target::Behind& kept_behind() override { return viewer_.kept_behind(); }
    Target::Mirrors& kept_mirrors() override { return viewer_.kept_mirrors(); }

    std::vector<PictureId> possible_dependencies() override { return possible(); }
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return false; }
    /// Empty: messages name the viewer.
    std::string label(std::size_t place) const override;

protected:
    const PictureId& mirror_viewer() const override { return *id_.viewer; }

private:
    FramePicture& viewer_;
};

}  // namespace cubecam
