/// Arrays of vertices, from Python and back.
#pragma once

#include "arrays.hpp"
#include "objects.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <vector>

namespace cubecam::bindings {

using FloatRows = py::array_t<float>;
using FloatRowsOrNone = OrNone<FloatRows>;

template <class Vector, class Scalar>
std::vector<Vector> to_vectors(const ContiguousArray<Scalar>& array) {
    static_assert(sizeof(Vector) == Vector::length() * sizeof(Scalar));
    const auto* from = reinterpret_cast<const Vector*>(array.data());
    return std::vector<Vector>(from, from + array.shape(0));
}

/// A read-only view, or None.
template <class Scalar, class Vector>
py::object rows(const std::shared_ptr<const std::vector<Vector>>& vectors) {
    if (!vectors) return py::none();
    const std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(vectors->size()),
                                         Vector::length()};
    return readonly_view(py::dtype::of<Scalar>(), shape, vectors->data(), vectors);
}

}  // namespace cubecam::bindings
