// cubecam.Shadow
#include "shadow_like.hpp"
#include "vectors.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

namespace cubecam::bindings {

namespace {

constexpr const char* shadow_doc =
    R"doc(How a light's shadow is made: a depth map as the light sees it, and how that is looked up.

A value that does not change: give a light another one. All visible opaque nodes cast shadows whose
``cast_shadow`` is True, in or out of a picture's view, from either side of their surface. They
fall on every node with a `PhongMaterial` whose ``receive_shadow`` is True. A map is drawn again
only when what it sees changes.

A directional light's map covers all that casts, so a wide floor makes its texels wide: set the
floor's ``cast_shadow`` to False, or an ``extent``.

The edge of a shadow is about ``2 * radius + 1`` texels wide. A surface does not shadow itself, since
each texel is compared with the depth of the surface's own plane there, and no distance has to be
tuned for that.

Parameters
----------
size : int
    Texels a side of the map; a point light has six. From 8, and more for a larger radius, to
    ``info.limits.max_texture_size``.
radius : float
    Of the percentage-closer filter (Reeves, Salesin and Cook, 1987), texels, from 0 to 16: a box of
    ``2 * radius + 1`` texels. 0 is as hard as a map can be.
bias : float
    World units, not negative: what is nearer to a surface casts no shadow on it. It comes on top of
    a fraction of a texel.
near : float
    Point and spot lights: what is nearer to the light casts no shadow. World units, above 0.
far : float or None
    Point and spot lights: what is farther from the light casts no shadow. World units, above near;
    None: all that there is casts.
extent : float or None
    Directional lights: width and height of what the map covers (but for its outermost texels,
    which stay empty), world units, around the middle of the bounds of all that casts; beyond, all
    is lit. None: as much as all that casts.

Raises
------
ValueError
    For a number out of its range.

Examples
--------
>>> import cubecam as cc
>>> lamp = cc.PointLight(position=(0, 3, 0), shadow=cc.Shadow(size=512, radius=2))
>>> lamp.shadow
Shadow(size=512, radius=2, bias=0, near=0.05, far=None, extent=None)
>>> lamp.shadow == cc.Shadow(size=512, radius=2)
True
)doc";

std::string or_none_text(const std::optional<double>& value) {
    return value ? describe(*value) : "None";
}

py::tuple fields(const Shadow& shadow) {
    return py::make_tuple(shadow.size, shadow.radius, shadow.bias, shadow.near, shadow.far,
                          shadow.extent);
}

}  // namespace

}  // namespace cubecam::bindings

void bind_shadow(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    declare<Shadow>(module, "Shadow", shadow_doc)
        .def(py::init([](int size, double radius, double bias, double near,
                         std::optional<double> far, std::optional<double> extent) {
                 auto shadow =
                     std::make_shared<Shadow>(Shadow{size, radius, bias, near, far, extent});
                 check(*shadow);
                 return shadow;
             }),
             py::kw_only(), py::arg("size") = 1024, py::arg("radius") = 1.0, py::arg("bias") = 0.0,
             py::arg("near") = 0.05, py::arg("far") = py::none(), py::arg("extent") = py::none())
        .def_readonly("size", &Shadow::size, "int: texels a side of the map.")
        .def_readonly("radius", &Shadow::radius, "float: of the filter, texels.")
        .def_readonly("bias", &Shadow::bias, "float: world units.")
        .def_readonly("near", &Shadow::near, "float: nothing nearer casts; point and spot lights.")
        .def_readonly("far", &Shadow::far,
                      "float or None: nothing farther casts; point and spot lights.")
        .def_readonly("extent", &Shadow::extent,
                      "float or None: what the map covers, world units; directional lights.")
        .def(
            "__eq__",
            [](const Shadow& self, py::handle other) -> py::object {
                if (!py::isinstance<Shadow>(other)) {
                    return py::reinterpret_borrow<py::object>(Py_NotImplemented);
                }
                return py::bool_(self == other.cast<const Shadow&>());
            },
            py::arg("other"))
        .def("__hash__", [](const Shadow& self) { return py::hash(fields(self)); })
        .def("__repr__",
             [](const Shadow& self) {
                 return "Shadow(size=" + std::to_string(self.size) +
                        ", radius=" + describe(self.radius) + ", bias=" + describe(self.bias) +
                        ", near=" + describe(self.near) + ", far=" + or_none_text(self.far) +
                        ", extent=" + or_none_text(self.extent) + ")";
             })
        .def("__reduce__", [](const py::object& self) {
            return reduced(self,
                           attributes_of(self, "size", "radius", "bias", "near", "far", "extent"));
        });
}
