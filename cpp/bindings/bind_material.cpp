// cubecam.Material and the materials below it.
#include "bind_material_docs.hpp"
#include "cube_source.hpp"
#include "map_source.hpp"
#include "objects.hpp"
#include "surface_options.hpp"
#include "vectors.hpp"

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/materials/material.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/render_texture.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>

namespace cubecam::bindings {

namespace {

/// Properties of one kind of material; `P` is its parameters, `M` its class.
template <class P, class M = MaterialOf<P>>
struct Properties {
    Class<M, Material>& made;

    void color(const char* name, glm::vec4 P::* field, const char* doc) {
        made.def_property(
            name, [field](const M& self) { return color_array(self.parameters().*field); },
            [field, name](M& self, const ArrayLike& value) {
                const glm::vec4 color = to_rgba(value, name);
                self.edit_parameters([&](P& p) { p.*field = color; });
            },
            doc);
    }

    void number(const char* name, float P::* field, const char* doc) {
        made.def_property(
            name, [field](const M& self) { return shortest(self.parameters().*field); },
            [field](M& self, float value) {
                self.edit_parameters([&](P& p) { p.*field = value; });
            },
            doc);
    }

    void flag(const char* name, bool P::* field, const char* doc) {
        made.def_property(
            name, [field](const M& self) { return self.parameters().*field; },
            [field](M& self, bool value) { self.edit_parameters([&](P& p) { p.*field = value; }); },
            doc);
    }

