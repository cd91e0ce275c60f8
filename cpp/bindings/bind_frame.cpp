#include "arrays.hpp"
#include "frame.hpp"
#include "objects.hpp"

#include <pybind11/stl.h>

namespace cubecam {

PyFrame::PyFrame(Frame frame) : width(frame.width), height(frame.height) {
    const auto rows = static_cast<py::ssize_t>(frame.height);
    const auto columns = static_cast<py::ssize_t>(frame.width);
    color = py::none();
    if (!frame.color.empty()) {
        color = owned_pixels(std::move(frame.color), dtype_of(frame.format), {rows, columns, 4});
    }
    const auto flat = [&](auto&& values) -> py::object {
        if (values.empty()) return py::none();
        return owned_array(std::move(values), {rows, columns});
    };
    const auto vectors = [&](Buffer<float>&& values) -> py::object {
        if (values.empty()) return py::none();
        return owned_array(std::move(values), {rows, columns, 3});
    };
    distance = flat(std::move(frame.distance));
    z = flat(std::move(frame.z));
    normal = vectors(std::move(frame.normal));
    position = vectors(std::move(frame.position));
    id = flat(std::move(frame.id));
    depth = flat(std::move(frame.depth));
    stencil = flat(std::move(frame.stencil));
}

namespace {

py::tuple state_of(const PyFrame& frame) {
    return py::make_tuple(frame.width, frame.height, frame.color, frame.distance, frame.z,
                          frame.normal, frame.position, frame.id, frame.depth, frame.stencil);
}

PyFrame frame_from(const py::tuple& closed) {
    const py::tuple state = bindings::opened_state(closed);
    PyFrame frame;
    frame.width = state[0].cast<int>();
    frame.height = state[1].cast<int>();
    frame.color = state[2];
    frame.distance = state[3];
    frame.z = state[4];
    frame.normal = state[5];
    frame.position = state[6];
    frame.id = state[7];
    frame.depth = state[8];
    frame.stencil = state[9];
    return frame;
}

}  // namespace

void bind_frame(py::module_& m) {
    bindings::declare<PyFrame>(
        m, "Frame", R"(A rendered picture: arrays with row 0 on top, each the caller's own.

What was not asked for by ``outputs=`` is None. Only opaque nodes write the outputs; `depth` and
`stencil` are what those buffers hold in the end.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene(background=(1, 0, 0))
>>> with cc.Renderer() as renderer:
...     frame = renderer.render(scene, cc.PerspectiveCamera(), size=(4, 2))
>>> frame.color.shape, frame.color[0, 0].tolist()
((2, 4, 4), [255, 0, 0, 255])
)")
        .def_readonly("color", &PyFrame::color,
                      "ndarray (H, W, 4): uint8, float16 or float32 as ``format`` said; linear "
                      "unless encoded. None with ``format=None``.")
        .def_readonly("distance", &PyFrame::distance,
                      "ndarray (H, W) float32: length of the ray, world units; +inf where nothing "
                      "was hit. In an "
                      "orthographic picture it counts from the near plane.")
        .def_readonly("z", &PyFrame::z,
                      "ndarray (H, W) float32: distance along the camera's axis, world units; +inf "
                      "background.")
        .def_readonly("normal", &PyFrame::normal,
                      "ndarray (H, W, 3) float32: world shading normal, unit length, towards the "
                      "viewer; 0 background.")
        .def_readonly("position", &PyFrame::position,
                      "ndarray (H, W, 3) float32: world position; NaN background.")
        .def_readonly("id", &PyFrame::id,
                      "ndarray (H, W) int32: ``Node.id`` of what is seen; 0 background.")
        .def_readonly("depth", &PyFrame::depth,
                      "ndarray (H, W) float32: OpenGL's window-space z, 0 at the near plane, 1 at "
                      "the far plane and where nothing is, as fine as ``depth_format`` keeps it.")
        .def_readonly("stencil", &PyFrame::stencil, "ndarray (H, W) uint8: 0 background.")
        .def_property_readonly(
            "size", [](const PyFrame& f) { return py::make_tuple(f.width, f.height); },
            "tuple of int: (width, height), pixels.")
        .def("__repr__",
             [](const PyFrame& f) {
                 return "<cubecam.Frame " + std::to_string(f.width) + " x " +
                        std::to_string(f.height) + ", " +
                        (f.color.is_none() ? std::string("no colour")
                                           : py::str(f.color.attr("dtype")).cast<std::string>()) +
                        ">";
             })
        .def("__reduce__", [](const PyFrame& frame) -> py::tuple {
            const py::object restore = py::module_::import("cubecam._core").attr("_restore_frame");
            return py::make_tuple(restore, py::make_tuple(bindings::closed_state(state_of(frame))));
        });
    m.def("_restore_frame", &frame_from, py::arg("state"), "For unpickling.");
}

}  // namespace cubecam
