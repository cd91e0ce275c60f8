#pragma once

#include "cubecam/gl/context.hpp"

#include <optional>
#include <string>

namespace cubecam {

/// The bytes of video memory that the driver says are free, by GL_NVX_gpu_memory_info or
/// GL_ATI_meminfo; none if the driver has neither.
std::optional<double> free_video_memory(const gl::Context& context);

/// Refuses textures that the memory cannot hold: the main memory under a software driver, and under
/// a driver that says nothing about its own, since most of those share it; else what the driver
/// says. `main_bytes` are main memory in any case. The context must be current.
/// @throws std::invalid_argument that names `what`.
void check_texture_memory(const gl::Context& context, double texture_bytes, double main_bytes,
                          const std::string& what);

}  // namespace cubecam
