// cubecam.Light and the lights below it.
#include "docs/light.hpp"
#include "objects.hpp"
#include "parent.hpp"
#include "shadow_like.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/scene/light.hpp"
#include "cubecam/scene/node.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

namespace cubecam::bindings {

namespace {

std::string light_text(const LightValue& value) {
    return "color=" + tuple_text(value.color) + ", intensity=" + describe(value.intensity);
}

std::string range_text(double range) {
    return range == no_range ? std::string() : ", range=" + describe(range);
}

/// The end of a light's text: its shadow and its parent, if it has them, and the bracket.
std::string last_text(const LightValue& value) {
    std::string text;
    if (value.shadow) {
        text = ", shadow=" + py::repr(from_shadow(value.shadow)).cast<std::string>();
    }
    return text + parent_text(value.parent) + ")";
}

template <class Kind>
std::shared_ptr<Kind> with_parent(std::shared_ptr<Kind> light, const OrNone<Node>& parent) {
    const auto node = to_parent(parent);
    if (node) light->edit([&](LightValue& next) { next.parent = node; });
    return light;
}

template <class Bound>
void bind_shadow_of(Bound& light) {
    light.def_property(
        "shadow", [](const Light& self) { return from_shadow(self.value().shadow); },
        [](Light& self, const ShadowLike& value) {
            const std::optional<Shadow> shadow = to_shadow(value);
            self.edit([&](LightValue& next) { next.shadow = shadow; });
        },
        "Shadow or None: None casts no shadows; True sets ``Shadow()``.");
}

template <class Bound>
void bind_parent_of(Bound& light) {
    light.def_property(
        "parent", [](const Light& self) { return or_none(self.value().parent.lock()); },
        [](Light& self, const OrNone<Node>& value) {
            const auto parent = to_parent(value);
            self.edit([&](LightValue& next) { next.parent = parent; });
        },
        "Node or None: the node that the light moves with. Position and direction stay, and are in "
        "the node's coordinates.");
}

template <class Parameters>
void bind_world_vector(Class<LightOf<Parameters>, Light>& light, const char* name,
                       glm::dvec3 Parameters::* member, const char* doc) {
    light.def_property_readonly(
        name,
        [member](const LightOf<Parameters>& self) {
            return point_array(std::get<Parameters>(self.world_parameters()).*member);
        },
        doc);
}

template <class Parameters, class Field>
void bind_number(Class<LightOf<Parameters>, Light>& light, const char* name,
                 Field Parameters::* member, const char* doc) {
    light.def_property(
        name, [member](const LightOf<Parameters>& self) { return self.parameters().*member; },
        [member](LightOf<Parameters>& self, Argument<Field> value) {
            self.edit_parameters([&](Parameters& p) { p.*member = value; });
        },
        doc);
}

template <class Parameters>
void bind_vector(Class<LightOf<Parameters>, Light>& light, const char* name,
                 glm::dvec3 Parameters::* member, const char* doc) {
    light.def_property(
        name,
        [member](const LightOf<Parameters>& self) {
            return point_array(self.parameters().*member);
        },
        [member, name](LightOf<Parameters>& self, const ArrayLike& value) {
            const glm::dvec3 vector = to_point(value, name);
            self.edit_parameters([&](Parameters& p) { p.*member = vector; });
        },
        doc);
}

constexpr const char* position_text =
    "ndarray (3,) float64: world space, or the parent's coordinates; read-only.";
constexpr const char* direction_text =
    "ndarray (3,) float64: the way the light travels, in world space or the parent's coordinates; "
    "unit length, read-only.";
constexpr const char* world_position_text =
    "ndarray (3,) float64: the position in world space, read-only.";
constexpr const char* world_direction_text =
    "ndarray (3,) float64: the way the light travels in world space, unit length, read-only.";
constexpr const char* decay_text = "float: the light falls with distance**-decay.";
constexpr const char* range_doc =
    "float: the distance at which the light ends, world units; infinity for none.";

void bind_point(py::module_& module) {
    auto light = declare<PointLight, Light>(module, "PointLight", docs::point);
    light.def(
        py::init([](const ArrayLike& position, const ColorLike& color, Strict<float> intensity,
                    Real decay, Real range, const ShadowLike& shadow, const OrNone<Node>& parent) {
            return with_parent(std::make_shared<PointLight>(
                                   PointParameters{to_point(position, "position"), decay, range},
                                   to_rgb(color, "color"), intensity, to_shadow(shadow)),
                               parent);
        }),
        py::arg("position") = py::make_tuple(0, 0, 0), py::kw_only(),
        py::arg("color") = py::make_tuple(1, 1, 1), py::arg("intensity") = 1.0,
        py::arg("decay") = 0.0, py::arg("range") = no_range, py::arg("shadow") = py::none(),
        py::arg("parent") = py::none());
    bind_vector(light, "position", &PointParameters::position, position_text);
    bind_world_vector(light, "world_position", &PointParameters::position, world_position_text);
    bind_number(light, "decay", &PointParameters::decay, decay_text);
    bind_number(light, "range", &PointParameters::range, range_doc);
    bind_shadow_of(light);
    bind_parent_of(light);
    light.def("__repr__", [](const PointLight& self) {
        const LightValue value = self.value();
        const auto& p = std::get<PointParameters>(value.parameters);
        return "PointLight(position=" + tuple_text(p.position) + ", " + light_text(value) +
               ", decay=" + describe(p.decay) + range_text(p.range) + last_text(value);
    });
    light.def("__reduce__", [](const py::object& self) {
        return reduced_with_parent(self, attributes_of(self, "position", "color", "intensity",
                                                       "decay", "range", "shadow"));
    });
}

void bind_spot(py::module_& module) {
    auto light = declare<SpotLight, Light>(module, "SpotLight", docs::spot);
    light.def(
        py::init([](const ArrayLike& position, const ArrayLike& direction, Real angle,
                    Real penumbra, const ColorLike& color, Strict<float> intensity, Real decay,
                    Real range, const ShadowLike& shadow, const OrNone<Node>& parent) {
            return with_parent(
                std::make_shared<SpotLight>(SpotParameters{to_point(position, "position"),
                                                           to_point(direction, "direction"), angle,
                                                           penumbra, decay, range},
                                            to_rgb(color, "color"), intensity, to_shadow(shadow)),
                parent);
        }),
        py::arg("position") = py::make_tuple(0, 0, 0),
        py::arg("direction") = py::make_tuple(0, -1, 0), py::kw_only(), py::arg("angle") = 30.0,
        py::arg("penumbra") = 0.0, py::arg("color") = py::make_tuple(1, 1, 1),
        py::arg("intensity") = 1.0, py::arg("decay") = 0.0, py::arg("range") = no_range,
        py::arg("shadow") = py::none(), py::arg("parent") = py::none());
    bind_vector(light, "position", &SpotParameters::position, position_text);
    bind_vector(light, "direction", &SpotParameters::direction, direction_text);
    bind_world_vector(light, "world_position", &SpotParameters::position, world_position_text);
    bind_world_vector(light, "world_direction", &SpotParameters::direction, world_direction_text);
    bind_number(light, "angle", &SpotParameters::angle,
                "float: angle from the axis to the cone's edge, above 0 and below 90 degrees.");
    bind_number(light, "penumbra", &SpotParameters::penumbra,
                "float: share of the angle over which the light fades, from 0 to 1.");
    bind_number(light, "decay", &SpotParameters::decay, decay_text);
    bind_number(light, "range", &SpotParameters::range, range_doc);
    bind_shadow_of(light);
    bind_parent_of(light);
    light.def("__repr__", [](const SpotLight& self) {
        const LightValue value = self.value();
        const auto& p = std::get<SpotParameters>(value.parameters);
        return "SpotLight(position=" + tuple_text(p.position) +
               ", direction=" + tuple_text(p.direction) + ", angle=" + describe(p.angle) +
               ", penumbra=" + describe(p.penumbra) + ", " + light_text(value) +
               ", decay=" + describe(p.decay) + range_text(p.range) + last_text(value);
    });
    light.def("__reduce__", [](const py::object& self) {
        return reduced_with_parent(self,
                                   attributes_of(self, "position", "direction", "angle", "penumbra",
                                                 "color", "intensity", "decay", "range", "shadow"));
    });
}

void bind_directional(py::module_& module) {
    auto light = declare<DirectionalLight, Light>(module, "DirectionalLight", docs::directional);
    light.def(
        py::init([](const ArrayLike& direction, const ColorLike& color, Strict<float> intensity,
                    const ShadowLike& shadow, const OrNone<Node>& parent) {
            return with_parent(std::make_shared<DirectionalLight>(
                                   DirectionalParameters{to_point(direction, "direction")},
                                   to_rgb(color, "color"), intensity, to_shadow(shadow)),
                               parent);
        }),
        py::arg("direction") = py::make_tuple(0, -1, 0), py::kw_only(),
        py::arg("color") = py::make_tuple(1, 1, 1), py::arg("intensity") = 1.0,
        py::arg("shadow") = py::none(), py::arg("parent") = py::none());
    bind_vector(light, "direction", &DirectionalParameters::direction, direction_text);
    bind_world_vector(light, "world_direction", &DirectionalParameters::direction,
                      world_direction_text);
    bind_shadow_of(light);
    bind_parent_of(light);
    light.def("__repr__", [](const DirectionalLight& self) {
        const LightValue value = self.value();
        const auto& p = std::get<DirectionalParameters>(value.parameters);
        return "DirectionalLight(direction=" + tuple_text(p.direction) + ", " + light_text(value) +
               last_text(value);
    });
    light.def("__reduce__", [](const py::object& self) {
        return reduced_with_parent(
            self, attributes_of(self, "direction", "color", "intensity", "shadow"));
    });
}

void bind_ambient(py::module_& module) {
    declare<AmbientLight, Light>(module, "AmbientLight", docs::ambient)
        .def(py::init([](const ColorLike& color, Strict<float> intensity) {
                 return std::make_shared<AmbientLight>(AmbientParameters{}, to_rgb(color, "color"),
                                                       intensity);
             }),
             py::kw_only(), py::arg("color") = py::make_tuple(1, 1, 1), py::arg("intensity") = 1.0)
        .def("__repr__",
             [](const AmbientLight& self) {
                 return "AmbientLight(" + light_text(self.value()) + ")";
             })
        .def("__reduce__", [](const py::object& self) {
            return reduced(self, attributes_of(self, "color", "intensity"));
        });
}

}  // namespace

}  // namespace cubecam::bindings

void bind_light(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;

    auto light = declare<Light>(module, "Light", docs::light);
    def_setstate(light, "tuple", &set_parent_state);
    light
        .def_property(
            "color", [](const Light& self) { return color_array(self.value().color); },
            [](Light& self, const ArrayLike& value) {
                const glm::vec3 color = to_rgb(value, "color");
                self.edit([&](LightValue& next) { next.color = color; });
            },
            "ndarray (3,) float32: linear RGB, read-only.")
        .def_property(
            "intensity", [](const Light& self) { return shortest(self.value().intensity); },
            [](Light& self, Strict<float> value) {
                self.edit([&](LightValue& next) { next.intensity = value; });
            },
            "float: a factor of color.");
    bind_point(module);
    bind_spot(module);
    bind_directional(module);
    bind_ambient(module);
}
