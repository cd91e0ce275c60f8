#pragma once

#include "cubecam/image/encoding.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <cstddef>
#include <functional>

namespace cubecam {

/// The encoding of a picture of a scene, without effects and tone curve. It is sRGB if the picture
/// shows at least one sRGB-encoded image or cubemap and nothing that is linear: no material that
/// uses lights, no linear image or cubemap, no colour of its own. Colours that multiply an image do
/// not count, nor do colours of zeros and ones, which are the same in both encodings.
/// The picture shows scene `number` of the scenes of a call; `seen` reports whether it shows a
/// node.
Encoding scene_encoding(const SceneSnapshot& scenes, std::size_t number,
                        const std::function<bool(const NodeSnapshot&)>& seen);

}  // namespace cubecam
