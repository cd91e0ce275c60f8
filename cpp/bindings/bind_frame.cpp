#include "arrays.hpp"
#include "docs/frame.hpp"
#include "frame.hpp"
#include "objects.hpp"

#include "cubecam/render/resources/outputs.hpp"

#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <string>
#include <string_view>
#include <vector>

namespace cubecam {

PyFrame::PyFrame(Frame frame) : width(frame.width), height(frame.height), color(py::none()) {
    const std::vector<py::ssize_t> flat = {frame.height, frame.width};
    const auto with_channels = [&flat](int channels) {
        std::vector<py::ssize_t> shape = flat;
        if (channels > 1) shape.push_back(channels);
        return shape;
    };
    if (frame.color != nullptr) {
        color = owned_pixels(std::move(frame.color), numpy_dtype(dtype_of(frame.format)),
                             with_channels(4));
    }
    for (OutputValues& output : frame.outputs) {
        outputs[py::str(output.name)] = owned_pixels(
            std::move(output.values), numpy_dtype(output.type), with_channels(output.channels));
    }
}

namespace {

constexpr py::ssize_t parts = 4;

py::tuple state_of(const PyFrame& frame) {
    return py::make_tuple(frame.width, frame.height, frame.color, frame.outputs);
}

PyFrame from_state(const py::tuple& closed) {
    const py::tuple state = bindings::opened_state(closed);
    if (state.size() != parts) {
        throw py::value_error("Frame: expected a state of " + std::to_string(parts) +
                              " parts, got " + std::to_string(state.size()));
    }
    PyFrame frame;
    frame.width = state[0].cast<int>();
    frame.height = state[1].cast<int>();
    frame.color = state[2];
    frame.outputs = state[3].cast<py::dict>();
    return frame;
}

py::object output_of(const PyFrame& frame, std::string_view name) {
    const py::str key(name.data(), name.size());
    return frame.outputs.contains(key) ? py::object(frame.outputs[key]) : py::none();
}

std::string output_doc(const OutputRow& row) {
    return "ndarray (H, W" + (row.channels > 1 ? ", " + std::to_string(row.channels) : "") + ") " +
           output_type_name(row.type) + ": " + std::string(row.meaning) + ".";
}

}  // namespace

void bind_frame(py::module_& m) {
    auto frame_class = bindings::declare<PyFrame>(m, "Frame", docs::frame);
    for (const OutputRow& row : output_table) {
        frame_class.def_property_readonly(
            row.name.data(), [name = row.name](const PyFrame& f) { return output_of(f, name); },
            output_doc(row).c_str());
    }
    frame_class
        .def_readonly(
            "color", &PyFrame::color,
            "ndarray (H, W, 4): the colour, uint8, float16 or float32 by ``format``; linear, "
            "except with ``encode=``. None with ``format=None``.")
        .def_property_readonly(
            "outputs",
            [](const PyFrame& f) {
                return f.outputs.attr("copy")().cast<py::typing::Dict<py::str, py::array>>();
            },
            docs::frame_outputs)
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
    m.def(
        "_shaded_outputs",
        [] {
            std::vector<std::string_view> names;
            for (const OutputRow& row : output_table) {
                if (row.source == OutputSource::shader) names.push_back(row.name);
            }
            return names;
        },
        "Names of the outputs that shaders write, for the command line.");
    m.def("_restore_frame", &from_state, py::arg("state"), "For unpickling.");
}

}  // namespace cubecam
