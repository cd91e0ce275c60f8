#pragma once

#include "cubecam/gl/egl_types.hpp"

#include <string>
#include <string_view>

/// The EGL library of this process: opened at run time, never linked. Private to gl/.
namespace cubecam::gl::egl {

/// Returns the function table. The first call opens the library (CUBECAM_EGL_LIBRARY, otherwise
/// libEGL.so.1), which then stays open. A failure is not remembered, so that the next call works
/// once the package is installed. Throws ContextError with the loader's text and the package to
/// install, and in a forked child.
const Table& library();

/// Throws ContextError that names "spawn" in a process forked after the library was opened.
void refuse_forked_child();

/// Whether a space-separated list names an extension; a null list is empty.
bool has_name(const char* list, std::string_view name) noexcept;

/// Returns the name of an error: "EGL_NOT_INITIALIZED (0x3001)".
std::string error_name(Int error);

/// Texts that say what to install or set if no context could be started.
std::string software_hint();
std::string gpu_hint();
/// Names the command that finds the cause on this machine.
std::string doctor_hint();
/// For drivers that start and offer an older OpenGL.
std::string version_hint();

/// The environment variables that are set and choose Mesa's driver or its version, such as
/// "GALLIUM_DRIVER=softpipe"; empty if there is none.
std::string driver_variables();
/// What to do if this process has no file descriptors left; else empty.
std::string descriptors_hint();

}  // namespace cubecam::gl::egl
