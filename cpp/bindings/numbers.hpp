/// Whole numbers and sizes, from Python.
#pragma once

#include "cubecam/core/error.hpp"

#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>
#include <utility>

namespace cubecam {

namespace py = pybind11;

inline std::string text_of(py::handle value) { return py::repr(value).cast<std::string>(); }

/// A whole number of Python or numpy; a bool raises TypeError. A number beyond 64 bits becomes the
/// nearest one of 64 bits, since every caller checks limits that are narrower.
inline std::int64_t to_int(py::handle value, const char* name) {
    if (py::isinstance<py::bool_>(value) || PyIndex_Check(value.ptr()) == 0) {
        throw TypeError(std::string(name) + ": expected an int, got " + text_of(value));
    }
    const std::int64_t number = PyNumber_AsSsize_t(value.ptr(), nullptr);
    if (number == -1 && PyErr_Occurred() != nullptr) throw py::error_already_set();
    return number;
}

/// A whole number within limits.
inline std::int64_t to_int(py::handle value, const char* name, std::int64_t low,
                           std::int64_t high) {
    const std::int64_t number = to_int(value, name);
    if (number >= low && number <= high) return number;
    throw py::value_error(std::string(name) + ": expected an int from " + std::to_string(low) +
                          " to " + std::to_string(high) + ", got " + text_of(value));
}

/// The pair (width, height).
inline std::pair<std::int64_t, std::int64_t> to_size(py::handle value) {
    if (!py::isinstance<py::sequence>(value) || py::isinstance<py::str>(value) ||
        py::len(value) != 2) {
        throw TypeError("size: expected (width, height) in pixels, got " + text_of(value));
    }
    const auto pair = py::reinterpret_borrow<py::sequence>(value);
    return {to_int(py::object(pair[0]), "width"), to_int(py::object(pair[1]), "height")};
}

}  // namespace cubecam
