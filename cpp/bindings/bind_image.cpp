// cubecam.Image
#include "choice.hpp"
#include "docs/image.hpp"
#include "encodings.hpp"
#include "objects.hpp"
#include "vectors.hpp"

#include "cubecam/image/image.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

namespace cubecam::bindings {

namespace {

using WrapWord = Choice<wrap_names>;

std::shared_ptr<Image> make_image(const ArrayLike& pixels, bool mipmaps, const WrapWord& wrap,
                                  const EncodingName& encoding) {
    const Wrap mode = parse_wrap(wrap);
    const PixelArray array = pixel_array(pixels, "pixels", "(H, W, C)");
    auto kept = std::make_shared<const PixelBuffer>(array.data(), array.data() + array.bytes());
    return std::make_shared<Image>(std::move(kept), static_cast<int>(array.shape(1)),
                                   static_cast<int>(array.shape(0)),
                                   static_cast<int>(array.shape(2)), array.dtype(), mipmaps, mode,
                                   to_encoding(encoding, pixels, array.dtype()));
}

Pixels pixels_of(const Image& image) {
    return readonly_view(numpy_dtype(image.dtype()),
                         {image.height(), image.width(), image.channels()}, image.pixels()->data(),
                         image.pixels());
}

std::string represent(const Image& image) {
    return "Image(" + std::to_string(image.width()) + " x " + std::to_string(image.height()) +
           ", " + std::to_string(image.channels()) + " channels, " + dtype_name(image.dtype()) +
           ", " + std::string(to_string(image.encoding())) + ")";
}

}  // namespace

}  // namespace cubecam::bindings

void bind_image(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    declare<Image>(module, "Image", docs::image)
        .def(py::init(&make_image), py::arg("pixels"), py::kw_only(), py::arg("mipmaps") = false,
             py::arg("wrap") = "repeat", py::arg("encoding") = py::none())
        .def_property_readonly("pixels", &pixels_of,
                               "ndarray (H, W, C): a read-only view, row 0 on top.")
        .def_property_readonly(
            "size",
            [](const Image& image) -> Size {
                return py::make_tuple(image.width(), image.height());
            },
            "tuple of int: (width, height).")
        .def_property_readonly("channels", &Image::channels, "int: 1, 3 or 4.")
        .def_property_readonly(
            "dtype", [](const Image& image) -> PixelDType { return numpy_dtype(image.dtype()); },
            "numpy.dtype: uint8, float16 or float32.")
        .def_property_readonly("mipmaps", &Image::mipmaps, "bool: whether lookups are trilinear.")
        .def_property_readonly(
            "wrap", [](const Image& image) -> WrapWord { return to_string(image.wrap()); },
            "str: \"repeat\" or \"clamp\".")
        .def_property_readonly(
            "encoding",
            [](const Image& image) -> EncodingNow { return to_string(image.encoding()); },
            "str: \"linear\" or \"srgb\", what the numbers are.")
        .def("__repr__", &represent)
        .def("__reduce__",
             [](const py::object& self) {
                 return reduced(self, attributes_of(self, "pixels", "mipmaps", "wrap", "encoding"));
             })
        // An image never changes, so a copy is the image itself.
        .def("__copy__", [](const std::shared_ptr<Image>& self) { return self; })
        .def(
            "__deepcopy__",
            [](const std::shared_ptr<Image>& self, const py::typing::Dict<py::int_, py::object>&) {
                return self;
            },
            py::arg("memo"));
}
