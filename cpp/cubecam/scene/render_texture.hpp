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
    WeakNodes exclude;  ///< nodes of `scene` that it does not show, with all below them
    std::vector<std::shared_ptr<ImageEffect>> effects;  ///< run over it, in this order
    std::string name;

    bool operator==(const RenderTextureValue& other) const;
};

/// Throws std::invalid_argument: no scene, no camera, a side < 1, samples < 1.
void check(const RenderTextureValue& value);

/// A scene drawn into a picture that materials show, in the same call and always true to its scene.
/// It is only a description: each renderer holds contents of its own.
///
/// The scene that shows it may be its own, if the nodes that show it are left out of it: a picture
/// that shows itself has no end, and the renderer refuses it.
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

    /// Gives up its scene, to be destroyed next: for collect_cycles.
    void let_go();

private:
    Versioned<RenderTextureValue> value_;
};

}  // namespace cubecam
