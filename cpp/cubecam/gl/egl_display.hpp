#pragma once

#include "cubecam/gl/egl.hpp"

#include <string>
#include <vector>

/// Devices, displays, contexts and what is current, as EGL sees them. Private to gl/.
/// Failures are ContextErrors whose text is the call and the decoded error, to be put into a list
/// of attempts.
namespace cubecam::gl::egl {

enum class Platform { device, surfaceless, fallback };

const char* platform_name(Platform platform) noexcept;

/// EGL's devices, in its order; none when EGL cannot enumerate. `problem` (may be null) gets the
/// reason.
std::vector<Device> query_devices(std::string* problem = nullptr);

/// An initialised display. Displays are shared by the whole process (other libraries included) and
/// never terminated.
struct OpenDisplay {
    Display display = nullptr;
    Config config = nullptr;   ///< null: contexts are made without one (EGL_KHR_no_config_context)
    bool surfaceless = false;  ///< EGL_KHR_surfaceless_context
    std::string version;       ///< EGL_VERSION
};

OpenDisplay open_display(Platform platform, Device device);

/// Owner of an EGL context and, where contexts need one, of its 1x1 surface.
class RawContext {
public:
    /// Makes a core context of at least this OpenGL version.
    RawContext(const OpenDisplay& display, int major, int minor, bool debug);
    RawContext(RawContext&& other) noexcept;
    RawContext& operator=(RawContext&&) = delete;
    ~RawContext();

    /// From now on the destructor does nothing.
    void abandon() noexcept { abandoned_ = true; }
    bool abandoned() const noexcept { return abandoned_; }

    Display display() const noexcept { return display_; }
    Context context() const noexcept { return context_; }
    Surface surface() const noexcept { return surface_; }

private:
    Display display_ = nullptr;
    Context context_ = nullptr;
    Surface surface_ = nullptr;
    bool abandoned_ = false;
};

/// Makes a context current for its own life, then puts back what was current on the thread before.
class Current {
public:
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
