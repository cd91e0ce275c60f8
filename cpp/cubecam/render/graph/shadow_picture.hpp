#pragma once

#include "cubecam/render/graph/frame_context.hpp"
#include "cubecam/render/graph/picture.hpp"
#include "cubecam/render/graph/texture_lookup.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// The shadow map of a light in one scene: depth of all that casts shadows there, in view or not.
/// It depends on the pictures by which casters move their vertices, and on no others.
///
/// The same map serves frames, captures, probes and render textures. A layer is drawn again only
/// when its key differs.
class ShadowPicture final : public Picture {
public:
    ShadowPicture(FrameContext& context, const PictureId& id);

    /// The map, ready to be looked up, once it is up to date.
    const ShadowUse& use() const { return use_; }

    std::vector<PictureId> possible_dependencies() override { return dependencies(); }
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return true; }
    /// Empty: messages name what moves the casters instead.
    std::string label(std::size_t place) const override;

private:
    /// Draws the layers that differ.
    void draw_changed(TextureLookup& lookup);

    FrameContext& context_;
    const PictureId id_;
    const SceneSnapshot& scene_;
    ShadowState& state_;
    ShadowUse use_;
};

}  // namespace cubecam
