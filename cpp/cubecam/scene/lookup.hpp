#pragma once

#include <memory>
#include <variant>

namespace cubecam {

class CubeMap;
class Probe;

/// A cubemap that a surface looks up: none of its own, a fixed one, or a probe that follows the
/// scene.
using CubeSource = std::variant<std::monostate, std::shared_ptr<CubeMap>, std::shared_ptr<Probe>>;

}  // namespace cubecam
