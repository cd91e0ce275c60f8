/// A user's GLSL with its uniforms and textures, from Python and back.
#pragma once

#include "arrays.hpp"
#include "objects.hpp"
#include "values.hpp"

#include "cubecam/cubemap/cubemap.hpp"
#include "cubecam/image/image.hpp"
#include "cubecam/materials/user_shader.hpp"
#include "cubecam/scene/probe.hpp"
#include "cubecam/scene/render_texture.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace cubecam::bindings {

/// Any Python object. Signatures show it as a mapping of names to values of one type.
template <class Value>
class Mapping : public py::object {
    PYBIND11_OBJECT_DEFAULT(Mapping, object, any_object)
    using object::object;
};

using UniformsLike = OneOf<Mapping<ArrayLike>, py::none>;
using TextureLike = OneOf<Image, RenderTexture, CubeMap, Probe, ArrayLike>;
using TexturesLike = OneOf<Mapping<TextureLike>, py::none>;
using UniformsNow = py::typing::Dict<py::str, OneOf<py::float_, py::array_t<double>>>;
using TexturesNow = py::typing::Dict<py::str, OneOf<Image, RenderTexture, CubeMap, Probe>>;

/// GLSL itself, or the path of a file with GLSL.
using SourceLike = OneOf<py::str, PathLike, py::none>;

/// The source from a str of GLSL, or from the file of a path (os.PathLike). None gives an empty
/// source.
UserSource to_user_source(py::handle value, const char* name);
/// The source as its file is now. @throws ValueError if the source did not come from a file.
UserSource read_again(const UserSource& source, const char* name);

UniformValue to_uniform(py::handle value, const std::string& name);
py::object from_uniform(const UniformValue& value);
TextureSource to_texture(py::handle value, const std::string& name);
py::object from_texture(const TextureSource& source);

/// The inputs from two dictionaries; None stands for an empty one.
ShaderInputs to_inputs(py::handle uniforms, py::handle textures);
py::dict uniforms_of(const ShaderInputs& inputs);
py::dict textures_of(const ShaderInputs& inputs);

/// "uniforms=['time'], textures=[]", for __repr__.
std::string inputs_text(const ShaderInputs& inputs);
/// The name of the source's file, or the number of its lines, for __repr__.
std::string source_text(const UserSource& source);

/// The text of a source and the path of its file, for pickling.
inline py::tuple source_state(const UserSource& source) {
    return py::make_tuple(source.text, source.path);
}

inline UserSource source_from_state(const py::handle& state) {
    const auto pair = py::reinterpret_borrow<py::tuple>(state);
    return {pair[0].cast<std::string>(), pair[1].cast<std::string>()};
}

/// Defines the methods from which python/cubecam/_shader_inputs.py makes the mappings `uniforms`
/// and `textures`. `get` returns an object's inputs, `edit` changes them.
template <class Bound, class Get, class Edit>
void bind_inputs(Bound& made, Get get, Edit edit) {
    using Owner = typename Bound::type;
    made.def("_uniforms",
             [get](const Owner& self) -> UniformsNow { return uniforms_of(get(self)); });
    made.def("_textures",
             [get](const Owner& self) -> TexturesNow { return textures_of(get(self)); });
    made.def(
        "_set_inputs",
        [edit](Owner& self, const py::object& uniforms, const py::object& textures) {
            const ShaderInputs given = to_inputs(uniforms, textures);
            edit(self, [&](ShaderInputs& inputs) {
                if (!uniforms.is_none()) inputs.uniforms = given.uniforms;
                if (!textures.is_none()) inputs.textures = given.textures;
            });
        },
        py::arg("uniforms") = py::none(), py::arg("textures") = py::none(),
        "Replace all uniforms, all textures, or both.");
    made.def(
        "_set_uniform",
        [edit](Owner& self, const Text& name, const py::object& value) {
            const UniformValue uniform = to_uniform(value, name);
            edit(self, [&](ShaderInputs& inputs) { inputs.uniforms[name] = uniform; });
        },
        py::arg("name"), py::arg("value"));
    made.def(
        "_set_texture",
        [edit](Owner& self, const Text& name, const py::object& value) {
            const TextureSource texture = to_texture(value, name);
            edit(self, [&](ShaderInputs& inputs) { inputs.textures[name] = texture; });
        },
        py::arg("name"), py::arg("value"));
    made.def(
        "_remove_uniform",
        [edit](Owner& self, const Text& name) {
            edit(self, [&](ShaderInputs& inputs) {
                if (inputs.uniforms.erase(name) == 0) throw py::key_error(name);
            });
        },
        py::arg("name"));
    made.def(
        "_remove_texture",
        [edit](Owner& self, const Text& name) {
            edit(self, [&](ShaderInputs& inputs) {
                if (inputs.textures.erase(name) == 0) throw py::key_error(name);
            });
        },
        py::arg("name"));
}

}  // namespace cubecam::bindings

namespace pybind11::detail {

template <class Value>
struct handle_type_name<cubecam::bindings::Mapping<Value>> {
    static constexpr auto name =
        const_name("collections.abc.Mapping[str, ") + make_caster<Value>::name + const_name("]");
};

}  // namespace pybind11::detail
