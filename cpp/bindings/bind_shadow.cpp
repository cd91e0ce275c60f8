// cubecam.Shadow
#include "docs/shadow.hpp"
#include "shadow_like.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>

namespace cubecam::bindings {

namespace {

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

    declare<Shadow>(module, "Shadow", docs::shadow)
        .def(py::init([](Int size, Real radius, Real bias, Real near,
                         Argument<std::optional<double>> far,
                         Argument<std::optional<double>> extent) {
                 auto shadow =
                     std::make_shared<Shadow>(Shadow{size, radius, bias, near, far, extent});
                 check(*shadow);
                 return shadow;
             }),
             py::kw_only(), py::arg("size") = 1024, py::arg("radius") = 1.0, py::arg("bias") = 0.0,
             py::arg("near") = 0.05, py::arg("far") = py::none(), py::arg("extent") = py::none())
        .def_readonly("size", &Shadow::size, "int: texels along a side of the map.")
        .def_readonly("radius", &Shadow::radius, "float: radius of the filter, texels.")
        .def_readonly("bias", &Shadow::bias,
                      "float: the distance within which nothing casts, world units.")
        .def_readonly("near", &Shadow::near,
                      "float: casters nearer to the light cast no shadow; point and spot lights.")
        .def_readonly(
            "far", &Shadow::far,
            "float or None: casters farther from the light cast no shadow; point and spot lights.")
        .def_readonly(
            "extent", &Shadow::extent,
            "float or None: side of the area that the map covers, world units; directional lights.")
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
