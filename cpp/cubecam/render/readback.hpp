#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/render/frame.hpp"
#include "cubecam/render/resources/result_pool.hpp"
#include "cubecam/render/resources/target.hpp"

#include <memory>

namespace cubecam {

/// Copies of what a target holds. Frames are flipped to row 0 on top, and several views stand one
/// below the other; cube faces are taken as they are.
Frame read_frame(const GladGLContext& gl, Target& target, ResultPool& pool);
std::shared_ptr<CubeMap> read_cube(const GladGLContext& gl, Target& target, ResultPool& pool);

}  // namespace cubecam
