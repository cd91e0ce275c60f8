/// Names that a caller may have meant, for messages.
#pragma once

#include "cubecam/core/parse_name.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <set>
#include <string>
#include <vector>

namespace cubecam::bindings {

namespace py = pybind11;

inline std::string quoted(const std::string& text) {
    return py::repr(py::str(text)).cast<std::string>();
}

/// "'bal'; did you mean 'ball' or 'bail'?"
inline std::string with_near_names(const std::string& name, const std::set<std::string>& known) {
    const auto near = py::module_::import("difflib")
                          .attr("get_close_matches")(
                              shortened(name), std::vector<std::string>(known.begin(), known.end()))
                          .cast<std::vector<std::string>>();
    std::string text = quoted(shortened(name));
    for (const std::string& one : near) {
        text += (&one == &near.front() ? "; did you mean " : " or ") + quoted(one);
    }
    return text + (near.empty() ? "" : "?");
}

}  // namespace cubecam::bindings
