#pragma once

#include <memory>
#include <variant>

namespace cubecam {

class CubeMap;
class Image;
class PlanarMirror;
class Probe;
class ProbeBlend;
class RenderTexture;

/// The cubemap that a surface looks up: none, a fixed one, or a probe that follows the scene. Only
/// as the environment of a node it may also be a planar mirror or several probes, which are no
/// cubemap; elsewhere that counts as none.
using CubeSource = std::variant<std::monostate, std::shared_ptr<CubeMap>, std::shared_ptr<Probe>,
                                std::shared_ptr<PlanarMirror>, std::shared_ptr<ProbeBlend>>;

/// The 2D picture that a surface shows by its uvs: none, a fixed one, or one drawn from a scene.
using MapSource =
    std::variant<std::monostate, std::shared_ptr<const Image>, std::shared_ptr<RenderTexture>>;

}  // namespace cubecam
