// cubecam.ShaderMaterial
#include "docs/reload.hpp"
#include "docs/shader_material.hpp"
#include "material_kind.hpp"
#include "shader_inputs.hpp"

#include "cubecam/materials/shader.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <concepts>
#include <optional>
#include <string>
#include <type_traits>

namespace cubecam::bindings {

namespace {

Shader shader_of(const SourceLike& fragment, const SourceLike& vertex, const UniformsLike& uniforms,
                 const TexturesLike& textures, Argument<std::optional<float>> displacement) {
    return {to_user_source(fragment, "fragment"), to_user_source(vertex, "vertex"),
            to_inputs(uniforms, textures), displacement};
}

/// Reads both files again and returns whether either source changed.
bool reload(ShaderMaterial& self) {
    const Shader before = self.kind();
    UserSource fragment = before.fragment;
    UserSource vertex = before.vertex;
    if (!fragment.path.empty() || vertex.path.empty()) fragment = read_again(fragment, "fragment");
    if (!vertex.path.empty()) vertex = read_again(vertex, "vertex");
    self.edit_kind([&](Shader& p) {
        p.fragment = fragment;
        p.vertex = vertex;
    });
    return !(fragment == before.fragment && vertex == before.vertex);
}

void bind_shader_material(py::module_& module) {
    using M = ShaderMaterial;
    auto made = declare<M, Material>(module, "ShaderMaterial", docs::shader_material);
    def_init(made, &shader_of, py::arg("fragment"), py::kw_only(), py::arg("vertex") = py::none(),
             py::arg("uniforms") = py::none(), py::arg("textures") = py::none(),
             py::arg("displacement") = py::none());
    for_each_field<Shader>([&made](const auto& field) {
        // Uniforms and textures are mappings instead: python/cubecam/_shader_inputs.py.
        if constexpr (!std::same_as<typename std::remove_cvref_t<decltype(field)>::Type,
                                    ShaderInputs>) {
            def_field(made, field);
        }
    });
    bind_inputs(
        made, [](const M& self) { return self.kind().inputs; },
        [](M& self, const auto& change) { self.edit_kind([&](Shader& p) { change(p.inputs); }); });
    made.def("reload", &reload, docs::reload);
    made.def("__repr__", [](const M& self) {
        const Shader p = self.kind();
        return "ShaderMaterial(fragment=" + source_text(p.fragment) +
               (p.vertex.text.empty() ? "" : ", vertex=" + source_text(p.vertex)) + ", " +
               inputs_text(p.inputs) + ")";
    });
    // The textures go into the state, since a probe may refer to the material.
    made.def("__reduce__", [](const py::object& self) {
        const auto p = self.cast<const M&>().kind();
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
        material.edit_kind([&](Shader& p) {
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

const MaterialBinding shader(Shader::name, &bind_shader_material);

}  // namespace

}  // namespace cubecam::bindings
