// cubecam.equirect_to_faces and cubecam.faces_to_equirect: panoramas as arrays, many at once.
#include "arrays.hpp"
#include "cubemap_arguments.hpp"
#include "docs/equirect_arrays.hpp"
#include "numbers.hpp"
#include "sampling_name.hpp"
#include "unlocked.hpp"
#include "values.hpp"

#include "cubecam/core/memory.hpp"
#include "cubecam/cubemap/cubemap_resample.hpp"
#include "cubecam/image/result_pool.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

using DTypeOrNone = OneOf<DTypeLike, py::none>;
using PixelsOrNone = OneOf<Pixels, py::none>;
using Shape = std::vector<py::ssize_t>;

/// Where a result goes: an array of the caller, or a new one.
struct Target {
    py::array array;
    std::byte* data;
};

std::string text_of_shape(const Shape& shape) {
    return py::str(py::tuple(py::cast(shape))).cast<std::string>();
}

/// The type of the result: what `dtype` says, else that of `out`, else that of the pixels.
DType result_type(const DTypeOrNone& dtype, const PixelsOrNone& out, DType otherwise) {
    if (!out.is_none() && py::isinstance<py::array>(out)) {
        otherwise = to_dtype(py::array(out).dtype(), otherwise);
    }
    return to_dtype(dtype, otherwise);
}

Target target_in(const PixelsOrNone& out, const Shape& shape, DType type, const PixelArray& from,
                 const char* name) {
    if (!py::isinstance<py::array>(out)) refuse(out, "out", "a numpy array or None");
    py::array array = to_array(out, "out");
    if (Shape(array.shape(), array.shape() + array.ndim()) != shape) {
        throw py::value_error("out: expected shape " + text_of_shape(shape) + ", got " +
                              shape_text(array));
    }
    if (!array.dtype().equal(numpy_dtype(type))) {
        throw py::value_error(std::string("out: expected dtype ") + dtype_name(type) + ", got " +
                              py::str(array.dtype()).cast<std::string>());
    }
    if (!array.writeable()) throw py::value_error("out: expected an array that may be written");
    if ((array.flags() & py::array::c_style) == 0) {
        throw py::value_error("out: expected an array in C order, without gaps");
    }
    if (py::module_::import("numpy").attr("may_share_memory")(array, from.array()).cast<bool>()) {
        throw py::value_error(std::string("out: expected memory of its own, got that of ") + name);
    }
    auto* data = static_cast<std::byte*>(array.mutable_data());
    return {std::move(array), data};
}

Target new_target(const Shape& shape, DType type) {
    double bytes = static_cast<double>(dtype_size(type));
    for (const py::ssize_t length : shape) bytes *= static_cast<double>(length);
    check_memory(bytes, "pixels of shape " + text_of_shape(shape));
    auto memory = result_memory(static_cast<std::size_t>(bytes));
    std::byte* data = memory->data();
    return {owned_pixels(std::move(memory), numpy_dtype(type), shape), data};
}

/// The lengths of the axes in front of the last `axes`, and how many pictures they make.
Shape leading_axes(const PixelArray& pixels, py::ssize_t axes, std::size_t& count) {
    Shape leading;
    count = 1;
    for (py::ssize_t axis = 0; axis < pixels.array().ndim() - axes; ++axis) {
        leading.push_back(pixels.shape(axis));
        count *= static_cast<std::size_t>(pixels.shape(axis));
    }
    return leading;
}

Pixels equirect_to_faces(const ArrayLike& images, Argument<std::optional<int>> size,
                         const CenterName& center_name, const SamplingName& sampling_name,
                         const DTypeOrNone& dtype, const PixelsOrNone& out) {
    const Center center = parse_center(center_name);
    const Sampling sampling = parse_sampling(sampling_name);
    // The filter finds a NaN.
    const PixelArray from =
        pixel_array(images, "images", "(..., H, W, C)", Values::any, Channels::up_to_four);
    std::size_t count = 0;
    Shape shape = leading_axes(from, 3, count);
    const auto axes = static_cast<py::ssize_t>(shape.size());
    const int height = to_texels(from.shape(axes), "images");
    const int width = to_texels(from.shape(axes + 1), "images");
    const auto channels = static_cast<int>(from.shape(axes + 2));
    const int n = to_texels(size.value_or(default_face_size(width)), "size");
    const EquirectPixels pixels = {from.data(),  width,  height,   channels,
                                   from.dtype(), center, sampling, count};
    check_equirect(pixels, n);
    const DType to = result_type(dtype, out, from.dtype());
    shape.insert(shape.end(), {6, n, n, channels});
    const Target target =
        out.is_none() ? new_target(shape, to) : target_in(out, shape, to, from, "images");
    try {
        const Unlocked unlocked;
        equirect_to_cube(pixels, n, to, target.data);
    } catch (const FoundNan& found) {
        refuse_nan(from, "images", found.index);
    }
    return target.array;
}

Pixels faces_to_equirect(const ArrayLike& faces, Argument<std::optional<int>> width,
                         const CenterName& center_name, const SamplingName& sampling_name,
                         const DTypeOrNone& dtype, const PixelsOrNone& out) {
    const Center center = parse_center(center_name);
    const Sampling sampling = parse_sampling(sampling_name);
    const PixelArray from =
        pixel_array(faces, "faces", "(..., 6, N, N, C)", Values::any, Channels::up_to_four);
    std::size_t count = 0;
    Shape shape = leading_axes(from, 4, count);
    const auto axes = static_cast<py::ssize_t>(shape.size());
    const int n = to_texels(from.shape(axes + 1), "faces");
    const auto channels = static_cast<int>(from.shape(axes + 3));
    const int columns = to_texels(width.value_or(4 * n), "width");
    check_equirect_width(columns);
    const DType to = result_type(dtype, out, from.dtype());
    shape.insert(shape.end(), {columns / 2, columns, channels});
    const Target target =
        out.is_none() ? new_target(shape, to) : target_in(out, shape, to, from, "faces");
    {
        const Unlocked unlocked;
        cube_to_equirect({from.data(), n, channels, from.dtype(), count}, columns, center, sampling,
                         to, target.data);
    }
    return target.array;
}

}  // namespace

}  // namespace cubecam::bindings

void bind_equirect_arrays(pybind11::module_& module) {
    namespace py = pybind11;
    using namespace cubecam::bindings;
    module
        .def("equirect_to_faces", &equirect_to_faces, py::arg("images"), py::kw_only(),
             py::arg("size") = py::none(), py::arg("center") = "-z",
             py::arg("sampling") = "centers", py::arg("dtype") = py::none(),
             py::arg("out") = py::none(), docs::equirect_to_faces)
        .def("faces_to_equirect", &faces_to_equirect, py::arg("faces"), py::kw_only(),
             py::arg("width") = py::none(), py::arg("center") = "-z",
             py::arg("sampling") = "centers", py::arg("dtype") = py::none(),
             py::arg("out") = py::none(), docs::faces_to_equirect)
        .def(
            "_kept_taps", [] { return cubecam::kept_tap_bytes(); },
            "Bytes of the filter's taps that are kept, for tests.");
}
