#pragma once

#include <memory>
#include <variant>

namespace cubecam {

class CubeMap;
class Image;
class Probe;
class RenderTexture;

/// The cubemap that a surface looks up: none, a fixed one, or a probe that follows the scene.
using CubeSource = std::variant<std::monostate, std::shared_ptr<CubeMap>, std::shared_ptr<Probe>>;

/// The 2D picture that a surface shows by its uvs: none, a fixed one, or one drawn from a scene.
using MapSource =
    std::variant<std::monostate, std::shared_ptr<const Image>, std::shared_ptr<RenderTexture>>;

}  // namespace cubecam
