// The format number that pickles of all classes have.
#include "objects.hpp"

#include <pybind11/pybind11.h>

#include <string>

namespace cubecam::bindings {

namespace {

[[noreturn]] void refuse_old_pickle() {
    throw py::type_error(
        "this pickle was made by cubecam 0.1, expected one of 0.2 or later: rebuild the scene, or "
        "read it with cubecam 0.1");
}

}  // namespace

void check_pickle(py::handle format) {
    if (!py::isinstance<py::int_>(format)) refuse_old_pickle();
    const auto number = format.cast<long>();
    if (number != pickle_format) {
        throw py::type_error("this pickle was made by another cubecam, expected format " +
                             std::to_string(pickle_format) + ", got " + std::to_string(number) +
                             ": read it with the version that made it");
    }
}

py::object opened_state(py::handle state) {
    if (!py::isinstance<py::tuple>(state) || py::len(state) != 2) refuse_old_pickle();
    const auto pair = py::reinterpret_borrow<py::tuple>(state);
    check_pickle(pair[0]);
    return pair[1];
}

}  // namespace cubecam::bindings

void bind_pickling(pybind11::module_& module) {
    namespace py = pybind11;
    module.def("_check_pickle", &cubecam::bindings::check_pickle, py::arg("format"),
               "For unpickling: raises TypeError for a format that is not this version's.");
}
