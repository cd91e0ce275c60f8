#pragma once

#include "cubecam/gl/devices.hpp"
#include "cubecam/gl/egl_display.hpp"

#include <string_view>

/// Functions that list_devices and Context share. Private to gl/.
namespace cubecam::gl {

/// Returns what EGL reports about a device without starting its driver; `name` may still be empty.
DeviceInfo probe_extensions(egl::Device device, int index);

/// Fills the members that EGL did not report from the strings of a context on that device.
void complete_from_gl(DeviceInfo& info, std::string_view vendor, std::string_view renderer,
                      std::string_view version);

/// Returns the driver's part of a version, the text after the number and the profile: "Mesa 22.3.6"
/// for "4.5 (Core Profile) Mesa 22.3.6".
std::string driver_of_version(std::string_view gl_version);

/// Whether a GL_RENDERER draws on the CPU: Mesa's rasterisers, also below zink, SwiftShader, WARP,
/// and virgl, unless it names a GPU of the host.
bool is_software_renderer(std::string_view renderer);

/// The words by which create_gl45 says that a driver works but is too old.
inline constexpr std::string_view older_version = "the driver offers OpenGL ";

/// Makes a context of OpenGL 4.5 core on a display, one that reports resets of the GPU if there is
/// such a one. Throws ContextError if there is none; its text names the version that the driver
/// has, and `info` is completed from a context of that version.
egl::RawContext create_gl45(const egl::OpenDisplay& display, bool debug, DeviceInfo& info);

/// Adds a frequent cause on this device to the text of a failure.
std::string explain_failure(const std::string& text, const DeviceInfo& device);

}  // namespace cubecam::gl
