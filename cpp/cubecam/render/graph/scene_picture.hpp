#pragma once

#include "cubecam/render/graph/dependencies.hpp"
#include "cubecam/render/graph/drawn_picture.hpp"
#include "cubecam/render/graph/frame_context.hpp"
#include "cubecam/render/graph/picture.hpp"

#include <cstddef>
#include <functional>
#include <memory>
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
    /// Where the renderer keeps what this picture's planar mirrors show.
    virtual Target::Mirrors& kept_mirrors() = 0;
    /// Whether the picture's planar mirrors may show a node that captures show.
    virtual bool sees_in_mirrors(const NodeSnapshot& node) const { return sees(node); }
    /// How many planar mirrors the paths have met that make this picture.
    virtual std::size_t mirrors_met() const { return 0; }
    /// The pixels of each view through which this picture is seen; empty: all.
    virtual std::vector<Rect> windows() const { return {}; }

    /// What a node's planar mirror shows in this picture; none: the node has none here, and the
    /// scene's environment replaces it.
    std::optional<PlanarReflection> reflection(const NodeSnapshot& node);
    /// The pixels that a planar mirror may cover, in each view.
    const std::vector<Rect>& mirror_bounds(std::size_t mirror) const {
        return mirror_bounds_[mirror];
    }

    /// Whether a planned node reflects an environment, without a planar mirror.
    bool reflects() const { return reflects_; }
    /// Whether such a node looks light up by roughness.
    bool reflects_by_level() const { return reflects_by_level_; }

    const std::vector<View>& views() const { return views_; }
    const DrawPlan& planned() const { return plan_; }
    std::size_t scene_number() const { return number_; }
    /// What the transmissive surfaces of this picture show; empty if it has none.
    BoundTexture behind();
    /// Where the reflections of this picture are looked up first; empty: nowhere.
    virtual ScreenTextures screen() { return {}; }

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

    /// Calls DrawnPicture::draw_shared.
    void draw_shared(Target& target, std::size_t first_layer, const std::vector<bool>& drawn);

    /// The same for a target that another picture keeps, made anew if its description changed; then
    /// makes its mipmaps. `forget` frees what is kept: before a new target, and if drawing fails.
    /// Returns whether anything was drawn.
    bool draw_kept(std::unique_ptr<Target>& target, const std::function<void()>& forget);

    /// The picture whose planar mirrors, and whose scene behind, this one shows: itself, or one of
    /// the same views.
    virtual const PictureId& mirror_viewer() const { return id_; }

    FrameContext& context_;
    const PictureId id_;
    const std::size_t number_;
    const SceneSnapshot& scene_;

private:
    /// Calls `draw` with a DrawnPicture of the planned views.
    template <class Draw>
    auto with_picture(const PostProcess& post_process, const Draw& draw);
    /// The pixels by which levels of detail may be off in this picture.
    double max_lod_error() const;
    /// Notes that a planned node shows its planar mirror. `size` is that of the picture in pixels.
    void add_mirror(const PlannedNode& planned, const std::vector<Rect>& windows,
                    const glm::ivec2& size);
    /// The pictures of the planar mirrors that were noted. Forgets those of all others.
    Dependencies mirror_pictures();

    std::vector<View> views_;
    DrawPlan plan_;
    std::vector<std::vector<Rect>> mirror_bounds_;  // by mirror and view; empty: it shows nothing
    bool shows_shadows_ = false;
    bool shows_behind_ = false;
    bool reflects_ = false;
    bool reflects_by_level_ = false;
};

}  // namespace cubecam
