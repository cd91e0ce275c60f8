#include "cubecam/gl/pace.hpp"

#include "cubecam/core/interrupts.hpp"

#include <glad/gl.h>

#include <utility>

namespace cubecam::gl {
namespace {

constexpr double too_little = 1 << 17;         // pixels that need no wait of their own
constexpr GLuint64 one_wait = 20 * 1'000'000;  // nanoseconds

/// Waits for a fence and deletes it, also when a poll throws.
void wait(const GladGLContext& gl, GLsync fence) {
    const struct Deleter {
        const GladGLContext& gl;
        GLsync fence;
        ~Deleter() { gl.DeleteSync(fence); }
    } deleter{gl, fence};
    while (gl.ClientWaitSync(fence, GL_SYNC_FLUSH_COMMANDS_BIT, one_wait) == GL_TIMEOUT_EXPIRED) {
        poll_interrupts();
    }
}

}  // namespace

void Pace::submitted(const GladGLContext& gl, double pixels) {
    pending_ += pixels;
    poll_interrupts();
    if (pending_ >= chunk) end_chunk(gl);
}

void Pace::finish(const GladGLContext& gl) {
    if (running_ == nullptr && pending_ < too_little) {
        pending_ = 0;
        return;
    }
    end_chunk(gl);
    if (running_ != nullptr) wait(gl, static_cast<GLsync>(std::exchange(running_, nullptr)));
}

void Pace::end_chunk(const GladGLContext& gl) {
    pending_ = 0;
    const GLsync fence = gl.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    gl.Flush();  // so that the driver begins
    void* const last = std::exchange(running_, fence);
    if (last != nullptr) wait(gl, static_cast<GLsync>(last));
    poll_interrupts();
}

}  // namespace cubecam::gl
