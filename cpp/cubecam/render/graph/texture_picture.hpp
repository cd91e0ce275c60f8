#pragma once

#include "cubecam/render/graph/scene_picture.hpp"
#include "cubecam/render/resources/bound_texture.hpp"

#include <string>
#include <vector>

namespace cubecam {

/// The picture of a render texture, which never shows itself (docs/adr/0007-render-textures.md).
class TexturePicture final : public ScenePicture {
public:
    TexturePicture(FrameContext& context, const PictureId& id);

    /// The current picture. A map of colours gets decoded numbers if these are sRGB of 8 bits.
    BoundTexture texture(bool colors);

    bool sees(const NodeSnapshot& node) const override;
    TargetDescription describe() const override;
    Target::Behind& kept_behind() override { return state_.behind; }
    Target::Mirrors& kept_mirrors() override { return state_.mirrors; }

    std::vector<PictureId> possible_dependencies() override;
    std::vector<PictureId> dependencies() override;
    void update() override;
    bool strict() const override { return true; }
    std::string label(std::size_t place) const override;

private:
    /// Forgets the picture, but not what is behind it and in its mirrors.
    void reset();
    /// Makes the target and the view of it, if the texture's size, format or wrapping has changed.
    void prepare(const TargetDescription& description);
    Sampler sampler() const;
    bool decodes() const;
    void decode();

    const RenderTextureSnapshot& texture_;
    TextureState& state_;
};

}  // namespace cubecam
