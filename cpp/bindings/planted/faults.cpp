// Faults on purpose, in the modules of `make sanitize` alone: a sanitizer that does not report them
// finds nothing else either. CUBECAM_PLANTED_FAULTS compiles this file.
#include <pybind11/pybind11.h>

#include <climits>
#include <memory>
#include <thread>

namespace cubecam::bindings {

namespace {

int shared_count = 0;  // threads change it without a lock

/// Reads one number after the end of a block of memory.
int planted_overflow() {
    const auto numbers = std::make_unique<int[]>(4);
    const volatile int place = 4;
    return numbers[place];
}

/// Adds to the greatest int.
int planted_undefined() {
    const volatile int number = INT_MAX;
    return number + 1;
}

/// Counts in two threads without a lock. They are started here, since the interpreter's lock would
/// order two threads of Python that happen to run one after the other.
void planted_race() {
    const auto count = [] { shared_count = shared_count + 1; };
    std::thread one(count);
    std::thread other(count);
    one.join();
    other.join();
}

}  // namespace

}  // namespace cubecam::bindings

void bind_planted_faults(pybind11::module_& module) {
    namespace py = pybind11;
    using namespace cubecam::bindings;
    module.def("_planted_overflow", &planted_overflow);
    module.def("_planted_undefined", &planted_undefined);
    module.def("_planted_race", &planted_race, py::call_guard<py::gil_scoped_release>());
}
