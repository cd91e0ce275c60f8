#pragma once

#include "cubecam/render/graph/dependencies.hpp"
#include "cubecam/render/graph/drawn_picture.hpp"
#include "cubecam/render/graph/frame_context.hpp"
#include "cubecam/render/graph/picture.hpp"

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

namespace cubecam {

/// A picture that shows a scene in colour: the common part of frames, captures, probes and render
/// textures.
class ScenePicture : public Picture {
protected:
    using Wanted = std::function<bool(const NodeSnapshot&)>;

    /// `scene` is the number of the scene that it shows.
    ScenePicture(FrameContext& context, PictureId id, std::size_t scene);

    /// Plans the nodes for which `wanted` is true, and returns the pictures that the nodes in view
    /// show.
    Dependencies plan(std::vector<View> views, int width, int height, DepthFormat depth_format,
                      const Wanted& wanted);

    /// Calls DrawnPicture::draw_changed.
    std::size_t draw_changed(Target& target, const PostProcess& post_process = {},
                             std::optional<Budget> budget = std::nullopt);

    FrameContext& context_;
    const PictureId id_;
    const std::size_t number_;
    const SceneSnapshot& scene_;

private:
    std::vector<View> views_;
    DrawPlan plan_;
    bool shows_shadows_ = false;
};

}  // namespace cubecam
