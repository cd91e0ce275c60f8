#pragma once

#include "cubecam/render/frame.hpp"
#include "cubecam/render/options.hpp"
#include "cubecam/scene/stereo_camera.hpp"

namespace cubecam {

/// The options of one eye's part of a picture with options `whole`.
/// @throws std::invalid_argument for a side of odd length, or for outputs that an anaglyph cannot
/// have.
FrameOptions eye_options(const FrameOptions& whole, StereoLayout layout);

/// Combines two pictures into one; in `stacked` the left eye's picture is above the right eye's.
Frame combine_eyes(Frame stacked, StereoLayout layout);

}  // namespace cubecam
