// cubecam.ShaderMaterial and cubecam.ImageEffect
#include "bind_shader_docs.hpp"
#include "shader_inputs.hpp"
#include "surface_options.hpp"
#include "vectors.hpp"

#include "cubecam/materials/material.hpp"
#include "cubecam/scene/image_effect.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <optional>
#include <string>

namespace cubecam::bindings {

namespace {

using MappingLike = OneOf<py::typing::Dict<py::str, py::object>, py::none>;

ShaderParameters shader_parameters(const SourceLike& fragment, const SourceLike& vertex,
                                   const MappingLike& uniforms, const MappingLike& textures,
                                   std::optional<float> displacement) {
    return {to_user_source(fragment, "fragment"), to_user_source(vertex, "vertex"),
            to_inputs(uniforms, textures), displacement};
}

void source_property(Class<ShaderMaterial, Material>& made, const char* name,
                     UserSource ShaderParameters::* field, const char* doc) {
    made.def_property(
        name,
        [field](const ShaderMaterial& self) -> std::optional<std::string> {
            const UserSource source = self.parameters().*field;
            return source.text.empty() ? std::nullopt : std::optional(source.text);
        },
        [field, name](ShaderMaterial& self, const SourceLike& value) {
            const UserSource source = to_user_source(value, name);
            self.edit_parameters([&](ShaderParameters& p) { p.*field = source; });
        },
        doc);
}

/// Reads both files anew; whether either changed.
bool reload_material(ShaderMaterial& self) {
    const ShaderParameters before = self.parameters();
    UserSource fragment = before.fragment;
    UserSource vertex = before.vertex;
    if (!fragment.path.empty() || vertex.path.empty()) fragment = read_again(fragment, "fragment");
    if (!vertex.path.empty()) vertex = read_again(vertex, "vertex");
    self.edit_parameters([&](ShaderParameters& p) {
        p.fragment = fragment;
        p.vertex = vertex;
    });
    return !(fragment == before.fragment && vertex == before.vertex);
}

bool reload_effect(ImageEffect& self) {
    const UserSource before = self.value().fragment;
    const UserSource now = read_again(before, "fragment");
    self.edit([&](EffectValue& value) { value.fragment = now; });
    return !(now == before);
}

/// Text of a source and the file it is from.
py::tuple source_state(const UserSource& source) {
    return py::make_tuple(source.text, source.path);
}

UserSource source_from_state(const py::handle& state) {
    const auto pair = py::reinterpret_borrow<py::tuple>(state);
    return {pair[0].cast<std::string>(), pair[1].cast<std::string>()};
}

void bind_shader_material(py::module_& module) {
    using M = ShaderMaterial;
    auto made = declare<M, Material>(module, "ShaderMaterial", shader_material_doc);
    def_init(made, &shader_parameters, py::arg("fragment"), py::arg("vertex") = py::none(),
             py::arg("uniforms") = py::none(), py::arg("textures") = py::none(),
             py::arg("displacement") = py::none());
    source_property(made, "fragment", &ShaderParameters::fragment,
                    "str: GLSL of every fragment. Setting it, to text or a path, shows in the next "
                    "picture.");
    source_property(made, "vertex", &ShaderParameters::vertex,
                    "str or None: GLSL of every vertex.");
    made.def_property(
        "displacement",
        [](const M& self) -> std::optional<double> {
            const auto value = self.parameters().displacement;
            return value ? std::optional(shortest(*value)) : std::nullopt;
        },
        [](M& self, std::optional<float> value) {
            self.edit_parameters([&](ShaderParameters& p) { p.displacement = value; });
        },
        "float or None: how far `vertex` moves a vertex at most, in the mesh's units; None: "
        "unknown, so the node is never culled.");
    bind_inputs(
        made, [](const M& self) { return self.parameters().inputs; },
        [](M& self, const auto& change) {
            self.edit_parameters([&](ShaderParameters& p) { change(p.inputs); });
        });
    made.def("reload", &reload_material, reload_doc);
    made.def("__repr__", [](const M& self) {
        const ShaderParameters p = self.parameters();
        return "ShaderMaterial(fragment=" + source_text(p.fragment) +
               (p.vertex.text.empty() ? "" : ", vertex=" + source_text(p.vertex)) + ", " +
               inputs_text(p.inputs) + ")";
    });
    // The textures go into the state: a probe may lead back to the material.
    made.def("__reduce__", [](const py::object& self) {
        const auto p = self.cast<const M&>().parameters();
        const py::object surface = surface_state(self);
        return reduced(self, py::make_tuple(p.fragment.text),
                       py::make_tuple(source_state(p.fragment), source_state(p.vertex),
                                      uniforms_of(p.inputs), textures_of(p.inputs),
                                      self.attr("displacement"), surface));
    });
    def_setstate(made, "tuple", [](const py::object& self, const py::tuple& state) {
        auto& material = self.cast<M&>();
        const UserSource fragment = source_from_state(state[0]);
        const UserSource vertex = source_from_state(state[1]);
        const ShaderInputs inputs = to_inputs(state[2], state[3]);
        material.edit_parameters([&](ShaderParameters& p) {
            p.fragment = fragment;
            p.vertex = vertex;
            p.inputs = inputs;
        });
        self.attr("displacement") = state[4];
        for (const auto& [name, value] : py::reinterpret_borrow<py::dict>(state[5])) {
            py::setattr(self, name, value);
        }
    });
}

void bind_image_effect(py::module_& module) {
    using E = ImageEffect;
    auto made = declare<E>(module, "ImageEffect", image_effect_doc);
    made.def(py::init([](const SourceLike& fragment, const MappingLike& uniforms,
                         const MappingLike& textures) {
                 return std::make_shared<E>(EffectValue{to_user_source(fragment, "fragment"),
                                                        to_inputs(uniforms, textures)});
             }),
             py::arg("fragment"), py::kw_only(), py::arg("uniforms") = py::none(),
             py::arg("textures") = py::none());
    made.def_property(
        "fragment", [](const E& self) { return self.value().fragment.text; },
        [](E& self, const SourceLike& value) {
            const UserSource source = to_user_source(value, "fragment");
            self.edit([&](EffectValue& next) { next.fragment = source; });
        },
        "str: GLSL of every pixel. Setting it, to text or a path, shows in the next picture.");
    bind_inputs(
        made, [](const E& self) { return self.value().inputs; },
        [](E& self, const auto& change) {
            self.edit([&](EffectValue& next) { change(next.inputs); });
        });
    made.def("reload", &reload_effect, reload_doc);
    made.def("__repr__", [](const E& self) {
        const EffectValue value = self.value();
        return "ImageEffect(fragment=" + source_text(value.fragment) + ", " +
               inputs_text(value.inputs) + ")";
    });
    made.def("__reduce__", [](const py::object& self) {
        const EffectValue value = self.cast<const E&>().value();
        py::dict arguments;
        arguments["fragment"] = value.fragment.text;
        arguments["uniforms"] = uniforms_of(value.inputs);
        arguments["textures"] = textures_of(value.inputs);
        return reduced(self, arguments, source_state(value.fragment));
    });
    def_setstate(made, "tuple", [](const py::object& self, const py::tuple& state) {
        const UserSource fragment = source_from_state(state);
        self.cast<E&>().edit([&](EffectValue& next) { next.fragment = fragment; });
    });
}

}  // namespace

}  // namespace cubecam::bindings

void bind_shader(pybind11::module_& module) {
    cubecam::bindings::bind_shader_material(module);
    cubecam::bindings::bind_image_effect(module);
}
