// cubecam.Image
#include "choice.hpp"
#include "docs/image.hpp"
#include "encodings.hpp"
#include "objects.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/image/image.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <array>
#include <optional>
#include <string>

namespace cubecam::bindings {

namespace {

using WrapWord = Choice<wrap_names>;
using WrapLike = OneOf<WrapWord, py::typing::Tuple<WrapWord, WrapWord>>;
using MagFilterWord = Choice<mag_filter_names>;
using MinFilterWord = Choice<min_filter_names>;

std::array<Wrap, 2> to_wrap(py::handle value) {
    if (py::isinstance<py::str>(value)) {
        const Wrap both = parse_wrap(value.cast<std::string>());
        return {both, both};
    }
    if (!py::isinstance<py::sequence>(value) || py::len(value) != 2) {
        refuse(value, "wrap", "a name or a pair of names, for u and v");
    }
    std::array<Wrap, 2> pair{};
    const auto names = py::reinterpret_borrow<py::sequence>(value);
    for (std::size_t i = 0; i < 2; ++i) {
        const py::object name = names[i];
        if (!py::isinstance<py::str>(name)) {
            refuse(name, "wrap", "a name or a pair of names, for u and v");
        }
        pair[i] = parse_wrap(name.cast<std::string>());
    }
    return pair;
}

/// One name if both axes are wrapped alike.
WrapLike from_wrap(const std::array<Wrap, 2>& wrap) {
    const py::str u{std::string(to_string(wrap[0]))};
    if (wrap[0] == wrap[1]) return u;
    return py::make_tuple(u, std::string(to_string(wrap[1])));
}

MinFilter to_min_filter(const std::optional<MinFilterWord>& name, bool mipmaps) {
    if (!name) return mipmaps ? MinFilter::linear_mipmap_linear : MinFilter::linear;
    Sampler made;
    made.min = parse_name("min_filter", *name, min_filter_names);
    expect(made.mipmaps() || !mipmaps, "a min_filter of mip levels with mipmaps=True",
           "'" + std::string(*name) + "'");
    return made.min;
}

std::shared_ptr<Image> make_image(const ArrayLike& pixels, Flag mipmaps, const WrapLike& wrap,
                                  const EncodingName& encoding, const MagFilterWord& mag_filter,
                                  const std::optional<MinFilterWord>& min_filter) {
    const Sampler sampler{to_wrap(wrap), parse_name("mag_filter", mag_filter, mag_filter_names),
                          to_min_filter(min_filter, mipmaps)};
    const PixelArray array = pixel_array(pixels, "pixels", "(H, W, C)");
    auto kept = std::make_shared<const PixelBuffer>(array.data(), array.data() + array.bytes());
    return std::make_shared<Image>(std::move(kept), static_cast<int>(array.shape(1)),
                                   static_cast<int>(array.shape(0)),
                                   static_cast<int>(array.shape(2)), array.dtype(), sampler,
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
             py::arg("wrap") = "repeat", py::arg("encoding") = py::none(),
             py::arg("mag_filter") = "linear", py::arg("min_filter") = py::none())
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
        .def_property_readonly(
            "mipmaps", [](const Image& image) { return image.sampler().mipmaps(); },
            "bool: whether lookups use mip levels.")
        .def_property_readonly(
            "wrap", [](const Image& image) { return from_wrap(image.sampler().wrap); },
            "str, or a pair for u and v: \"repeat\", \"clamp\" or \"mirror\".")
        .def_property_readonly(
            "mag_filter",
            [](const Image& image) -> MagFilterWord { return to_string(image.sampler().mag); },
            "str: \"linear\" or \"nearest\", for texels larger than a pixel.")
        .def_property_readonly(
            "min_filter",
            [](const Image& image) -> MinFilterWord { return to_string(image.sampler().min); },
            "str: for texels smaller than a pixel; with mip levels \"linear_mipmap_linear\" or the "
            "like.")
        .def_property_readonly(
            "encoding",
            [](const Image& image) -> EncodingNow { return to_string(image.encoding()); },
            "str: \"linear\" or \"srgb\", what the numbers are.")
        .def("__repr__", &represent)
        .def("__reduce__",
             [](const py::object& self) {
                 return reduced(self, attributes_of(self, "pixels", "mipmaps", "wrap", "encoding",
                                                    "mag_filter", "min_filter"));
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
