#pragma once

#include "cubecam/gl/egl.hpp"

#include <string>
#include <vector>

/// EGL's devices, displays, contexts and the current context. Private to gl/. Failures throw
/// ContextError whose text is the call and the decoded error; the caller puts it into a list of
/// attempts.
namespace cubecam::gl::egl {

enum class Platform { device, surfaceless, fallback };

const char* platform_name(Platform platform) noexcept;

/// Returns EGL's devices, in EGL's order; none if EGL cannot list devices: `problem` (may be null)
/// then gets the reason.
std::vector<Device> query_devices(std::string* problem = nullptr);

/// An initialised display. Displays are shared by the whole process, and never terminated here. But
/// another library may terminate the display that it shares with us, which ends all our contexts,
/// unless the driver has displays that count their users (EGL_KHR_display_reference).
struct OpenDisplay {
    Display display = nullptr;
    Config config = nullptr;   ///< null: contexts are made without one (EGL_KHR_no_config_context)
    bool surfaceless = false;  ///< EGL_KHR_surfaceless_context
    /// A context may be robust: it reports that the GPU was reset.
    bool robust = false;
    std::string version;  ///< EGL_VERSION
};

OpenDisplay open_display(Platform platform, Device device);

/// Owner of an EGL context and, where contexts need one, of its 1x1 surface.
class RawContext {
public:
    /// Makes a core context of at least this OpenGL version. `robust`: it reports resets of the
    /// GPU; a driver may refuse to make such a context.
    RawContext(const OpenDisplay& display, int major, int minor, bool debug, bool robust = false);
    RawContext(RawContext&& other) noexcept;
    /// Makes a context of the same kind that shares textures with this one, for another thread.
    RawContext sharing() const;
    RawContext& operator=(RawContext&&) = delete;
    ~RawContext();

    /// From now on the destructor does nothing.
    void abandon() noexcept { abandoned_ = true; }
    bool abandoned() const noexcept { return abandoned_; }

    Display display() const noexcept { return place_.display; }
    Context context() const noexcept { return context_; }
    Surface surface() const noexcept { return surface_; }

private:
    RawContext(const OpenDisplay& place, std::vector<Int> attributes, std::string name,
               Context shared);

    OpenDisplay place_;
    std::vector<Int> attributes_;
    std::string name_;  ///< the kind of context, for error messages
    Context context_ = nullptr;
    Surface surface_ = nullptr;
    bool abandoned_ = false;
};

/// Makes a context current during its own life; the destructor restores what was current on the
/// thread before.
class Current {
public:
    /// Throws ContextLost; the thread's current context is then unchanged.
    explicit Current(const RawContext& context);
    ~Current();
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;

private:
    void restore() const noexcept;

    Display ours_;
    Display display_;
    Context context_;
    Surface draw_;
    Surface read_;
    Enum api_;
};

}  // namespace cubecam::gl::egl
