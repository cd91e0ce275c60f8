// cubecam.PlanarMirror
#include "docs/planar_mirror.hpp"
#include "objects.hpp"
#include "values.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/scene/planar_mirror.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace cubecam::bindings {

namespace {

template <class Value>
void field(Class<PlanarMirror>& mirror, const char* name, Value PlanarMirrorValue::* member,
           const char* doc) {
    mirror.def_property(
        name, [member](const PlanarMirror& self) { return self.value().*member; },
        [member](PlanarMirror& self, Strict<Value> value) {
            self.edit([&](PlanarMirrorValue& next) { next.*member = *value; });
        },
        doc);
}

}  // namespace

}  // namespace cubecam::bindings

void bind_planar_mirror(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    static_cast<void>(module);
    auto mirror = declared<PlanarMirror>();
    mirror.attr("__doc__") = docs::planar_mirror;
    mirror.def(py::init([](Int bounces, Real distance) {
                   return std::make_shared<PlanarMirror>(PlanarMirrorValue{bounces, distance});
               }),
               py::kw_only(), py::arg("bounces") = 1, py::arg("distance") = 1.0);
    field(mirror, "bounces", &PlanarMirrorValue::bounces,
          "int: how many planar mirrors a path may meet, this one as the last of them.");
    field(mirror, "distance", &PlanarMirrorValue::distance,
          "float: how far from the surface bent and rough rays are taken to end, world units.");
    mirror.def("__repr__", [](const PlanarMirror& self) {
        const PlanarMirrorValue value = self.value();
        return "PlanarMirror(bounces=" + std::to_string(value.bounces) +
               ", distance=" + describe(value.distance) + ")";
    });
    mirror.def("__reduce__", [](const py::object& self) {
        return reduced(self, attributes_of(self, "bounces", "distance"));
    });
}