    void map(const char* doc) {
        made.def_property(
            "map", [](const M& self) { return from_map_source(self.parameters().map); },
            [](M& self, const MapLike& value) {
                const MapSource map = to_map_source(value, "map");
                self.edit_parameters([&](P& p) { p.map = map; });
            },
            doc);
    }
};

BasicParameters basic_parameters(const ArrayLike& color, const MapLike& map,
                                 const CubeLike& cubemap, bool vertex_colors) {
    return {to_rgba(color, "color"), to_map_source(map, "map"), to_cube_source(cubemap, "cubemap"),
            vertex_colors};
}

void bind_basic(py::module_& module) {
    using M = BasicMaterial;
    auto made = declare<M, Material>(module, "BasicMaterial", basic_doc);
    def_init(made, &basic_parameters, py::arg("color") = py::make_tuple(1, 1, 1),
             py::arg("map") = py::none(), py::arg("cubemap") = py::none(),
             py::arg("vertex_colors") = false);
    Properties<BasicParameters> properties{made};
    properties.color("color", &BasicParameters::color, color_property_doc);
    properties.map(map_property_doc);
    made.def_property(
        "cubemap",
        [](const M& self) -> CubeLike { return from_cube_source(self.parameters().cubemap); },
        [](M& self, const CubeLike& value) {
            const CubeSource source = to_cube_source(value, "cubemap");
            self.edit_parameters([&](BasicParameters& p) { p.cubemap = source; });
        },
        "CubeMap, Probe or None: looked up by the object-space position.");
    properties.flag("vertex_colors", &BasicParameters::vertex_colors, vertex_colors_property_doc);
}

PhongParameters phong_parameters(const ArrayLike& color, float ka, float kd, float ks,
                                 float shininess, const MapLike& map, bool vertex_colors) {
    return {to_rgba(color, "color"),   ka,           kd, ks, shininess,
            to_map_source(map, "map"), vertex_colors};
}

void bind_phong(py::module_& module) {
    using M = PhongMaterial;
    auto made = declare<M, Material>(module, "PhongMaterial", phong_doc);
    def_init(made, &phong_parameters, py::arg("color") = py::make_tuple(1, 1, 1),
             py::arg("ka") = 0.2, py::arg("kd") = 0.7, py::arg("ks") = 1.0,
             py::arg("shininess") = 10.0, py::arg("map") = py::none(),
             py::arg("vertex_colors") = false);
    Properties<PhongParameters> properties{made};
    properties.color("color", &PhongParameters::color, color_property_doc);
    properties.number("ka", &PhongParameters::ka, "float: ambient weight.");
    properties.number("kd", &PhongParameters::kd, "float: diffuse weight.");
    properties.number("ks", &PhongParameters::ks, "float: specular weight; highlights are white.");
    properties.number("shininess", &PhongParameters::shininess, "float: Phong's exponent.");
    properties.map(map_property_doc);
    properties.flag("vertex_colors", &PhongParameters::vertex_colors, vertex_colors_property_doc);
}

MirrorParameters mirror_parameters(const ArrayLike& tint, float env_weight, const ArrayLike& color,
                                   float color_weight, std::optional<float> fresnel) {
    return {to_rgba(tint, "tint"), env_weight, to_rgba(color, "color"), color_weight, fresnel};
}

void bind_mirror(py::module_& module) {
    using M = MirrorMaterial;
    auto made = declare<M, Material>(module, "MirrorMaterial", mirror_doc);
    def_init(made, &mirror_parameters, py::arg("tint") = py::make_tuple(1, 1, 1),
             py::arg("env_weight") = 1.0, py::arg("color") = py::make_tuple(0, 0, 0),
             py::arg("color_weight") = 0.0, py::arg("fresnel") = py::none());
    Properties<MirrorParameters> properties{made};
    properties.color("tint", &MirrorParameters::tint,
                     "ndarray (4,) float32: linear RGBA, times what is reflected.");
    properties.number("env_weight", &MirrorParameters::env_weight,
                      "float: weight of what is reflected.");
    properties.color("color", &MirrorParameters::color, color_property_doc);
    properties.number("color_weight", &MirrorParameters::color_weight,
                      "float: weight of the mirror's own colour.");
    made.def_property(
        "fresnel",
        [](const M& self) -> std::optional<double> {
            const auto fresnel = self.parameters().fresnel;
            return fresnel ? std::optional(shortest(*fresnel)) : std::nullopt;
        },
        [](M& self, std::optional<float> value) {
            self.edit_parameters([&](MirrorParameters& p) { p.fresnel = value; });
        },
        "float or None: F0, the reflectance seen head-on, from 0 to 1; None reflects evenly.");
}

GlassParameters glass_parameters(float eta, bool fresnel, const ArrayLike& tint) {
    return {eta, fresnel, to_rgba(tint, "tint")};
}

void bind_glass(py::module_& module) {
    using M = GlassMaterial;
    auto made = declare<M, Material>(module, "GlassMaterial", glass_doc);
    def_init(made, &glass_parameters, py::arg("eta") = 1.0 / 1.52, py::arg("fresnel") = true,
             py::arg("tint") = py::make_tuple(1, 1, 1));
    Properties<GlassParameters> properties{made};
    properties.number("eta", &GlassParameters::eta,
                      "float: refractive index outside divided by the one inside.");
    properties.flag("fresnel", &GlassParameters::fresnel,
                    "bool: whether part of the light is reflected; False: all is refracted.");
    properties.color("tint", &GlassParameters::tint,
                     "ndarray (4,) float32: linear RGBA, times what is refracted.");
}

/// Every parameter, by name: what __init__ takes as keywords.
py::dict material_state(const py::object& self) {
    static constexpr const char* names[] = {
        "color",     "map",  "cubemap", "vertex_colors", "ka",           "kd",     "ks",
        "shininess", "tint", "eta",     "env_weight",    "color_weight", "fresnel"};
    py::dict state = surface_state(self);
    for (const char* name : names) {
        if (py::hasattr(self, name)) state[name] = self.attr(name);
    }
    return state;
}

/// What differs from a new one.
std::string represent_material(const py::object& self) {
    const py::object fresh = py::type::of(self)();
    std::string text;
    for (const auto& [name, value] : material_state(self)) {
        const auto array = py::isinstance<py::array>(value);
        const auto plain = [array](py::object any) {
            return array ? py::tuple(any.attr("tolist")()) : any;
        };
        const auto mine = plain(py::reinterpret_borrow<py::object>(value));
        if (mine.equal(plain(fresh.attr(name)))) continue;
        text += (text.empty() ? "" : ", ") + py::str(name).cast<std::string>() + "=" +
                (array ? tuple_text(to_rgba(value, "color")) : py::repr(value).cast<std::string>());
    }
    return type_name(self) + "(" + text + ")";
}

}  // namespace

}  // namespace cubecam::bindings

void bind_material(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    auto material = declare<Material>(module, "Material", material_doc);
    bind_surface_options(material);
    material.def("__repr__", &represent_material);
    material.def("__reduce__", [](const py::object& self) {
        return reduced(self, py::tuple(), material_state(self));
    });
    def_setstate(material, "dict", [](const py::object& self, const py::dict& state) {
        for (const auto& [name, value] : state) py::setattr(self, name, value);
    });

    bind_basic(module);
    bind_phong(module);
    bind_mirror(module);
    bind_glass(module);
}
