#pragma once

#include <memory>
#include <vector>

namespace cubecam {

class RenderTexture;

/// Scenes and render textures can keep each other alive: a monitor in the room that it shows. No
/// count of references ever lets go of such a circle, so it is looked for.
///
/// Of `textures`, those that nothing outside leads to any more let go of their scenes, and all of
/// the circle is destroyed. Nobody may change scenes, or be given parts of them, meanwhile; under
/// Python, its lock sees to that.
void collect_cycles(const std::vector<std::weak_ptr<RenderTexture>>& textures);

}  // namespace cubecam
