#include "cubecam/gl/egl_display.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/context.hpp"

#include <array>
#include <mutex>
#include <shared_mutex>
#include <utility>

namespace cubecam::gl::egl {

namespace {

/// Displays are initialised alone, contexts are made current and let go together. Mesa 22.3
/// frees a display that another library has terminated when the last thread lets its context go,
/// and takes no lock for that: a thread that initialises the display at this moment gets one whose
/// driver is being unloaded (docs/adr/0024).
std::shared_mutex display_mutex;

[[noreturn]] void throw_egl(const Table& egl, const char* call, std::string_view note = {}) {
    throw ContextError(std::string(call) + ": " + error_name(egl.get_error()) + std::string(note));
}

Config choose_config(const Table& egl, Display display) {
    const std::array attributes{
        surface_type, pbuffer_bit, renderable_type, opengl_bit, red_size, 8, green_size, 8,
        blue_size,    8,           alpha_size,      8,          none};
    Config config = nullptr;
    Int count = 0;
    if (!egl.choose_config(display, attributes.data(), &config, 1, &count))
        throw_egl(egl, "eglChooseConfig");
    if (count < 1) throw ContextError("eglChooseConfig: no RGBA8 pbuffer configuration for OpenGL");
    return config;
}

/// Gets a display that counts its users where the driver has such displays: another library that
/// terminates its own use of the device then leaves our contexts alone.
Display get_counted_display(const Table& egl, const char* client, Enum platform, void* native) {
    if (has_name(client, "EGL_KHR_display_reference")) {
        const std::array<Int, 3> counted{track_references, 1, none};
        Display display = egl.get_platform_display(platform, native, counted.data());
        if (display != nullptr) return display;
        // Where several drivers are installed, the list has the extensions of all of them, and the
        // driver of this device may not know the attribute.
        egl.get_error();
    }
    return egl.get_platform_display(platform, native, nullptr);
}

Display get_display(const Table& egl, Platform platform, Device device) {
    const char* client = egl.query_string(nullptr, extensions);
    const auto need = [&](const char* extension) {
        if (egl.get_platform_display == nullptr || !has_name(client, extension)) {
            throw ContextError(std::string("EGL lacks ") + extension);
        }
    };
    Display display = nullptr;
    switch (platform) {
        case Platform::device:
            need("EGL_EXT_platform_device");
            display = get_counted_display(egl, client, platform_device, device);
            break;
        case Platform::surfaceless:
            need("EGL_MESA_platform_surfaceless");
            display = get_counted_display(egl, client, platform_surfaceless, nullptr);
            break;
        case Platform::fallback: display = egl.get_display(nullptr); break;
    }
    if (display == nullptr) {
        throw_egl(egl,
                  platform == Platform::fallback ? "eglGetDisplay" : "eglGetPlatformDisplayEXT");
    }
    return display;
}

std::vector<Int> attributes_of(int major, int minor, bool debug, bool robust) {
    std::vector<Int> attributes{context_major_version,       major,
                                context_minor_version,       minor,
                                context_opengl_profile_mask, context_opengl_core_profile_bit};
    if (debug) attributes.insert(attributes.end(), {context_flags, context_opengl_debug_bit});
    if (robust) {
        attributes.insert(attributes.end(), {context_robust_access, 1, context_reset_strategy,
                                             lose_context_on_reset});
    }
    attributes.push_back(none);
    return attributes;
}

}  // namespace

const char* platform_name(Platform platform) noexcept {
    switch (platform) {
        case Platform::device: return "device";
        case Platform::surfaceless: return "surfaceless";
        case Platform::fallback: break;
    }
    return "default";
}

std::vector<Device> query_devices(std::string* problem) {
    const Table& egl = library();
    const auto fail = [&](std::string text) {
        if (problem != nullptr) *problem = std::move(text);
        return std::vector<Device>{};
    };
    if (egl.query_devices == nullptr || egl.query_device_string == nullptr) {
        return fail("EGL lacks EGL_EXT_device_enumeration");
    }
    Int count = 0;
    if (!egl.query_devices(0, nullptr, &count))
        return fail("eglQueryDevicesEXT: " + error_name(egl.get_error()));
    std::vector<Device> devices(static_cast<std::size_t>(count));
    if (!devices.empty() && !egl.query_devices(count, devices.data(), &count)) {
        return fail("eglQueryDevicesEXT: " + error_name(egl.get_error()));
    }
    devices.resize(static_cast<std::size_t>(count));
    if (devices.empty()) return fail("eglQueryDevicesEXT: no devices");
    return devices;
}

OpenDisplay open_display(Platform platform, Device device) {
    const Table& egl = library();
    OpenDisplay open;
    const std::unique_lock lock(display_mutex);
    open.display = get_display(egl, platform, device);
    Int major = 0;
    Int minor = 0;
    // This call is repeated for each context: it does nothing if the display is initialised, and
    // initialises it again if another library has terminated it.
    if (!egl.initialize(open.display, &major, &minor)) throw_egl(egl, "eglInitialize");

    const char* version_text = egl.query_string(open.display, version);
    open.version = version_text != nullptr ? version_text
                                           : std::to_string(major) + "." + std::to_string(minor);
    const char* list = egl.query_string(open.display, extensions);
    open.surfaceless = has_name(list, "EGL_KHR_surfaceless_context");
    open.robust = has_name(list, "EGL_EXT_create_context_robustness") || major > 1 || minor >= 5;
    const bool configless = has_name(list, "EGL_KHR_no_config_context") ||
                            has_name(list, "EGL_MESA_configless_context");
    if (!configless || !open.surfaceless) open.config = choose_config(egl, open.display);
    return open;
}

RawContext::RawContext(const OpenDisplay& display, int major, int minor, bool debug, bool robust)
    : RawContext(display, attributes_of(major, minor, debug, robust),
                 "OpenGL " + std::to_string(major) + "." + std::to_string(minor) +
                     (robust ? " core, robust" : " core"),
                 nullptr) {}

RawContext RawContext::sharing() const { return {place_, attributes_, name_, context_}; }

RawContext::RawContext(const OpenDisplay& place, std::vector<Int> attributes, std::string name,
                       Context shared)
    : place_(place), attributes_(std::move(attributes)), name_(std::move(name)) {
    const Table& egl = library();
    // The bound API belongs to the thread, and another library may depend on its own choice.
    const Enum api = egl.query_api();
    if (!egl.bind_api(opengl_api))
        throw_egl(egl, "eglBindAPI(EGL_OPENGL_API)", " (EGL without desktop OpenGL)");

    context_ = egl.create_context(place_.display, place_.config, shared, attributes_.data());
    const Int context_error = context_ != nullptr ? success : egl.get_error();
    Int surface_error = success;
    if (context_ != nullptr && !place_.surfaceless) {
        const std::array size{width, 1, height, 1, none};
        surface_ = egl.create_pbuffer_surface(place_.display, place_.config, size.data());
        if (surface_ == nullptr) surface_error = egl.get_error();
    }
    if (api != static_cast<Enum>(none)) egl.bind_api(api);

    if (context_ == nullptr) {
        throw ContextError("eglCreateContext(" + name_ + "): " + error_name(context_error));
    }
    if (surface_error != success) {
        egl.destroy_context(place_.display, context_);
        throw ContextError("eglCreatePbufferSurface: " + error_name(surface_error));
    }
}

RawContext::RawContext(RawContext&& other) noexcept
    : place_(std::move(other.place_)), attributes_(std::move(other.attributes_)),
      name_(std::move(other.name_)), context_(std::exchange(other.context_, nullptr)),
      surface_(std::exchange(other.surface_, nullptr)), abandoned_(other.abandoned_) {}

RawContext::~RawContext() {
    if (context_ == nullptr || abandoned_ || in_forked_child()) return;
    const Table& egl = library();  // open since this context was made: cannot throw
    if (surface_ != nullptr) egl.destroy_surface(place_.display, surface_);
    egl.destroy_context(place_.display, context_);
}

Current::Current(const RawContext& context) : ours_(context.display()) {
    const Table& egl = library();
    // The order matters: these calls report what is current for the API that the thread had bound.
    api_ = egl.query_api();
    display_ = egl.get_current_display();
    context_ = egl.get_current_context();
    draw_ = egl.get_current_surface(draw);
    read_ = egl.get_current_surface(read);
    egl.bind_api(opengl_api);
    // The context that was current is let go, and may be the last one of a terminated display.
    const auto make_current = [&] {
        const std::shared_lock lock(display_mutex);
        return egl.make_current(ours_, context.surface(), context.surface(), context.context());
    };
    if (make_current()) return;

    const Int error = egl.get_error();
    restore();
    std::string text = "eglMakeCurrent: " + error_name(error);
    if (error == bad_access) {
        text += ": the context is current on another thread, or another window system's OpenGL "
                "context (GLX) is current on "
                "this one";
    } else if (error == not_initialized || error == bad_display || error == bad_context) {
        text += ": another library in this process has terminated the EGL display";
    } else if (error == context_lost) {
        text += ": the GPU was reset";
    }
    throw ContextLost(text, error == context_lost);
}

Current::~Current() {
    if (!in_forked_child()) restore();
}

void Current::restore() const noexcept {
    const Table& egl = library();  // open since the constructor: cannot throw
    const std::shared_lock lock(display_mutex);
    if (context_ == nullptr || !egl.make_current(display_, draw_, read_, context_)) {
        // No context was current before, or it has been destroyed since: ours must not stay
        // current.
        egl.make_current(ours_, nullptr, nullptr, nullptr);
    }
    if (api_ != static_cast<Enum>(none)) egl.bind_api(api_);
}

}  // namespace cubecam::gl::egl
