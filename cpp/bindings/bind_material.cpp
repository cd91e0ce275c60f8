// cubecam.Material: what all materials have. The kinds register themselves.
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

constexpr const char* material_doc =
    R"doc(Base of the materials: how a surface answers light.

A material may be shared by any number of nodes; a change shows on all of them. Colours are 3 or 4
numbers, linear, or the name of a CSS colour or "#rrggbb", which say sRGB; a fourth number, from 0 to
1, multiplies `opacity`. What is not fully opaque is blended over what lies behind it.

Every material takes these by keyword, and has them as attributes:

======================  =========================================================================
opacity=1               from 0 to 1, times the alpha of the colours
double_sided=False      True shows both sides; False culls back faces
blend=None              how its colour S, of alpha a, joins what is there already, D:
                        "opaque": S, with alpha 1;
                        "alpha": a S + (1 - a) D, alpha a + (1 - a) D;
                        "alpha_keep": the same colour, alpha stays D's;
                        "additive": a S + D, alpha a + D;
                        "multiply": (1 - a + a S) D, alpha stays D's;
                        "premultiplied": S + (1 - a) D in all four channels, for maps whose colour
                        is multiplied by their alpha already; opacity and the colour's alpha
                        multiply both;
                        a `Blend`: as its factors say.
                        None: "alpha" where anything is translucent, else "opaque"
depth_write=None        whether it hides what is drawn later and is farther; None: if its blend is
                        "opaque"
depth_test=True         False is drawn over what is nearer as well
color_write=True        which channels are written: one bool, or four (red, green, blue, alpha)
stencil=None            a `Stencil`: how it tests and changes the stencil buffer, where
                        ``depth_format`` has one; None leaves it alone
======================  =========================================================================

What is blended, or writes no depth, is drawn after the background, far to near; it writes colour
and none of the other outputs. A mask that writes neither colour nor depth, but a stencil, is drawn
among the opaque nodes.
)doc";

/// Every parameter, by name: what __init__ takes as keywords.
py::dict material_state(const py::object& self) {
    py::dict state = surface_state(self);
    const MaterialValue value = self.cast<const Material&>().value();
    for (const char* name : value.traits().kind->fields) state[name] = self.attr(name);
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

std::vector<std::pair<std::string, MaterialBinding::Bind>>& MaterialBinding::all() {
    static std::vector<std::pair<std::string, Bind>> bindings;
    return bindings;
}

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

    auto kinds = MaterialBinding::all();
    std::sort(kinds.begin(), kinds.end());
    for (const auto& [name, bind] : kinds) bind(module);
}
