// cubecam.Blend
#include "choice.hpp"
#include "docs/blend.hpp"
#include "objects.hpp"

#include "cubecam/materials/blend.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace cubecam::bindings {

namespace {

using FactorName = Choice<blend_factor_names>;
using EquationName = Choice<blend_equation_names>;
using FactorOrNone = OneOf<FactorName, py::none>;

BlendFactor to_factor(py::handle given, const char* name, BlendFactor colors) {
    if (given.is_none()) return colors;
    if (!py::isinstance<py::str>(given)) refuse(given, name, "the name of a factor or None");
    return parse_blend_factor(given.cast<std::string>(), name);
}

BlendFactors from_words(const FactorName& src, const FactorName& dst, const FactorOrNone& src_alpha,
                        const FactorOrNone& dst_alpha, const EquationName& equation) {
    BlendFactors made;
    made.src = parse_blend_factor(src, "src");
    made.dst = parse_blend_factor(dst, "dst");
    made.src_alpha = to_factor(src_alpha, "src_alpha", made.src);
    made.dst_alpha = to_factor(dst_alpha, "dst_alpha", made.dst);
    made.equation = parse_blend_equation(equation);
    return made;
}

auto factor_of(BlendFactor BlendFactors::* field) {
    return [field](const BlendFactors& self) -> FactorName { return to_string(self.*field); };
}

/// The arguments of the constructor, in their order.
py::tuple words_of(const BlendFactors& blend) {
    return py::make_tuple(std::string(to_string(blend.src)), std::string(to_string(blend.dst)),
                          std::string(to_string(blend.src_alpha)),
                          std::string(to_string(blend.dst_alpha)),
                          std::string(to_string(blend.equation)));
}

std::string represent(const BlendFactors& blend) {
    const auto quoted = [](auto word) { return "'" + std::string(to_string(word)) + "'"; };
    std::string text = "Blend(" + quoted(blend.src) + ", " + quoted(blend.dst);
    if (blend.src_alpha != blend.src) text += ", src_alpha=" + quoted(blend.src_alpha);
    if (blend.dst_alpha != blend.dst) text += ", dst_alpha=" + quoted(blend.dst_alpha);
    if (blend.equation != BlendEquation::add) text += ", equation=" + quoted(blend.equation);
    return text + ")";
}

}  // namespace

}  // namespace cubecam::bindings

void bind_blend(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    auto blend = declare<BlendFactors>(module, "Blend", docs::blend);
    blend
        .def(
            py::init([](const FactorName& src, const FactorName& dst, const FactorOrNone& src_alpha,
                        const FactorOrNone& dst_alpha, const EquationName& equation) {
                return std::make_shared<BlendFactors>(
                    from_words(src, dst, src_alpha, dst_alpha, equation));
            }),
            py::arg("src"), py::arg("dst"), py::kw_only(), py::arg("src_alpha") = py::none(),
            py::arg("dst_alpha") = py::none(), py::arg("equation") = "add")
        .def_property_readonly("src", factor_of(&BlendFactors::src),
                               "str: the factor of the surface's colour.")
        .def_property_readonly("dst", factor_of(&BlendFactors::dst),
                               "str: the factor of the colour in the picture.")
        .def_property_readonly("src_alpha", factor_of(&BlendFactors::src_alpha),
                               "str: the factor of the surface's alpha.")
        .def_property_readonly("dst_alpha", factor_of(&BlendFactors::dst_alpha),
                               "str: the factor of the alpha in the picture.")
        .def_property_readonly(
            "equation",
            [](const BlendFactors& self) -> EquationName { return to_string(self.equation); },
            "str: how the two products are combined.")
        .def(
            "__eq__", [](const BlendFactors& a, const BlendFactors& b) { return a == b; },
            py::is_operator(), py::arg("other"))
        .def("__hash__", [](const BlendFactors& self) { return py::hash(words_of(self)); })
        .def("__repr__", &represent)
        .def("__reduce__", [](const py::object& self) {
            const py::tuple words = words_of(self.cast<const BlendFactors&>());
            return reduced(self, py::make_tuple(words[0], words[1]), words);
        });
    def_setstate(blend, "tuple", [](const py::object& self, const py::tuple& words) {
        self.cast<BlendFactors&>() = from_words(
            words[0].cast<std::string>(), words[1].cast<std::string>(), FactorOrNone(words[2]),
            FactorOrNone(words[3]), words[4].cast<std::string>());
    });
}
