#include "cubecam/gl/devices.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/device_probe.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <mutex>
#include <unistd.h>

namespace cubecam::gl {

namespace {

// Copies of GL's constants: this file needs one function of GL and no header.
constexpr unsigned gl_vendor = 0x1F00;
constexpr unsigned gl_renderer = 0x1F01;
constexpr unsigned gl_version = 0x1F02;

using GetString = const unsigned char* (*)(unsigned);

std::string text_or_empty(const char* text) { return text != nullptr ? text : ""; }

std::string gl_string(unsigned name) {
    const auto get = reinterpret_cast<GetString>(egl::library().get_proc_address("glGetString"));
    const unsigned char* text = get != nullptr ? get(name) : nullptr;
    return text_or_empty(reinterpret_cast<const char*>(text));
}

std::string format_uuid(const std::array<unsigned char, 16>& bytes) {
    static constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i == 4 || i == 6 || i == 8 || i == 10) text += '-';
        text += digits[bytes[i] >> 4];
        text += digits[bytes[i] & 15];
    }
    return text;
}

/// Starts the driver to learn why it fails, and its name if EGL does not report it.
void probe_driver(DeviceInfo& info, egl::Device device) {
    try {
        const egl::OpenDisplay display = egl::open_display(egl::Platform::device, device);
        if (info.name.empty()) {
            const egl::RawContext context = create_gl45(display, false, info);
            const egl::Current current(context);
            complete_from_gl(info, gl_string(gl_vendor), gl_string(gl_renderer),
                             gl_string(gl_version));
        }
    } catch (const ContextError& error) {
        info.problem = explain_failure(error.what(), info);
    }
    if (info.name.empty()) info.name = "unknown";
    if (info.vendor.empty()) info.vendor = "unknown";
}

}  // namespace

bool is_software_renderer(std::string_view renderer) {
    std::string text(renderer);
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    static constexpr std::array names{"llvmpipe", "lavapipe",           "softpipe",
                                      "swrast",   "swiftshader",        "software rasterizer",
                                      "swr (",    "basic render driver"};
    if (std::any_of(names.begin(), names.end(),
                    [&](std::string_view name) { return text.find(name) != std::string::npos; })) {
        return true;
    }
    // A virtual machine's driver passes its calls to the host. Newer versions name the host's
    // driver in brackets, "virgl (AMD Radeon ...)". Without a name the host may draw on its CPU.
    return text.starts_with("virgl") && text.find('(') == std::string::npos;
}

std::string driver_of_version(std::string_view version) {
    const auto drop_word = [&] {
        version.remove_prefix(std::min(version.find(' '), version.size()));
        version.remove_prefix(std::min(version.find_first_not_of(' '), version.size()));
    };
    drop_word();
    if (version.starts_with('(')) {
        version.remove_prefix(std::min(version.find(')'), version.size()));
        drop_word();
    }
    return std::string(version);
}

void complete_from_gl(DeviceInfo& info, std::string_view vendor, std::string_view renderer,
                      std::string_view version) {
    if (info.name.empty()) info.name = renderer;
    if (info.vendor.empty()) info.vendor = vendor;
    if (info.driver.empty()) info.driver = driver_of_version(version);
    info.software = info.software || is_software_renderer(renderer);
}

