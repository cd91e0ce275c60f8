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
public:
    /// Whether the picture may show a node.
    virtual bool sees(const NodeSnapshot& node) const = 0;
    /// The target into which it is drawn.
    virtual TargetDescription describe() const = 0;
    /// Where the renderer keeps the scene behind this picture's transmissive surfaces.
    virtual Target::Behind& kept_behind() = 0;

    const std::vector<View>& views() const { return views_; }
    std::size_t scene_number() const { return number_; }
    /// What the transmissive surfaces of this picture show; empty if it has none.
    BoundTexture behind();

protected:
    /// `scene` is the number of the scene that it shows.
    ScenePicture(FrameContext& context, PictureId id, std::size_t scene);

    /// The pictures that it might ever show.
    Dependencies possible();

    /// Plans the nodes that it sees, and returns the pictures that the nodes in view show.
    Dependencies plan(std::vector<View> views, const TargetDescription& target);

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
    bool shows_behind_ = false;
};

}  // namespace cubecam
