// What the Python part of cubecam shares with the bindings: how arguments that take arrays are
// read.
#include "arrays.hpp"
#include "objects.hpp"

#include <pybind11/pybind11.h>

void bind_arrays(pybind11::module_& module) {
    namespace py = pybind11;
    using namespace cubecam;
    using AnyArray = bindings::Shown<"numpy.typing.NDArray[numpy.generic]">;
    module.def(
        "_to_array",
        [](const py::object& value, const char* name) -> AnyArray {
            // Of a subclass of ndarray, numpy's functions could return objects of that class.
            return py::module_::import("numpy").attr("asarray")(to_array(value, name));
        },
        py::arg("value"), py::arg("name"),
        "The value as an array. Raises TypeError for a masked array that hides values, also in "
        "lists "
        "and tuples, and ValueError for rows of unequal length.");
}
