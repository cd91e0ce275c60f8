#pragma once

#include "cubecam/render/frame.hpp"

#include <pybind11/pybind11.h>

namespace cubecam {

namespace py = pybind11;

/// A Frame whose pictures are numpy arrays; each array takes over the memory of its picture. None
/// stands for a picture that was not requested.
struct PyFrame {
    PyFrame() = default;
    explicit PyFrame(Frame frame);

    int width = 0;
    int height = 0;
    Format format = Format::rgba8;
    Encoding encoding = Encoding::linear;
    bool tonemapped = false;
    py::object color;
    py::dict outputs;  ///< arrays by name
};

void bind_frame(py::module_& m);

}  // namespace cubecam
