#include "notices.hpp"

#include "cubecam/core/notices.hpp"

#include <string>

namespace py = pybind11;

namespace cubecam::bindings {

void warn_of_notices() {
    for (const std::string& text : take_notices()) {
        const py::module_ warnings = py::module_::import("cubecam._warnings");
        warnings.attr("warn_user")(text, warnings.attr("RendererWarning"));
    }
}

void warn_of_notices_after_error() noexcept {
    try {
        warn_of_notices();
    } catch (...) {  // the error of the call is the one that the user needs
    }
}

}  // namespace cubecam::bindings