DeviceInfo probe_extensions(egl::Device device, int index) {
    const egl::Table& egl = egl::library();
    const char* list = egl.query_device_string(device, egl::extensions);
    const auto has = [&](const char* name) { return egl::has_name(list, name); };
    const auto string = [&](egl::Int name) {
        return text_or_empty(egl.query_device_string(device, name));
    };

    DeviceInfo info;
    info.index = index;
    info.platform = egl::platform_name(egl::Platform::device);
    info.software = has("EGL_MESA_device_software");
    if (has("EGL_EXT_device_query_name")) {
        info.name = string(egl::renderer_name);
        info.vendor = string(egl::vendor);
    }
    if (has("EGL_EXT_device_persistent_id")) {
        info.driver = string(egl::driver_name);
        std::array<unsigned char, 16> bytes{};
        egl::Int size = 0;
        if (egl.query_device_binary != nullptr &&
            egl.query_device_binary(device, egl::device_uuid, static_cast<egl::Int>(bytes.size()),
                                    bytes.data(), &size) &&
            size == static_cast<egl::Int>(bytes.size())) {
            info.uuid = format_uuid(bytes);
        }
    }
    if (has("EGL_NV_device_cuda") && egl.query_device_attrib != nullptr) {
        egl::Attrib number = 0;
        if (egl.query_device_attrib(device, egl::cuda_device, &number))
            info.cuda_index = static_cast<int>(number);
    }
    // The render node is preferred: opening it needs no rights to the screen.
    if (has("EGL_EXT_device_drm_render_node")) info.drm_node = string(egl::drm_render_node_file);
    if (info.drm_node.empty() && has("EGL_EXT_device_drm"))
        info.drm_node = string(egl::drm_device_file);
    info.software = info.software || is_software_renderer(info.name);
    return info;
}

egl::RawContext create_gl45(const egl::OpenDisplay& display, bool debug, DeviceInfo& info) {
    std::string text;
    // A software driver never resets. A driver that refuses a robust context may still make a plain
    // one.
    if (display.robust && !info.software) {
        try {
            return egl::RawContext(display, 4, 5, debug, true);
        } catch (const ContextError&) {
        }
    }
    try {
        return egl::RawContext(display, 4, 5, debug);
    } catch (const ContextError& error) {
        text = error.what();
    }
    try {
        // When the lowest core version is requested, a driver gives its newest one.
        const egl::RawContext older(display, 3, 2, false);
        const egl::Current current(older);
        complete_from_gl(info, gl_string(gl_vendor), gl_string(gl_renderer), gl_string(gl_version));
        text += ": " + std::string(older_version) + gl_string(gl_version) + ", 4.5 is needed";
    } catch (const ContextError&) {
        text += " (nor is there a context of OpenGL 3.2)";
    }
    throw ContextError(text);
}

std::string explain_failure(const std::string& text, const DeviceInfo& device) {
    if (!device.drm_node.empty() && access(device.drm_node.c_str(), R_OK | W_OK) != 0) {
        return text + " (no permission on " + device.drm_node +
               ": the user must be in its group, often \"render\")";
    }
    if (device.software && text.find("EGL_NOT_INITIALIZED") != std::string::npos) {
        const std::string chosen = egl::driver_variables();
        return text + (chosen.empty()
                           ? " (Mesa's software driver is missing: package libgl1-mesa-dri or "
                             "mesa-dri-drivers)"
                           : " (the driver that " + chosen + " chooses does not start)");
    }
    return text;
}

std::vector<DeviceInfo> list_devices() {
    // The description of a working device does not change; a driver that failed is tried again.
    static std::mutex known_mutex;
    static auto* known = new std::map<egl::Device, DeviceInfo>();

    const std::vector<egl::Device> handles = egl::query_devices();
    std::vector<DeviceInfo> devices;
    const std::lock_guard lock(known_mutex);
    for (std::size_t i = 0; i < handles.size(); ++i) {
        const auto found = known->find(handles[i]);
        if (found != known->end()) {
            devices.push_back(found->second);
            devices.back().index = static_cast<int>(i);
            continue;
        }
        DeviceInfo info = probe_extensions(handles[i], static_cast<int>(i));
        probe_driver(info, handles[i]);
        if (info.problem.empty()) known->emplace(handles[i], info);
        devices.push_back(std::move(info));
    }
    return devices;
}

std::string describe(const DeviceInfo& device) {
    std::string text =
        std::to_string(device.index) + ": " + (device.name.empty() ? "unknown" : device.name);
    if (!device.uuid.empty()) text += ", UUID " + device.uuid;
    if (device.software) text += " [software]";
    if (!device.problem.empty()) text += " [" + device.problem + "]";
    return text;
}

}  // namespace cubecam::gl
