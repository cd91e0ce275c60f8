// cubecam.Light and the lights below it.
#include "objects.hpp"
#include "vectors.hpp"

#include "cubecam/scene/light.hpp"

#include <pybind11/pybind11.h>

#include <string>

namespace cubecam::bindings {

namespace {

constexpr const char* light_doc = R"doc(Base of the lights.

A light may be in several scenes; a change shows in all of them.
)doc";

constexpr const char* point_doc = R"doc(Light from one point, the same in all directions.

Parameters
----------
position : array_like (3,)
    World space.
color : array_like (3,)
    Linear RGB, not negative.
intensity : float
    Times color, not negative.
decay : float
    The light falls with distance**-decay: 0 not at all, 2 as physics has it. Not negative.

Raises
------
ValueError
    For a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> lamp = cc.PointLight(position=(3, 4, 3))
>>> lamp.intensity = 2
>>> lamp
PointLight(position=(3, 4, 3), color=(1, 1, 1), intensity=2, decay=0)
)doc";

constexpr const char* directional_doc = R"doc(Light from far away, such as the sun's.

Parameters
----------
direction : array_like (3,)
    The way the light travels, in world space, of any length but 0; kept normalised. Straight down
    by default.
color : array_like (3,)
    Linear RGB, not negative.
intensity : float
    Times color, not negative.

Raises
------
ValueError
    For a direction of no length, or a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> cc.DirectionalLight(direction=(0, 0, -2)).direction.tolist()
[0.0, 0.0, -1.0]
)doc";

constexpr const char* ambient_doc = R"doc(Light that comes from everywhere alike.

Parameters
----------
color : array_like (3,)
    Linear RGB, not negative.
intensity : float
    Times color, not negative.

Raises
------
ValueError
    For a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> cc.AmbientLight(intensity=.5)
AmbientLight(color=(1, 1, 1), intensity=0.5)
)doc";

std::string light_text(const LightValue& value) {
    return "color=" + tuple_text(value.color) + ", intensity=" + describe(value.intensity) + ")";
}

void bind_point(py::module_& module) {
    declare<PointLight, Light>(module, "PointLight", point_doc)
        .def(py::init([](const ArrayLike& position, const ArrayLike& color, float intensity,
                         double decay) {
                 return std::make_shared<PointLight>(
                     PointParameters{to_point(position, "position"), decay}, to_rgb(color, "color"),
                     intensity);
             }),
             py::arg("position") = py::make_tuple(0, 0, 0),
             py::arg("color") = py::make_tuple(1, 1, 1), py::arg("intensity") = 1.0,
             py::arg("decay") = 0.0)
        .def_property(
            "position",
            [](const PointLight& self) { return point_array(self.parameters().position); },
            [](PointLight& self, const ArrayLike& value) {
                const glm::dvec3 position = to_point(value, "position");
                self.edit_parameters([&](PointParameters& p) { p.position = position; });
            },
            "ndarray (3,) float64: world space, read-only.")
        .def_property(
            "decay", [](const PointLight& self) { return self.parameters().decay; },
            [](PointLight& self, double value) {
                self.edit_parameters([&](PointParameters& p) { p.decay = value; });
            },
            "float: the light falls with distance**-decay.")
        .def("__repr__",
             [](const PointLight& self) {
                 const auto p = self.parameters();
                 std::string text = light_text(self.value());
                 text.pop_back();
                 return "PointLight(position=" + tuple_text(p.position) + ", " + text +
                        ", decay=" + describe(p.decay) + ")";
             })
        .def("__reduce__", [](const py::object& self) {
            return reduced(self, py::make_tuple(self.attr("position"), self.attr("color"),
                                                self.attr("intensity"), self.attr("decay")));
        });
}

void bind_directional(py::module_& module) {
    declare<DirectionalLight, Light>(module, "DirectionalLight", directional_doc)
        .def(py::init([](const ArrayLike& direction, const ArrayLike& color, float intensity) {
                 return std::make_shared<DirectionalLight>(
                     DirectionalParameters{to_point(direction, "direction")},
                     to_rgb(color, "color"), intensity);
             }),
             py::arg("direction") = py::make_tuple(0, -1, 0),
             py::arg("color") = py::make_tuple(1, 1, 1), py::arg("intensity") = 1.0)
        .def_property(
            "direction",
            [](const DirectionalLight& self) { return point_array(self.parameters().direction); },
            [](DirectionalLight& self, const ArrayLike& value) {
                const glm::dvec3 direction = to_point(value, "direction");
                self.edit_parameters([&](DirectionalParameters& p) { p.direction = direction; });
            },
            "ndarray (3,) float64: the way the light travels, unit length, read-only.")
        .def("__repr__",
             [](const DirectionalLight& self) {
                 return "DirectionalLight(direction=" + tuple_text(self.parameters().direction) +
                        ", " + light_text(self.value());
             })
        .def("__reduce__", [](const py::object& self) {
            return reduced(self, py::make_tuple(self.attr("direction"), self.attr("color"),
                                                self.attr("intensity")));
        });
}

void bind_ambient(py::module_& module) {
    declare<AmbientLight, Light>(module, "AmbientLight", ambient_doc)
        .def(py::init([](const ArrayLike& color, float intensity) {
                 return std::make_shared<AmbientLight>(AmbientParameters{}, to_rgb(color, "color"),
                                                       intensity);
             }),
             py::arg("color") = py::make_tuple(1, 1, 1), py::arg("intensity") = 1.0)
        .def("__repr__",
             [](const AmbientLight& self) { return "AmbientLight(" + light_text(self.value()); })
        .def("__reduce__", [](const py::object& self) {
            return reduced(self, py::make_tuple(self.attr("color"), self.attr("intensity")));
        });
}

}  // namespace

}  // namespace cubecam::bindings

void bind_light(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;

    declare<Light>(module, "Light", light_doc)
        .def_property(
            "color", [](const Light& self) { return color_array(self.value().color); },
            [](Light& self, const ArrayLike& value) {
                const glm::vec3 color = to_rgb(value, "color");
                self.edit([&](LightValue& next) { next.color = color; });
            },
            "ndarray (3,) float32: linear RGB, read-only.")
        .def_property(
            "intensity", [](const Light& self) { return shortest(self.value().intensity); },
            [](Light& self, float value) {
                self.edit([&](LightValue& next) { next.intensity = value; });
            },
            "float: times color.");
    bind_point(module);
    bind_directional(module);
    bind_ambient(module);
}
