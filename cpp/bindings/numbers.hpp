/// Whole numbers, real numbers, truth values and sizes, from Python. These functions are the one
/// check for them: the casters of values.hpp call them, and python/cubecam/_checks.py does.
#pragma once

#include "cubecam/core/error.hpp"

#include <pybind11/pybind11.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

namespace cubecam {

namespace py = pybind11;

/// A value as messages show it: numbers, texts and short lists of them as Python writes them, but
/// never more than about 100 letters; of other values what their repr says in one short line, or
/// their type. An error of the value's own repr is no error here.
std::string text_of(py::handle value);

/// An int of Python or numpy, or another object with `__index__`. None for a bool, a float, a text,
/// an array with axes, a masked value, and where `__index__` raises an Exception. A number beyond
/// 64 bits becomes the nearest one of 64 bits, since every caller checks limits that are narrower.
std::optional<std::int64_t> whole_number(py::handle value);

/// A real number of Python or numpy, NaN and infinities included, or another object with
/// `__float__`. None for a bool, a complex number, a text, an array with axes, a masked value, an
/// int that float64 cannot hold, and where `__float__` raises an Exception.
std::optional<double> real_number(py::handle value);

/// A bool of Python or numpy. None for everything else, since 0.5, "no" and nan are neither true
/// nor false.
std::optional<bool> truth_value(py::handle value);

/// A whole number; everything else raises TypeError.
std::int64_t to_int(py::handle value, const char* name);

/// A whole number within limits; one beyond them raises ValueError.
std::int64_t to_int(py::handle value, const char* name, std::int64_t low, std::int64_t high);

/// The pair (width, height).
std::pair<std::int64_t, std::int64_t> to_size(py::handle value);

}  // namespace cubecam
