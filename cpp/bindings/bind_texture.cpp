// cubecam.Texture
#include "docs/texture.hpp"
#include "map_source.hpp"
#include "numbers.hpp"
#include "objects.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/materials/placed_map.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace cubecam::bindings {

namespace {

using Source = OneOf<Image, RenderTexture, ArrayLike>;
using SourceNow = OneOf<Image, RenderTexture>;
using Pair = py::typing::Tuple<double, double>;

glm::vec2 to_pair(py::handle value, const char* name) {
    const auto array = double_array(value, name, "(2,)");
    return glm::dvec2(array.data()[0], array.data()[1]);
}

Pair from_pair(const glm::vec2& pair) { return py::make_tuple(shortest(pair.x), shortest(pair.y)); }

std::shared_ptr<PlacedMap> make_texture(const Source& source, const WholeNumber& uv_set,
                                        const ArrayLike& offset, Real rotation,
                                        const ArrayLike& scale) {
    if (source.is_none())
        refuse(source, "source", "an Image, an array (H, W, C) or a RenderTexture");
    PlacedMap made{to_map_source(source, "source"), {}};
    made.placing.uv_set = static_cast<int>(to_int(uv_set, "uv_set", 0, 1));
    made.placing.offset = to_pair(offset, "offset");
    made.placing.rotation = static_cast<float>(rotation);
    made.placing.scale = to_pair(scale, "scale");
    check(made.placing);
    return std::make_shared<PlacedMap>(std::move(made));
}

/// The constructor call with the arguments that differ from the defaults.
std::string represent(const PlacedMap& map) {
    const MapPlacing fresh;
    const MapPlacing& mine = map.placing;
    const auto pair = [](const glm::vec2& value) {
        return "(" + describe(value.x) + ", " + describe(value.y) + ")";
    };
    std::string text = "Texture(" + py::repr(from_map_source(map.source)).cast<std::string>();
    if (mine.uv_set != fresh.uv_set) text += ", uv_set=" + std::to_string(mine.uv_set);
    if (mine.offset != fresh.offset) text += ", offset=" + pair(mine.offset);
    if (mine.rotation != fresh.rotation) text += ", rotation=" + describe(mine.rotation);
    if (mine.scale != fresh.scale) text += ", scale=" + pair(mine.scale);
    return text + ")";
}

py::tuple contents(const PlacedMap& map) {
    const MapPlacing& place = map.placing;
    return py::make_tuple(from_map_source(map.source), place.uv_set, from_pair(place.offset),
                          shortest(place.rotation), from_pair(place.scale));
}

}  // namespace

}  // namespace cubecam::bindings

void bind_texture(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    declare<PlacedMap>(module, "Texture", docs::texture)
        .def(py::init(&make_texture), py::arg("source"), py::kw_only(), py::arg("uv_set") = 0,
             py::arg("offset") = py::make_tuple(0, 0), py::arg("rotation") = 0.0,
             py::arg("scale") = py::make_tuple(1, 1))
        .def_property_readonly(
            "source",
            [](const PlacedMap& self) -> SourceNow { return from_map_source(self.source); },
            "Image or RenderTexture: the picture.")
        .def_property_readonly(
            "uv_set", [](const PlacedMap& self) { return self.placing.uv_set; },
            "int: 0 for the mesh's uvs, 1 for its uvs1.")
        .def_property_readonly(
            "offset", [](const PlacedMap& self) { return from_pair(self.placing.offset); },
            "tuple of float: what is added to (u, v) last.")
        .def_property_readonly(
            "rotation", [](const PlacedMap& self) { return shortest(self.placing.rotation); },
            "float: the angle by which (u, v) is turned, degrees, counter-clockwise.")
        .def_property_readonly(
            "scale", [](const PlacedMap& self) { return from_pair(self.placing.scale); },
            "tuple of float: the factors of u and v.")
        .def_property_readonly(
            "matrix",
            [](const PlacedMap& self) {
                const glm::mat3x2 columns = matrix(self.placing);
                py::array_t<double> array({2, 3});
                for (int row = 0; row < 2; ++row) {
                    for (int column = 0; column < 3; ++column) {
                        *array.mutable_data(row, column) = columns[column][row];
                    }
                }
                array.attr("flags").attr("writeable") = false;
                return array;
            },
            "ndarray (2, 3): the picture is looked up at ``matrix @ (u, v, 1)``.")
        .def(
            "__eq__", [](const PlacedMap& a, const PlacedMap& b) { return a == b; },
            py::is_operator(), py::arg("other"))
        .def("__hash__", [](const PlacedMap& self) { return py::hash(contents(self)); })
        .def("__repr__", &represent)
        .def("__reduce__", [](const py::object& self) {
            return reduced(self,
                           attributes_of(self, "source", "uv_set", "offset", "rotation", "scale"));
        });
}
