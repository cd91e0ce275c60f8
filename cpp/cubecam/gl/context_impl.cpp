#include "cubecam/gl/context_impl.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/device_probe.hpp"
#include "cubecam/gl/objects.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <utility>

namespace cubecam::gl {

namespace {

constexpr std::size_t most_messages = 1000;

// glad calls this with one name at a time, without a user pointer.
GLADapiproc load_function(const char* name) { return egl::library().get_proc_address(name); }

std::string gl_text(const GladGLContext& gl, GLenum name) {
    const GLubyte* text = gl.GetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

int gl_integer(const GladGLContext& gl, GLenum name) {
    GLint value = 0;
    gl.GetIntegerv(name, &value);
    return value;
}

std::string message_line(GLenum type, GLuint id, GLenum severity, const GLchar* text) {
    const char* kind = type == GL_DEBUG_TYPE_ERROR                 ? "error"
                       : type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR  ? "undefined behaviour"
                       : type == GL_DEBUG_TYPE_DEPRECATED_BEHAVIOR ? "deprecated"
                       : type == GL_DEBUG_TYPE_PORTABILITY         ? "portability"
                       : type == GL_DEBUG_TYPE_PERFORMANCE         ? "performance"
                                                                   : "other";
    const char* weight = severity == GL_DEBUG_SEVERITY_HIGH     ? "high"
                         : severity == GL_DEBUG_SEVERITY_MEDIUM ? "medium"
                                                                : "low";
    return std::string(kind) + " " + std::to_string(id) + " (" + weight + "): " + text;
}

void GLAD_API_PTR collect_message(GLenum, GLenum type, GLuint id, GLenum severity, GLsizei,
                                  const GLchar* text, const void* user) {
    if (severity == GL_DEBUG_SEVERITY_NOTIFICATION) return;
    // The driver is written in C: no exception may pass through it.
    try {
        auto& impl = *static_cast<Context::Impl*>(const_cast<void*>(user));
        const std::lock_guard lock(impl.messages_mutex);
        if (impl.messages.size() < most_messages)
            impl.messages.push_back(message_line(type, id, severity, text));
    } catch (...) {
    }
}

/// Clears a depth texture, one context of the process at a time. Mesa fills a table of functions
/// when depths are first written to a texture (texstore_depth_stencil in its texstore.c), and takes
/// no lock: of two threads that draw for the first time, or for the first time since the driver was
/// loaded again, one emptied the table while the other called a function of it.
void write_first_depths(const GladGLContext& gl) {
    static std::mutex one_at_a_time;
    const std::lock_guard lock(one_at_a_time);
    const Texture depth = create_texture_2d(gl, GL_DEPTH_COMPONENT32F, 1, 1);
    constexpr float farthest = 0.0F;
    gl.ClearTexImage(depth.id(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &farthest);
}

}  // namespace

Context::Impl::Impl(egl::RawContext made, DeviceInfo info, const egl::OpenDisplay& display,
                    bool with_debug)
    : raw(std::move(made)), device(std::move(info)), egl_version(display.version),
      debug(with_debug) {
    const egl::Current current(raw);
    const int loaded = gladLoadGLContext(&gl, load_function);
    if (loaded == 0)
        throw ContextError("the OpenGL functions cannot be loaded through eglGetProcAddress");
    query_strings();
    if (loaded < GLAD_MAKE_VERSION(4, 5)) {
        throw ContextError("the driver gives OpenGL " + version + ", 4.5 is needed");
    }
    complete_from_gl(device, vendor, renderer, version);
    software = device.software;
    query_limits();
    if (debug) start_debug_output();
    make_mark();
    write_first_depths(gl);
    // The driver may not know a query above; the caller's first check must not report that error.
    while (gl.GetError() != GL_NO_ERROR) {
    }
}

void Context::Impl::query_strings() {
    vendor = gl_text(gl, GL_VENDOR);
    renderer = gl_text(gl, GL_RENDERER);
    version = gl_text(gl, GL_VERSION);
    glsl_version = gl_text(gl, GL_SHADING_LANGUAGE_VERSION);
    const int count = gl_integer(gl, GL_NUM_EXTENSIONS);
    for (int i = 0; i < count; ++i) {
        const GLubyte* name = gl.GetStringi(GL_EXTENSIONS, static_cast<GLuint>(i));
        if (name != nullptr) extensions.emplace_back(reinterpret_cast<const char*>(name));
    }
    std::sort(extensions.begin(), extensions.end());
}

void Context::Impl::query_limits() {
    const auto get = [this](GLenum name) { return gl_integer(gl, name); };
    limits.max_texture_size = get(GL_MAX_TEXTURE_SIZE);
    limits.max_3d_texture_size = get(GL_MAX_3D_TEXTURE_SIZE);
    limits.max_cube_map_texture_size = get(GL_MAX_CUBE_MAP_TEXTURE_SIZE);
    limits.max_array_texture_layers = get(GL_MAX_ARRAY_TEXTURE_LAYERS);
    limits.max_renderbuffer_size = get(GL_MAX_RENDERBUFFER_SIZE);
    limits.max_framebuffer_width = get(GL_MAX_FRAMEBUFFER_WIDTH);
    limits.max_framebuffer_height = get(GL_MAX_FRAMEBUFFER_HEIGHT);
    limits.max_framebuffer_layers = get(GL_MAX_FRAMEBUFFER_LAYERS);
    std::array<GLint, 2> viewport{};
    gl.GetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport.data());
    limits.max_viewport_width = viewport[0];
    limits.max_viewport_height = viewport[1];
    limits.max_samples = std::min({get(GL_MAX_SAMPLES), get(GL_MAX_COLOR_TEXTURE_SAMPLES),
                                   get(GL_MAX_DEPTH_TEXTURE_SAMPLES)});
    limits.max_color_attachments = get(GL_MAX_COLOR_ATTACHMENTS);
    limits.max_draw_buffers = get(GL_MAX_DRAW_BUFFERS);
    limits.max_texture_units = get(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS);
    limits.max_vertex_storage_blocks = get(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS);
    limits.max_fragment_storage_blocks = get(GL_MAX_FRAGMENT_SHADER_STORAGE_BLOCKS);
    GLint64 block_size = 0;
    gl.GetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &block_size);
    limits.max_storage_block_size = block_size;
    limits.storage_buffer_offset_alignment = get(GL_SHADER_STORAGE_BUFFER_OFFSET_ALIGNMENT);
    limits.max_uniform_block_size = get(GL_MAX_UNIFORM_BLOCK_SIZE);
    limits.uniform_buffer_offset_alignment = get(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT);
    if (gl.ARB_texture_filter_anisotropic != 0 || gl.EXT_texture_filter_anisotropic != 0) {
        GLfloat anisotropy = 1.0f;
        gl.GetFloatv(GL_MAX_TEXTURE_MAX_ANISOTROPY, &anisotropy);
        limits.max_anisotropy = static_cast<double>(anisotropy);
    }
}

void Context::Impl::start_debug_output() {
    gl.Enable(GL_DEBUG_OUTPUT);
    gl.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl.DebugMessageCallback(collect_message, this);
}

GLenum Context::Impl::reset_status() const {
    return gl.GetGraphicsResetStatus != nullptr ? gl.GetGraphicsResetStatus() : GLenum{GL_NO_ERROR};
}

void Context::Impl::make_mark() {
    static std::atomic<std::uint64_t> count{0};
    // The address distinguishes this copy of the library from another one in the process.
    mark_label = "cubecam " + std::to_string(reinterpret_cast<std::uintptr_t>(&count)) + " " +
                 std::to_string(++count);
    gl.CreateBuffers(1, &mark);
    gl.ObjectLabel(GL_BUFFER, mark, static_cast<GLsizei>(mark_label.size()), mark_label.data());
}

bool Context::Impl::has_mark() const {
    // glIsBuffer causes no error in another context; the label is read only where there is one.
    if (gl.IsBuffer(mark) == GL_FALSE) return false;
    std::array<char, 64> label{};
    GLsizei length = 0;
    gl.GetObjectLabel(GL_BUFFER, mark, static_cast<GLsizei>(label.size()), &length, label.data());
    return mark_label == std::string_view(label.data(), static_cast<std::size_t>(length));
}

std::unique_ptr<Context::Impl> start_context(const Candidate& candidate, bool debug) {
    DeviceInfo info = candidate.info;
    try {
        const egl::OpenDisplay display = egl::open_display(candidate.platform, candidate.device);
        egl::RawContext raw = create_gl45(display, debug, info);
        return std::make_unique<Context::Impl>(std::move(raw), std::move(info), display, debug);
    } catch (const ContextError& error) {
        throw ContextError(explain_failure(error.what(), candidate.info));
    }
}

}  // namespace cubecam::gl
