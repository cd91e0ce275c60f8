// What the Python part of cubecam shares with the bindings: how arguments that take arrays are
// read, and what is a whole number, a real number and a bool.
#include "arrays.hpp"
#include "numbers.hpp"
#include "objects.hpp"

#include "cubecam/core/memory.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/typing.h>

#include <cerrno>
#include <cstddef>
#include <string>
#include <sys/mman.h>

namespace {

namespace py = pybind11;

/// Maps a file of shared memory. Python's mmap would keep a descriptor for each mapping.
py::array map_shared(int descriptor, std::size_t bytes) {
    void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0);
    if (memory == MAP_FAILED) {
        PyErr_SetFromErrno(PyExc_OSError);
        throw py::error_already_set();
    }
    struct Mapping {
        void* memory;
        std::size_t bytes;
    };
    py::capsule owner(new Mapping{memory, bytes}, [](void* at) {
        const auto* mapping = static_cast<Mapping*>(at);
        munmap(mapping->memory, mapping->bytes);
        delete mapping;
    });
    return {py::dtype::of<std::uint8_t>(), {static_cast<py::ssize_t>(bytes)}, memory, owner};
}

}  // namespace

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
    module.def(
        "_map_shared",
        [](int descriptor, std::size_t bytes)
            ->bindings::Shown<"numpy.typing.NDArray[numpy.uint8]"> {
                return map_shared(descriptor, bytes);
            },
        py::arg("descriptor"), py::arg("bytes"),
        "The memory of a file, (bytes,) uint8: what is written there, all processes see. It is "
        "unmapped when no array needs it.");
    module.def(
        "_is_whole_number", [](const py::object& value) { return whole_number(value).has_value(); },
        py::arg("value"), "Whether a value is an int of Python or numpy, and no bool.");
    module.def(
        "_is_real_number", [](const py::object& value) { return real_number(value).has_value(); },
        py::arg("value"), "Whether a value is a number that a float can hold, and no bool.");
    module.def(
        "_is_truth_value", [](const py::object& value) { return truth_value(value).has_value(); },
        py::arg("value"), "Whether a value is a bool of Python or numpy.");
    module.def(
        "_text_of", [](const py::object& value) { return text_of(value); }, py::arg("value"),
        "A short text for a value in a message. It never raises an Exception.");
    module.def(
        "_memory_left",
        [](const std::string& root) -> py::typing::Tuple<double, py::str> {
            const MemoryLeft left = memory_left(root);
            return py::make_tuple(left.bytes, left.limit);
        },
        py::arg("root") = "/",
        "The bytes that this process may still take, and the name of the limit; `root` is the "
        "folder with proc/ and sys/.");
    module.def(
        "_check_memory", [](double bytes, const std::string& what) { check_memory(bytes, what); },
        py::arg("bytes"), py::arg("what"), "Raises ValueError for what the memory cannot hold.");
}
