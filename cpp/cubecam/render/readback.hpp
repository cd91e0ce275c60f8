#pragma once

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/gl/context.hpp"
#include "cubecam/image/result_pool.hpp"
#include "cubecam/render/frame.hpp"
#include "cubecam/render/resources/read_buffer.hpp"
#include "cubecam/render/resources/target.hpp"

#include <cstddef>
#include <memory>

namespace cubecam {

/// The main memory that reading a target takes: the results, and one layer on its way.
std::size_t result_bytes(const TargetDescription& description);

/// Copies of a target's contents. Frames are flipped so that row 0 is on top, with several views
/// one below the other; cube faces are copied as they are.
Frame read_frame(const gl::Context& context, Target& target, ResultPool& pool, ReadBuffer& buffer);
std::shared_ptr<CubeMap> read_cube(const gl::Context& context, Target& target, ResultPool& pool,
                                   ReadBuffer& buffer, Encoding encoding);

}  // namespace cubecam
