#pragma once

#include "cubecam/gl/devices.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

struct GladGLContext;  // <glad/gl.h>; only files that call GL include it

namespace cubecam::gl {

class Pace;

/// Which device a context is made on:
///  - "auto": the environment variable CUBECAM_DEVICE if it is set, otherwise GPU devices, then
///    the software device, then the surfaceless platform, then the default display;
///  - "gpu", "software": as "auto", but devices of this kind only;
///  - an index into list_devices(), a UUID, or a part of a name in any letter case. A string of
///    digits is an index when there is such a device.
using DeviceChoice = std::variant<std::string, int>;

struct ContextOptions {
    DeviceChoice device = std::string("auto");
    bool debug =
        false;  ///< collect the driver's messages (GL_KHR_debug), see take_debug_messages()
};

/// The limits of the context's driver, queried once.
struct Limits {
    int max_texture_size = 0;
    int max_3d_texture_size = 0;
    int max_cube_map_texture_size = 0;
    int max_array_texture_layers = 0;
    int max_renderbuffer_size = 0;
    int max_framebuffer_width = 0;
    int max_framebuffer_height = 0;
    int max_framebuffer_layers = 0;
    int max_viewport_width = 0;
    int max_viewport_height = 0;
    int max_samples = 0;  ///< the least of GL_MAX_SAMPLES and GL_MAX_{COLOR,DEPTH}_TEXTURE_SAMPLES
    int max_color_attachments = 0;
    int max_draw_buffers = 0;
    int max_texture_units = 0;          ///< of all stages together
    int max_vertex_storage_blocks = 0;  ///< storage buffers the vertex stage can read
    int max_fragment_storage_blocks = 0;
    std::int64_t max_storage_block_size = 0;  ///< bytes
    int storage_buffer_offset_alignment = 0;  ///< bytes
    int max_uniform_block_size = 0;           ///< bytes
    int uniform_buffer_offset_alignment = 0;  ///< bytes
    double max_anisotropy = 1.0;
};

/// The most pixels along a side of a picture that can be drawn, and the name of the limit that says
/// so.
struct LargestSide {
    int pixels;
    const char* limit;
};

/// The longest side of a face of a cube or of a frame. A driver may look up larger textures than it
/// draws into (zink); of equal limits the first is named.
LargestSide largest_side(const Limits& limits, bool face) noexcept;

/// An OpenGL 4.5 core context without a window, current on no thread between CurrentScopes.
///
/// Any thread may use a context, one thread at a time: its owner holds a mutex. Contexts share
/// nothing, so several may be used in parallel. (That of a thread of large_texture.hpp shares the
/// textures of one context, and makes one of them.)
class Context {
public:
    /// Throws ContextError that lists every attempt, why it failed, and what to install;
    /// std::invalid_argument for an empty device string.
    explicit Context(const ContextOptions& options = {});
    /// Makes a context at the place where another process has one: its platform() and the index of
    /// its device(). Throws ContextError.
    static Context at(const std::string& platform, int device);
    Context(Context&&) noexcept;
    Context& operator=(Context&&) noexcept;
    ~Context();

    /// The table of GL functions, at one address for the life of the context (moves included). Its
    /// functions may be called only inside a CurrentScope.
    const GladGLContext& gl() const noexcept;

    /// Everything that fills many pixels reports it here. Only inside a CurrentScope.
    Pace& pace() const noexcept;

    const std::string& vendor() const noexcept;        ///< GL_VENDOR
    const std::string& renderer() const noexcept;      ///< GL_RENDERER
    const std::string& version() const noexcept;       ///< GL_VERSION
    const std::string& glsl_version() const noexcept;  ///< GL_SHADING_LANGUAGE_VERSION
    const std::string& egl_version() const noexcept;   ///< EGL_VERSION of the display
    const std::string& platform() const noexcept;      ///< "device", "surfaceless" or "default"
    bool software() const noexcept;
    bool debug() const noexcept;
    const DeviceInfo& device() const noexcept;
    const Limits& limits() const noexcept;

    /// Whether the driver offers a GL extension, by its full name ("GL_ARB_...").
    bool has_extension(std::string_view name) const noexcept;
    const std::vector<std::string>& extensions() const noexcept;  ///< sorted

    /// The driver's messages since the last call (debug contexts only), one line each.
    std::vector<std::string> take_debug_messages();

    /// @throws ContextLost if the GPU was reset since the context was made: nothing that was drawn
    /// or read in the meantime is right. The call waits, at most two seconds, for the end of the
    /// reset, and is allowed only inside a CurrentScope. Drivers that cannot report a reset, and
    /// software drivers, report none.
    void check_reset();

    /// From now on destroying objects of this context does not touch GL. An owner that cannot make
    /// the context current any more calls this; the driver has freed the objects, or frees them
    /// with the context. The context itself is destroyed only if its handle is known to be valid.
    void abandon() noexcept;

    struct Impl;  ///< private to gl/ (context_impl.hpp)
    const Impl& impl() const noexcept { return *impl_; }

private:
    friend class CurrentScope;
    explicit Context(std::unique_ptr<Impl> impl) noexcept;
    std::unique_ptr<Impl> impl_;
};

/// Makes a context current on this thread. The destructor restores what was current before
/// (context, surfaces, display and client API, also those of another library), also after an
/// exception. Scopes can be nested.
class CurrentScope {
public:
    /// Throws ContextLost if the context has ended, or if its handle now belongs to another
    /// context; the thread's current context is then unchanged. Throws ContextError in a forked
    /// child.
    explicit CurrentScope(const Context& context);
    ~CurrentScope();

    CurrentScope(const CurrentScope&) = delete;
    CurrentScope& operator=(const CurrentScope&) = delete;

private:
    // Inline storage for the saved EGL state: a scope is entered once per call of the renderer,
    // and EGL's types stay out of this header.
    alignas(void*) unsigned char saved_[6 * sizeof(void*)];
};

/// True in a process forked after EGL was opened: such a process must not call EGL or GL.
bool in_forked_child() noexcept;

}  // namespace cubecam::gl
