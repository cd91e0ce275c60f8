#pragma once

#include <memory>
#include <vector>

namespace cubecam {

class RenderTexture;

/// Scenes and render textures can keep each other alive, such as a monitor in the room that it
/// shows. Reference counts never free such a circle, so this function searches for it.
///
/// Each of `textures` that nothing outside leads to releases its scene, and the whole circle is
/// destroyed. During the call no thread may change scenes or get parts of them; in Python, the
/// interpreter's lock ensures that.
void collect_cycles(const std::vector<std::weak_ptr<RenderTexture>>& textures);

}  // namespace cubecam
