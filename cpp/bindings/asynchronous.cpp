#include "asynchronous.hpp"

#include "objects.hpp"
#include "values.hpp"

#include "cubecam/gl/context.hpp"
#include "cubecam/render/resources/read_ring.hpp"

#include <pybind11/stl.h>

namespace py = pybind11;

namespace cubecam::bindings {

namespace {

/// Whether a call was ever submitted: until then the module is not loaded.
bool submitted = false;

py::module_ futures() { return py::module_::import("cubecam._futures"); }

/// Whether this thread may wait for the thread that serves the renderer. It may not where it is
/// that thread (in a callback of a future), and where the other one waits for it: in a signal
/// handler that has interrupted a call of the renderer.
bool may_wait(Renderer& renderer) {
    return !renderer.line().served_here() && !renderer.line().called_here();
}

}  // namespace

py::object submit(const std::shared_ptr<Renderer>& renderer, std::size_t bytes,
                  std::shared_ptr<LaterCall> call) {
    submitted = true;
    return futures().attr("submit")(renderer, std::move(call), bytes, may_wait(*renderer));
}

void end_submitted(const std::shared_ptr<Renderer>& renderer, bool drop) {
    if (!submitted || gl::in_forked_child()) return;
    futures().attr("end")(renderer, drop, may_wait(*renderer));
}

void bind_later_call(py::module_& module) {
    declare<LaterCall>(module, "_LaterCall", "A call of a renderer that waits to be drawn.")
        .def("join_line", &LaterCall::join_line,
             "Take a place in the line of the renderer's calls: in the order of drawing.")
        .def("leave_line", &LaterCall::leave_line,
             "Leave it: the call will not be drawn. Nothing if it is being drawn.")
        .def("draw", &LaterCall::draw,
             "Draw. Returns whether the pixels are there; if not, the next call can be drawn.")
        .def("result", &LaterCall::result, "Wait for the pixels, and give the result.")
        .def_readonly("notices", &LaterCall::notices,
                      "list of str: what the last of these two had to tell, also if it raised.");
    module.def(
        "_read_through_buffers",
        [](Flag always) { return ReadRing::for_all_drivers.exchange(static_cast<bool>(always)); },
        py::arg("always"),
        "For tests: software drivers read pictures through buffers, as GPUs do; returns the value "
        "before.");
}

}  // namespace cubecam::bindings
