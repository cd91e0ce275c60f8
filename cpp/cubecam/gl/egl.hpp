#pragma once

#include "cubecam/gl/egl_types.hpp"

#include <string>
#include <string_view>

/// The EGL library of this process: opened at run time, never linked. Private to gl/.
namespace cubecam::gl::egl {

/// The function table; the first call opens the library (CUBECAM_EGL_LIBRARY, else libEGL.so.1),
/// which then stays open. A failure is not remembered, so that installing the package is enough.
/// Throws ContextError with the loader's text and the package to install, and in a forked child.
const Table& library();

/// Throws ContextError that names "spawn" in a process forked after the library was opened.
void refuse_forked_child();

/// Whether a space-separated list names an extension; a null list is empty.
bool has_name(const char* list, std::string_view name) noexcept;

/// "EGL_NOT_INITIALIZED (0x3001)".
std::string error_name(Int error);

/// What to install or set when nothing could be started.
std::string software_hint();
std::string gpu_hint();

}  // namespace cubecam::gl::egl
