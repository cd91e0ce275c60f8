#include "cubecam/scene/render_texture.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/scene/camera.hpp"
#include "cubecam/scene/scene.hpp"

#include <string>
#include <utility>
#include <vector>

namespace cubecam {

bool RenderTextureValue::operator==(const RenderTextureValue& other) const {
    return scene == other.scene && camera == other.camera && width == other.width &&
           height == other.height && format == other.format && depth_format == other.depth_format &&
           samples == other.samples && mipmaps == other.mipmaps && wrap == other.wrap &&
           same_nodes(exclude, other.exclude) && effects == other.effects && name == other.name;
}

void check(const RenderTextureValue& value) {
    expect(value.scene != nullptr, "a scene", "none");
    expect(value.camera != nullptr, "a camera", "none");
    expect(value.width >= 1 && value.height >= 1, "size of at least 1 x 1",
           std::to_string(value.width) + " x " + std::to_string(value.height));
    for (const auto& effect : value.effects) expect(effect != nullptr, "effects", "none");
    expect(value.samples >= 1, "samples of at least 1", std::to_string(value.samples));
}

RenderTexture::RenderTexture(RenderTextureValue value)
    : value_((cubecam::check(value), std::move(value))) {}

RenderTexture::~RenderTexture() { let_go(); }

void RenderTexture::let_go() {
    // A scene may show a texture of a scene that shows a texture, and so on. As with nodes, the
    // first call frees the chain in a loop, since a long one would overflow the stack.
    static thread_local std::vector<std::shared_ptr<Scene>>* pending = nullptr;
    std::shared_ptr<Scene> scene;
    value_.edit(
        [&scene](RenderTextureValue& value) { scene = std::exchange(value.scene, nullptr); });
    if (pending) {
        pending->push_back(std::move(scene));
        return;
    }
    std::vector<std::shared_ptr<Scene>> chain;
    pending = &chain;
    chain.push_back(std::move(scene));
    while (!chain.empty()) {
        const std::shared_ptr<Scene> last = std::move(chain.back());
        chain.pop_back();
    }
    pending = nullptr;
}

}  // namespace cubecam
