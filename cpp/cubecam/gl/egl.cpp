#include "cubecam/gl/egl.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/context.hpp"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <fcntl.h>
#include <mutex>
#include <pthread.h>
#include <unistd.h>
#include <utility>

namespace cubecam::gl {

namespace {

// These are constant-initialised and trivially destroyed: no code runs at import or at exit.
std::atomic<bool> library_opened{false};
std::atomic<bool> forked_after_open{false};

#ifdef __GLIBC__
/// Ends a forked child in place of the exit handlers that were registered before the fork: those of
/// drivers wait for threads that a child does not have (Mesa 26 does so for ever). What exit() does
/// besides, writing out C's open files, is done here.
void end_child(int status, void*) {
    std::fflush(nullptr);
    _exit(status);
}
#endif

/// Runs in a child, in every kind of fork.
void note_fork() noexcept {
    if (!library_opened.load()) return;
    forked_after_open = true;
#ifdef __GLIBC__
    // The handlers that are registered last run first: those of the child itself still run.
    on_exit(&end_child, nullptr);
#endif
}

}  // namespace

bool in_forked_child() noexcept { return forked_after_open.load(std::memory_order_relaxed); }

namespace egl {

namespace {

constexpr const char* default_library = "libEGL.so.1";

// The library is opened once, under this mutex; the table is then read without it.
std::mutex open_mutex;
std::atomic<const Table*> opened_table{nullptr};

template <class Function>
void resolve(void* library, Function& pointer, const char* name) {
    pointer = reinterpret_cast<Function>(dlsym(library, name));
    if (pointer == nullptr)
        throw ContextError(std::string("the EGL library has no function ") + name);
}

template <class Function>
void resolve_extension(const Table& table, Function& pointer, const char* name) {
    pointer = reinterpret_cast<Function>(table.get_proc_address(name));
}

void fill(Table& table, void* library) {
    resolve(library, table.get_proc_address, "eglGetProcAddress");
    resolve(library, table.get_error, "eglGetError");
    resolve(library, table.get_display, "eglGetDisplay");
    resolve(library, table.initialize, "eglInitialize");
    resolve(library, table.query_string, "eglQueryString");
    resolve(library, table.bind_api, "eglBindAPI");
    resolve(library, table.query_api, "eglQueryAPI");
    resolve(library, table.choose_config, "eglChooseConfig");
    resolve(library, table.create_context, "eglCreateContext");
    resolve(library, table.destroy_context, "eglDestroyContext");
    resolve(library, table.create_pbuffer_surface, "eglCreatePbufferSurface");
    resolve(library, table.destroy_surface, "eglDestroySurface");
    resolve(library, table.make_current, "eglMakeCurrent");
    resolve(library, table.get_current_context, "eglGetCurrentContext");
    resolve(library, table.get_current_surface, "eglGetCurrentSurface");
    resolve(library, table.get_current_display, "eglGetCurrentDisplay");

    // A library may return a pointer for any name, even an unknown one: an extension is used only
    // if the extension strings contain it.
    const char* client = table.query_string(nullptr, extensions);
    if (has_name(client, "EGL_EXT_platform_base")) {
        resolve_extension(table, table.get_platform_display, "eglGetPlatformDisplayEXT");
    }
    const bool base = has_name(client, "EGL_EXT_device_base");
    if (base || has_name(client, "EGL_EXT_device_enumeration")) {
        resolve_extension(table, table.query_devices, "eglQueryDevicesEXT");
    }
    if (base || has_name(client, "EGL_EXT_device_query")) {
        resolve_extension(table, table.query_device_string, "eglQueryDeviceStringEXT");
        resolve_extension(table, table.query_device_attrib, "eglQueryDeviceAttribEXT");
        resolve_extension(table, table.query_device_binary, "eglQueryDeviceBinaryEXT");
    }
}

std::string library_hint() {
    return "To install it: apt install libegl1 libgl1-mesa-dri (Debian, Ubuntu); dnf install "
           "mesa-libEGL mesa-dri-drivers (Fedora). Set CUBECAM_EGL_LIBRARY to the path of an EGL "
           "library that lies elsewhere.\n" +
           doctor_hint();
}

}  // namespace

const Table& library() {
    refuse_forked_child();
    if (const Table* table = opened_table.load(std::memory_order_acquire)) return *table;

    const std::lock_guard lock(open_mutex);
    if (const Table* table = opened_table.load(std::memory_order_acquire)) return *table;

    const char* chosen = std::getenv("CUBECAM_EGL_LIBRARY");
    const std::string name = chosen != nullptr && *chosen != '\0' ? chosen : default_library;
    // As soon as the library is open, drivers may hold threads and locks; a forked child would have
    // the locks without the threads that own them.
    static const int registered = pthread_atfork(nullptr, nullptr, note_fork);
    if (registered != 0) throw ContextError("no memory left to register a fork handler");
    library_opened = true;
    // RTLD_LOCAL: libraries that the process loads later must not see these symbols.
    void* handle = dlopen(name.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        library_opened = false;
        const char* reason = dlerror();
        const std::string why = reason != nullptr ? reason : "the loader gives no reason";
        const std::string files = descriptors_hint();
        throw ContextError("the EGL library " + name + " cannot be loaded: " + why + ". " +
                           (files.empty() ? library_hint() : files));
    }
    // The table is never freed: contexts may be destroyed while the process ends.
    auto* table = new Table();
    try {
        fill(*table, handle);
    } catch (const ContextError& error) {
        delete table;
        const std::string files = descriptors_hint();
        throw ContextError(name + ": " + error.what() + ". " +
                           (files.empty() ? library_hint() : files));
    }
    opened_table.store(table, std::memory_order_release);
    return *table;
}

void refuse_forked_child() {
    if (!in_forked_child()) return;
    throw ContextError("this process was forked after EGL was opened, and OpenGL drivers do not "
                       "survive a fork. Start worker processes "
                       "with the \"spawn\" method: multiprocessing.get_context(\"spawn\"), or "
                       "multiprocessing.set_start_method(\"spawn\")");
}

bool has_name(const char* list, std::string_view name) noexcept {
    std::string_view rest = list != nullptr ? list : "";
    while (!rest.empty()) {
        const std::size_t end = rest.find(' ');
        if (rest.substr(0, end) == name) return true;
        if (end == std::string_view::npos) break;
        rest.remove_prefix(end + 1);
    }
    return false;
}

std::string error_name(Int error) {
    static constexpr std::array names{
        "EGL_SUCCESS",       "EGL_NOT_INITIALIZED",     "EGL_BAD_ACCESS",
        "EGL_BAD_ALLOC",     "EGL_BAD_ATTRIBUTE",       "EGL_BAD_CONFIG",
        "EGL_BAD_CONTEXT",   "EGL_BAD_CURRENT_SURFACE", "EGL_BAD_DISPLAY",
        "EGL_BAD_MATCH",     "EGL_BAD_NATIVE_PIXMAP",   "EGL_BAD_NATIVE_WINDOW",
        "EGL_BAD_PARAMETER", "EGL_BAD_SURFACE",         "EGL_CONTEXT_LOST"};
    const auto place = static_cast<std::size_t>(error - success);
    std::array<char, 16> number{};
    std::snprintf(number.data(), number.size(), "0x%04X", static_cast<unsigned>(error));
    return std::string(error >= success && place < names.size() ? names[place] : "EGL error") +
           " (" + number.data() + ")";
}

std::string doctor_hint() {
    return "`cubecam doctor` looks at this machine, and names the command that mends it.";
}

std::string software_hint() {
    return "To render in software install Mesa's drivers: apt install libegl1 libgl1-mesa-dri "
           "(Debian, Ubuntu); dnf "
           "install mesa-libEGL mesa-dri-drivers (Fedora).";
}

std::string driver_variables() {
    std::string text;
    for (const char* name : {"GALLIUM_DRIVER", "MESA_LOADER_DRIVER_OVERRIDE", "LIBGL_DRIVERS_PATH",
                             "LIBGL_ALWAYS_SOFTWARE", "MESA_GL_VERSION_OVERRIDE", "EGL_PLATFORM"}) {
        const char* value = std::getenv(name);
        if (value == nullptr || *value == '\0') continue;
        text += (text.empty() ? "" : " and ") + std::string(name) + "=" + value;
    }
    return text;
}

std::string version_hint() {
    const std::string chosen = driver_variables();
    return "A driver is installed and starts, but it does not offer OpenGL 4.5. " +
           (chosen.empty() ? "A newer driver may: Mesa's llvmpipe does from version 20.3."
                           : chosen + " is set: without it the driver may offer more.");
}

std::string descriptors_hint() {
    const int opened = open("/dev/null", O_RDONLY | O_CLOEXEC);
    const int reason = errno;
    if (opened >= 0) close(opened);
    if (opened >= 0 || (reason != EMFILE && reason != ENFILE)) return "";
    return reason == EMFILE
               ? "This process has as many files open as it may: close some, or raise the limit "
                 "(`ulimit -n`)."
               : "This machine has as many files open as it can: close some.";
}

std::string gpu_hint() {
    std::string text =
        "An NVIDIA GPU needs its driver's libEGL_nvidia.so.0 and a file 10_nvidia.json in "
        "/usr/share/glvnd/egl_vendor.d (in a container: NVIDIA_DRIVER_CAPABILITIES=all); other "
        "GPUs need Mesa's drivers and "
        "the right to open /dev/dri/renderD*.";
    // If this variable is set, GLVND looks at no other driver; with a wrong path it finds none.
    const char* vendors = std::getenv("__EGL_VENDOR_LIBRARY_FILENAMES");
    if (vendors != nullptr)
        text += std::string(" __EGL_VENDOR_LIBRARY_FILENAMES is set: ") + vendors;
    return text;
}

}  // namespace egl

}  // namespace cubecam::gl
