#pragma once

#include "cubecam/core/versioned.hpp"
#include "cubecam/image/depth_format.hpp"
#include "cubecam/image/format.hpp"
#include "cubecam/image/image.hpp"
#include "cubecam/scene/image_effect.hpp"
#include "cubecam/scene/weak_nodes.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cubecam {

class Camera;
class Scene;

struct RenderTextureValue {
    std::shared_ptr<Scene> scene;
    std::shared_ptr<Camera> camera;
    std::int64_t width = 512;   ///< texels
    std::int64_t height = 512;  ///< texels
    Format format = Format::rgba8;
    DepthFormat depth_format = DepthFormat::depth_component32f;
    std::int64_t samples = 1;
    bool mipmaps = false;
    Wrap wrap = Wrap::clamp;
    WeakNodes exclude;  ///< nodes of `scene` that are not shown, with all nodes below them
    std::vector<std::shared_ptr<ImageEffect>> effects;  ///< run over the picture, in this order
    std::string name;

    bool operator==(const RenderTextureValue& other) const;
};

/// Throws std::invalid_argument for a missing scene or camera, a side < 1, or samples < 1.
void check(const RenderTextureValue& value);

/// A picture of a scene that materials show. It is drawn in the same call and is always up to date.
/// A RenderTexture is only a description: each renderer holds contents of its own.
///
/// The scene that shows the texture may be the scene in it, if the texture excludes the nodes that
/// show it. The renderer refuses a picture that shows itself, which would have no end.
class RenderTexture {
public:
    using State = Versioned<RenderTextureValue>::State;

    explicit RenderTexture(RenderTextureValue value);
    ~RenderTexture();
    RenderTexture(const RenderTexture&) = delete;
    RenderTexture& operator=(const RenderTexture&) = delete;

    RenderTextureValue value() const { return value_.value(); }

    template <class Change>
    void edit(Change&& change) {
        value_.edit([&](RenderTextureValue& value) {
            change(value);
            check(value);
        });
    }

    /// Releases the scene of a texture that is destroyed next; for collect_cycles.
    void let_go();

private:
    Versioned<RenderTextureValue> value_;
};

}  // namespace cubecam
