#include "cubecam/render/passes/full_screen_pass.hpp"

#include "cubecam/render/resources/view_record.hpp"

namespace cubecam {

void set_full_screen_state(const GladGLContext& gl) {
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
    gl.Disable(GL_BLEND);
}

void draw_full_screen(const GladGLContext& gl, const GpuCache& cache, const FullScreenViews& views,
                      Stats& stats) {
    const GLuint array = cache.views_only().id();
    if (views.buffer != 0) {
        gl.VertexArrayVertexBuffer(array, vertex_buffer::records, views.buffer, 0,
                                   sizeof(ViewRecord));
    }
    gl.BindVertexArray(array);
    gl.DrawArraysInstancedBaseInstance(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(views.count),
                                       views.first);
    ++stats.draw_calls;
    stats.triangles += 2 * views.count;
}

}  // namespace cubecam
