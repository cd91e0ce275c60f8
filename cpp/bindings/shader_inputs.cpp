#include "shader_inputs.hpp"

#include "cube_source.hpp"
#include "map_source.hpp"

#include <algorithm>
#include <utility>

namespace cubecam::bindings {

namespace {

py::dict to_dict(py::handle value, const char* name) {
    if (value.is_none()) return {};
    if (!py::isinstance(value, py::module_::import("collections.abc").attr("Mapping"))) {
        refuse(value, name, "a mapping of names to values");
    }
    py::dict items = py::reinterpret_steal<py::dict>(
        PyObject_CallOneArg(reinterpret_cast<PyObject*>(&PyDict_Type), value.ptr()));
    if (!items) throw py::error_already_set();
    for (const auto& [key, item] : items) {
        if (!py::isinstance<py::str>(key)) refuse(key, name, "names");
    }
    return items;
}

UserSource read_source(py::handle path) {
    const py::object file = py::module_::import("pathlib").attr("Path")(path);
    return {file.attr("read_text")(py::arg("encoding") = "utf-8").cast<std::string>(),
            py::str(file).cast<std::string>()};
}

template <class Map>
std::string names_of(const Map& map) {
    std::string text;
    for (const auto& [name, value] : map) text += (text.empty() ? "'" : ", '") + name + "'";
    return "[" + text + "]";
}

}  // namespace

UserSource to_user_source(py::handle value, const char* name) {
    if (value.is_none()) return {};
    if (py::isinstance<py::str>(value)) {
        std::string text = value.cast<std::string>();
        // A driver would end the source at the NUL and report errors about the missing rest.
        if (const std::size_t at = text.find('\0'); at != std::string::npos) {
            throw py::value_error(std::string(name) + ": expected GLSL, got a NUL at byte " +
                                  std::to_string(at));
        }
        return {std::move(text), {}};
    }
    if (!has_attribute(value, "__fspath__")) {
        refuse(value, name, "GLSL as a str, or a pathlib.Path of a file");
    }
    return read_source(value);
}

UserSource read_again(const UserSource& source, const char* name) {
    if (source.path.empty()) {
        throw py::value_error(std::string(name) +
                              ": expected a source that was read from a file (a pathlib.Path), got "
                              "one given as text");
    }
    return read_source(py::str(source.path));
}

UniformValue to_uniform(py::handle value, const std::string& name) {
    py::object given = py::reinterpret_borrow<py::object>(value);
    const std::string what = "uniform " + name;
    if (!py::isinstance<py::str>(given) && !py::isinstance<py::bytes>(given)) {
        const py::array array = to_array(given, what.c_str());
        if (array.dtype().kind() == 'b') given = array.attr("astype")("float64");
    }
    const ContiguousArray<double> array = double_array(given, what.c_str(), "(...)");
    UniformValue uniform{to_vector(array), {}};
    for (py::ssize_t axis = 0; axis < array.ndim(); ++axis) {
        uniform.shape.push_back(static_cast<int>(array.shape(axis)));
    }
    if (uniform.numbers.empty() || uniform.numbers.size() > 65536) {
        throw py::value_error(what + ": expected 1 to 65536 numbers, got shape " +
                              shape_text(array));
    }
    // The number must stay finite when it becomes a float32 on the GPU.
    for (const double number : uniform.numbers) {
        if (number > 4e38 || number < -4e38) {
            throw py::value_error(what + ": expected numbers within float32's range, got " +
                                  std::to_string(number));
        }
    }
    return uniform;
}

py::object from_uniform(const UniformValue& value) {
    if (value.shape.empty()) return py::float_(value.numbers.front());
    py::array_t<double> array(std::vector<py::ssize_t>(value.shape.begin(), value.shape.end()));
    std::copy(value.numbers.begin(), value.numbers.end(), array.mutable_data());
    array.attr("flags").attr("writeable") = false;
    return array;
}

TextureSource to_texture(py::handle value, const std::string& name) {
    const std::string what = "texture " + name;
    if (py::isinstance<CubeMap>(value) || py::isinstance<Probe>(value)) {
        return to_cube_source(value, what.c_str());
    }
    if (value.is_none()) {
        refuse(value, what.c_str(),
               "an Image, an array (H, W, C), a RenderTexture, a CubeMap or a Probe");
    }
    return to_map_source(value, what.c_str());
}

py::object from_texture(const TextureSource& source) {
    if (const auto* map = std::get_if<MapSource>(&source)) return from_map_source(*map);
    return from_cube_source(std::get<CubeSource>(source));
}

ShaderInputs to_inputs(py::handle uniforms, py::handle textures) {
    ShaderInputs inputs;
    for (const auto& [key, value] : to_dict(uniforms, "uniforms")) {
        const auto name = key.cast<std::string>();
        inputs.uniforms.emplace(name, to_uniform(value, name));
    }
    for (const auto& [key, value] : to_dict(textures, "textures")) {
        const auto name = key.cast<std::string>();
        inputs.textures.emplace(name, to_texture(value, name));
    }
    return inputs;
}

py::dict uniforms_of(const ShaderInputs& inputs) {
    py::dict values;
    for (const auto& [name, value] : inputs.uniforms) values[py::str(name)] = from_uniform(value);
    return values;
}

py::dict textures_of(const ShaderInputs& inputs) {
    py::dict values;
    for (const auto& [name, value] : inputs.textures) values[py::str(name)] = from_texture(value);
    return values;
}

std::string inputs_text(const ShaderInputs& inputs) {
    return "uniforms=" + names_of(inputs.uniforms) + ", textures=" + names_of(inputs.textures);
}

std::string source_text(const UserSource& source) {
    if (!source.path.empty()) return "'" + source.path + "'";
    const auto lines = std::count(source.text.begin(), source.text.end(), '\n') +
                       (source.text.ends_with('\n') ? 0 : 1);
    return "<" + std::to_string(lines) + (lines == 1 ? " line>" : " lines>");
}

}  // namespace cubecam::bindings
