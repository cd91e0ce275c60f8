#pragma once

#include "cubecam/render/resources/gpu_cache.hpp"
#include "cubecam/render/resources/stats.hpp"

#include <glad/gl.h>

#include <cstdint>

namespace cubecam {

/// The records (ViewRecord) of the views for which a full-screen quad is drawn; without a buffer,
/// one view and a vertex shader that reads no record.
struct FullScreenViews {
    GLuint buffer = 0;
    GLuint first = 0;
    std::int64_t count = 1;
};

/// Sets the state of a pass that replaces every pixel: no depth test, no culling, no blending.
void set_full_screen_state(const GladGLContext& gl);

/// Draws one quad over the whole picture into the bound framebuffer, by the program in use. Its
/// corners come from gl_VertexID: passes/full_screen.vert, passes/skybox.vert.
void draw_full_screen(const GladGLContext& gl, const GpuCache& cache, const FullScreenViews& views,
                      Stats& stats);

}  // namespace cubecam
