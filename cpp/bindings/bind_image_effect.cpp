// cubecam.ImageEffect
#include "docs/image_effect.hpp"
#include "docs/reload.hpp"
#include "objects.hpp"
#include "shader_inputs.hpp"

#include "cubecam/scene/image_effect.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <string>

namespace cubecam::bindings {

namespace {

bool reload(ImageEffect& self) {
    const UserSource before = self.value().fragment;
    const UserSource now = read_again(before, "fragment");
    self.edit([&](EffectValue& value) { value.fragment = now; });
    return !(now == before);
}

void bind_effect_class(py::module_& module) {
    using E = ImageEffect;
    auto made = declare<E>(module, "ImageEffect", docs::image_effect);
    made.def(py::init([](const SourceLike& fragment, const UniformsLike& uniforms,
                         const TexturesLike& textures) {
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
        "str: GLSL that runs for every pixel. It can be set to text or a path; the next picture "
        "shows "
        "the change.");
    bind_inputs(
        made, [](const E& self) { return self.value().inputs; },
        [](E& self, const auto& change) {
            self.edit([&](EffectValue& next) { change(next.inputs); });
        });
    made.def("reload", &reload, docs::reload);
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

void bind_image_effect(pybind11::module_& module) { cubecam::bindings::bind_effect_class(module); }
