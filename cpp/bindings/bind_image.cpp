// cubecam.Image
#include "objects.hpp"
#include "vectors.hpp"

#include "cubecam/image/image.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

namespace cubecam::bindings {

namespace {

constexpr const char* image_doc = R"doc(A picture that a material shows. It never changes.

Numbers are taken as they are: linear and raw (uint8 as value/255). Decode an 8-bit photograph with
``load_image(path, srgb=True)`` first.

Parameters
----------
pixels : array_like (H, W, C)
    1 (grey), 3 (RGB) or 4 (RGBA) channels, row 0 on top. uint8, float16 or float32 is kept, float64
    becomes float32. uv (0, 0) is the bottom-left corner.
mipmaps : bool
    Whether lookups are trilinear, for pictures that are seen small. False: bilinear.
wrap : {"repeat", "clamp"}
    What a lookup outside 0..1 gives.

Raises
------
TypeError
    For pixels of another type.
ValueError
    For another shape, an image without pixels, NaN, or another `wrap`.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> checks = np.indices((8, 8)).sum(axis=0)[..., None] % 2 * np.uint8(255)
>>> image = cc.Image(checks.astype(np.uint8), wrap="clamp")
>>> image.size, image.channels, image.dtype
((8, 8), 1, dtype('uint8'))
)doc";

std::shared_ptr<Image> make_image(const ArrayLike& pixels, bool mipmaps, const std::string& wrap) {
    const Wrap mode = parse_wrap(wrap);
    const PixelArray array = pixel_array(pixels, "pixels", "(H, W, C)");
    auto kept = std::make_shared<const PixelBuffer>(array.data(), array.data() + array.bytes());
    return std::make_shared<Image>(std::move(kept), static_cast<int>(array.shape(1)),
                                   static_cast<int>(array.shape(0)),
                                   static_cast<int>(array.shape(2)), array.dtype(), mipmaps, mode);
}

py::array image_pixels(const Image& image) {
    return readonly_view(numpy_dtype(image.dtype()),
                         {image.height(), image.width(), image.channels()}, image.pixels()->data(),
                         image.pixels());
}

std::string represent_image(const Image& image) {
    return "Image(" + std::to_string(image.width()) + " x " + std::to_string(image.height()) +
           ", " + std::to_string(image.channels()) + " channels, " + dtype_name(image.dtype()) +
           ")";
}

}  // namespace

}  // namespace cubecam::bindings

void bind_image(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    declare<Image>(module, "Image", image_doc)
        .def(py::init(&make_image), py::arg("pixels"), py::kw_only(), py::arg("mipmaps") = false,
             py::arg("wrap") = "repeat")
        .def_property_readonly("pixels", &image_pixels,
                               "ndarray (H, W, C): a read-only view, row 0 on top.")
        .def_property_readonly(
            "size",
            [](const Image& image) { return py::make_tuple(image.width(), image.height()); },
            "tuple of int: (width, height).")
        .def_property_readonly("channels", &Image::channels, "int: 1, 3 or 4.")
        .def_property_readonly(
            "dtype", [](const Image& image) { return numpy_dtype(image.dtype()); },
            "numpy.dtype: uint8, float16 or float32.")
        .def_property_readonly("mipmaps", &Image::mipmaps, "bool: whether lookups are trilinear.")
        .def_property_readonly(
            "wrap", [](const Image& image) { return std::string(to_string(image.wrap())); },
            "str: \"repeat\" or \"clamp\".")
        .def("__repr__", &represent_image)
        .def("__reduce__",
             [](const py::object& self) {
                 return reduced(self, attributes_of(self, "pixels", "mipmaps", "wrap"));
             })
        // What never changes need not be copied.
        .def("__copy__", [](const py::object& self) { return self; })
        .def(
            "__deepcopy__", [](const py::object& self, const py::dict&) { return self; },
            py::arg("memo"));
}
