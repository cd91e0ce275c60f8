#pragma once

#include "cubecam/render/graph/frame_context.hpp"
#include "cubecam/render/graph/picture.hpp"
#include "cubecam/render/graph/texture_lookup.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// The shadow map of a light in one scene: the depth of all its casters, whether they are in view
/// or not. It depends only on the pictures that casters look up to move their vertices, or to find
/// their holes.
///
/// Frames, captures, probes and render textures use the same map. A layer is drawn again only if
/// its key has changed.
class ShadowPicture final : public Picture {
public:
    ShadowPicture(FrameContext& context, const PictureId& id);

    /// The map for lookups; valid after `update`.
    const ShadowUse& use() const { return use_; }

    std::vector<PictureId> possible_dependencies() override;
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return true; }
    /// Empty: messages name the pictures that move the casters instead.
    std::string label(std::size_t place) const override;

private:
    /// Draws the layers whose keys have changed.
    void draw_changed(TextureLookup& lookup);

    FrameContext& context_;
    const PictureId id_;
    const SceneSnapshot& scene_;
    ShadowState& state_;
    ShadowUse use_;
};

}  // namespace cubecam
