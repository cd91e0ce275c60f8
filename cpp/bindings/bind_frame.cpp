#include "arrays.hpp"
#include "docs/frame.hpp"
#include "encodings.hpp"
#include "formats.hpp"
#include "frame.hpp"
#include "objects.hpp"

#include "cubecam/render/resources/outputs.hpp"

#include <pybind11/stl.h>
#include <pybind11/typing.h>

#include <string>
#include <string_view>
#include <tuple>
#include <vector>

namespace cubecam {

PyFrame::PyFrame(Frame frame)
    : width(frame.width), height(frame.height), format(frame.format), encoding(frame.encoding),
      tonemapped(frame.tonemapped), color(py::none()) {
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

py::tuple state_of(const PyFrame& frame) {
    return py::make_tuple(frame.width, frame.height, frame.color, frame.outputs,
                          to_string(frame.format), to_string(frame.encoding), frame.tonemapped);
}

PyFrame from_state(const py::tuple& closed) {
    const py::tuple state = bindings::opened_state(closed);
    // The first pickles of cubecam 0.2 have neither format nor encoding, the next no curve.
    if (state.size() != 4 && state.size() != 6 && state.size() != 7) {
        throw py::value_error("Frame: expected a state of 7 parts, got " +
                              std::to_string(state.size()));
    }
    PyFrame frame;
    frame.width = state[0].cast<int>();
    frame.height = state[1].cast<int>();
    frame.color = state[2];
    frame.outputs = state[3].cast<py::dict>();
    if (state.size() == 7) frame.tonemapped = state[6].cast<bool>();
    if (state.size() > 4) {
        frame.format = parse_format(state[4].cast<std::string>());
        frame.encoding = parse_encoding(state[5].cast<std::string>());
    } else if (!frame.color.is_none()) {
        const DType dtype = to_dtype(frame.color.attr("dtype"), DType::uint8);
        for (const Format format : {Format::rgba8, Format::rgba16f, Format::rgba32f}) {
            if (dtype_of(format) == dtype) frame.format = format;
        }
    }
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
        bindings::with_array_type(row.type, [&](auto type) {
            frame_class.def_property_readonly(
                row.name.data(),
                [name = row.name](const PyFrame& f) -> decltype(type) {
                    return output_of(f, name);
                },
                output_doc(row).c_str());
        });
    }
    frame_class
        .def_property_readonly(
            "color", [](const PyFrame& f) -> bindings::Pixels { return f.color; },
            "ndarray (H, W, 4): the colour, uint8, float16 or float32 by ``format``; "
            "`encoding` says what the numbers are. None with ``format=None``.")
        .def_property_readonly(
            "outputs",
            [](const PyFrame& f) {
                return f.outputs.attr("copy")()
                    .cast<py::typing::Dict<py::str, bindings::OutputArray>>();
            },
            docs::frame_outputs)
        .def_property_readonly(
            "format",
            [](const PyFrame& f) -> std::optional<bindings::FormatName> {
                if (f.color.is_none()) return std::nullopt;
                return to_string(f.format);
            },
            "str: the format of `color`, as `Renderer.render` takes it; None without a colour.")
        .def_property_readonly(
            "encoding",
            [](const PyFrame& f) -> bindings::EncodingNow { return to_string(f.encoding); },
            "str: \"linear\" or \"srgb\", what the numbers of `color` are.")
        .def_property_readonly(
            "_tonemapped", [](const PyFrame& f) { return f.tonemapped; },
            "bool: whether `Renderer.render` applied a tone curve, so that files need none.")
        .def_property_readonly(
            "size",
            [](const PyFrame& f) -> bindings::Size { return py::make_tuple(f.width, f.height); },
            "tuple of int: (width, height), pixels.")
        .def("__repr__",
             [](const PyFrame& f) {
                 std::string text = "Frame(size=(" + std::to_string(f.width) + ", " +
                                    std::to_string(f.height) + "), format=";
                 text += f.color.is_none() ? "None" : "'" + std::string(to_string(f.format)) + "'";
                 if (!f.outputs.empty()) {
                     text += ", outputs=" + py::repr(py::tuple(f.outputs)).cast<std::string>();
                 }
                 return text + ", encoding='" + std::string(to_string(f.encoding)) + "')";
             })
        .def("__reduce__", [](const PyFrame& frame) -> py::tuple {
            const py::object restore = py::module_::import("cubecam._core").attr("_restore_frame");
            return py::make_tuple(restore, py::make_tuple(bindings::closed_state(state_of(frame))));
        });
    m.def(
        "_output_table",
        [] {
            std::vector<std::tuple<std::string_view, bool, int, std::string_view, std::string_view>>
                rows;
            for (const OutputRow& row : output_table) {
                rows.emplace_back(row.name, row.source == OutputSource::shader, row.channels,
                                  output_type_name(row.type), row.meaning);
            }
            return rows;
        },
        "Of each output: its name, whether shaders write it, channels, dtype, and meaning.");
    m.def("_restore_frame", &from_state, py::arg("state"), "For unpickling.");
}

}  // namespace cubecam
