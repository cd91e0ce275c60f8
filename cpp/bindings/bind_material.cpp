// cubecam.Material, the base of all materials. The kinds register themselves.
#include "docs/material.hpp"
#include "material_kind.hpp"
#include "objects.hpp"
#include "surface_options.hpp"
#include "vectors.hpp"

#include "cubecam/materials/material.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace cubecam::bindings {

namespace {

/// The parameters of a material by name: the keywords of its __init__.
py::dict state_of(const py::object& self) {
    py::dict state = surface_state(self);
    const MaterialValue value = self.cast<const Material&>().value();
    for (const char* name : value.traits().kind->fields) state[name] = self.attr(name);
    return state;
}

/// A colour of three or four numbers.
std::string color_text(py::handle value) {
    const glm::vec4 color = to_rgba(value, "color");
    return py::len(value) == 3 ? tuple_text(glm::vec3(color)) : tuple_text(color);
}

/// The constructor call with the parameters that differ from the defaults.
std::string represent(const py::object& self) {
    const py::object fresh = py::type::of(self)();
    std::string text;
    for (const auto& [name, value] : state_of(self)) {
        const auto array = py::isinstance<py::array>(value);
        const auto plain = [array](py::object any) {
            return array ? py::tuple(any.attr("tolist")()) : any;
        };
        const auto mine = plain(py::reinterpret_borrow<py::object>(value));
        if (mine.equal(plain(fresh.attr(name)))) continue;
        text += (text.empty() ? "" : ", ") + py::str(name).cast<std::string>() + "=" +
                (array ? color_text(value) : py::repr(value).cast<std::string>());
    }
    return type_name(self) + "(" + text + ")";
}

}  // namespace

std::vector<std::pair<std::string, MaterialBinding::Bind>>& MaterialBinding::all() {
    static std::vector<std::pair<std::string, Bind>> bindings;
    return bindings;
}

}  // namespace cubecam::bindings

void bind_material(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    auto material = declare<Material>(module, "Material", docs::material);
    bind_surface_options(material);
    material.def("__repr__", &represent);
    material.def("__reduce__",
                 [](const py::object& self) { return reduced(self, py::tuple(), state_of(self)); });
    def_setstate(material, "dict", [](const py::object& self, const py::dict& state) {
        for (const auto& [name, value] : state) py::setattr(self, name, value);
    });

    auto kinds = MaterialBinding::all();
    std::sort(kinds.begin(), kinds.end());
    for (const auto& [name, bind] : kinds) bind(module);
}
