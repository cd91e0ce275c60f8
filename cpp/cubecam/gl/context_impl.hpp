#pragma once

#include "cubecam/gl/context.hpp"
#include "cubecam/gl/device_choice.hpp"
#include "cubecam/gl/pace.hpp"

#include <glad/gl.h>

#include <memory>
#include <mutex>
#include <string>
#include <vector>

/// The contents of a Context. Private to gl/.
namespace cubecam::gl {

struct Context::Impl {
    Impl(egl::RawContext made, DeviceInfo info, const egl::OpenDisplay& display, bool with_debug);

    void query_strings();
    void query_limits();
    void start_debug_output();
    void make_mark();

    /// GL_NO_ERROR, or how the GPU was reset since the context was made.
    GLenum reset_status() const;

    /// Whether the current context, which has our handle, is ours. Where another library ends our
    /// display, the driver may give the address of our context to a new one.
    bool has_mark() const;

    egl::RawContext raw;
    GladGLContext gl{};
    DeviceInfo device;
    Limits limits;
    std::string vendor;
    std::string renderer;
    std::string version;
    std::string glsl_version;
    std::string egl_version;
    std::vector<std::string> extensions;
    bool software = false;
    bool debug = false;
    bool reset = false;  ///< the GPU was reset: nothing can be drawn any more
    GLuint mark = 0;     ///< a buffer whose label no other context of the process has
    std::string mark_label;
    Pace pace;
    std::mutex messages_mutex;
    std::vector<std::string> messages;
};

/// Makes one attempt to start a context. Throws ContextError whose text names the failed step.
std::unique_ptr<Context::Impl> start_context(const Candidate& candidate, bool debug);

}  // namespace cubecam::gl
