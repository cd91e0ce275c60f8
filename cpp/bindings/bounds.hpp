/// Bounds as arrays (2, 3), from Python and back.
#pragma once

#include "arrays.hpp"

#include "cubecam/geometry/mesh_data.hpp"

#include <pybind11/numpy.h>

namespace cubecam::bindings {

inline py::array_t<double> bounds_array(const Bounds& bounds) {
    py::array_t<double> array({2, 3});
    for (int i = 0; i < 3; ++i) {
        array.mutable_at(0, i) = bounds.low[i];
        array.mutable_at(1, i) = bounds.high[i];
    }
    array.attr("flags").attr("writeable") = false;
    return array;
}

/// Bounds from an array (2, 3). Infinities are kept: bounds of nothing have them.
inline Bounds to_bounds(py::handle value, const char* name) {
    const auto array = double_array(value, name, "(2, 3)", Values::not_nan);
    const double* at = array.data();
    return {{at[0], at[1], at[2]}, {at[3], at[4], at[5]}};
}

}  // namespace cubecam::bindings
