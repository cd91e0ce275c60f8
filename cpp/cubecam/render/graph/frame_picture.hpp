#pragma once

#include "cubecam/render/graph/scene_picture.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// The result of a renderer's call: a frame, both eyes of a stereo frame, or a capture. No other
/// picture looks it up.
class FramePicture final : public ScenePicture {
public:
    /// `screen_reflections`: rays that its surfaces reflect are looked up on the screen first.
    FramePicture(FrameContext& context, std::vector<View> views, Target& target,
                 std::function<bool(const NodeSnapshot&)> wanted, PostProcess post_process,
                 bool screen_reflections);

    bool sees(const NodeSnapshot& node) const override { return wanted_(node); }
    TargetDescription describe() const override { return target_.description(); }
    Target::Behind& kept_behind() override { return target_.behind; }
    Target::Mirrors& kept_mirrors() override { return target_.mirrors; }
    ScreenTextures screen() override;
    Target::Screen& kept_screen() { return target_.screen; }

    std::vector<PictureId> possible_dependencies() override;
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return false; }
    std::string label(std::size_t place) const override;

private:
    std::vector<View> given_views_;  // until they are planned
    Target& target_;
    const std::function<bool(const NodeSnapshot&)> wanted_;
    const PostProcess post_process_;
    const bool screen_reflections_;
};

}  // namespace cubecam
