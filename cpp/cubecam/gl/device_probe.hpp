#pragma once

#include "cubecam/gl/devices.hpp"
#include "cubecam/gl/egl_display.hpp"

#include <string_view>

/// What list_devices and Context share. Private to gl/.
namespace cubecam::gl {

/// What EGL says of a device without starting its driver; `name` may still be empty.
DeviceInfo probe_extensions(egl::Device device, int index);

/// Fills what EGL did not tell from the strings of a context on that device.
void complete_from_gl(DeviceInfo& info, std::string_view vendor, std::string_view renderer,
                      std::string_view version);

/// "Mesa 22.3.6" of "4.5 (Core Profile) Mesa 22.3.6": what follows the number is the driver's.
std::string driver_of_version(std::string_view gl_version);

/// Whether GL_RENDERER is one of Mesa's CPU rasterisers.
bool is_software_renderer(std::string_view renderer) noexcept;

/// A context of OpenGL 4.5 core on a display. Where there is none, the text says which version
/// there is, and `info` is completed from that one.
egl::RawContext create_gl45(const egl::OpenDisplay& display, bool debug, DeviceInfo& info);

/// Adds to a failure's text what often causes it on this device.
std::string explain_failure(const std::string& text, const DeviceInfo& device);

}  // namespace cubecam::gl
