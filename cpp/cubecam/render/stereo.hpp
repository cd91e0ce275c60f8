#pragma once

#include "cubecam/render/frame.hpp"
#include "cubecam/render/options.hpp"
#include "cubecam/scene/stereo_camera.hpp"

namespace cubecam {

/// The options of each eye's part of a picture of `whole`.
/// @throws std::invalid_argument for a side that has no middle, or for what an anaglyph cannot
/// hold.
FrameOptions eye_options(const FrameOptions& whole, StereoLayout layout);

/// One picture of two: `stacked` holds the left eye's above the right one's.
Frame combine_eyes(Frame stacked, StereoLayout layout);

}  // namespace cubecam
