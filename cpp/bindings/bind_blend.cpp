// cubecam.Blend
#include "objects.hpp"

#include "cubecam/materials/blend.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace cubecam::bindings {

namespace {

constexpr const char* blend_doc =
    R"doc(Blending by OpenGL's own factors, for any material as ``blend=``.

With S what the surface gives and D what is there, the colour becomes src * S + dst * D, and the alpha
src_alpha * S + dst_alpha * D. The colour of S is not multiplied by its alpha; its alpha is the product
of opacity and the alphas of colour and map. Formats with limits clamp S, and the result, to 0..1. A
surface with a `Blend` is drawn as every blended one is: after the background, far to near, and leaving
no depth unless ``depth_write=True``. A Blend never changes; compared by its values.

Parameters
----------
src : str
    What multiplies S: "zero", "one", "src_color", "one_minus_src_color", "dst_color",
    "one_minus_dst_color", "src_alpha", "one_minus_src_alpha", "dst_alpha", "one_minus_dst_alpha" or
    "src_alpha_saturate", which is min(alpha of S, 1 - alpha of D) for colours and 1 for alphas.
dst : str
    What multiplies D.
src_alpha, dst_alpha : str, optional
    The same for the alphas, where "src_color" is the alpha of S. None takes the colour's.
equation : {"add", "subtract", "reverse_subtract", "min", "max"}
    "add" as above; "subtract": src * S - dst * D; "reverse_subtract": dst * D - src * S; "min" and
    "max" of S and D, channel by channel, whatever the factors.

Raises
------
ValueError
    For an unknown word.
TypeError
    For what is no word.

Notes
-----
OpenGL 4.5, section 17.3.6.

Examples
--------
The plain pair of many tutorials, which blends the alpha as if it were a colour:

>>> import cubecam as cc
>>> pair = cc.Blend("src_alpha", "one_minus_src_alpha")
>>> scene = cc.Scene(background=(0, 0, 1, 1))
>>> pane = scene.add(cc.Mesh.box((9, 9, .1)), cc.BasicMaterial(color=(1, 0, 0), opacity=.5, blend=pair))
>>> with cc.Renderer() as renderer:
...     frame = renderer.render(scene, cc.PerspectiveCamera(position=(0, 0, 3)), size=(8, 8),
...                             format="rgba32f")
>>> frame.color[4, 4].tolist()
[0.5, 0.0, 0.5, 0.75]
)doc";

using WordOrNone = OneOf<py::str, py::none>;

BlendFactor to_factor(py::handle given, const char* name, BlendFactor colors) {
    if (given.is_none()) return colors;
    if (!py::isinstance<py::str>(given)) refuse(given, name, "the name of a factor or None");
    return parse_blend_factor(given.cast<std::string>(), name);
}

BlendFactors blend_from_words(const std::string& src, const std::string& dst,
                              const WordOrNone& src_alpha, const WordOrNone& dst_alpha,
                              const std::string& equation) {
    BlendFactors made;
    made.src = parse_blend_factor(src, "src");
    made.dst = parse_blend_factor(dst, "dst");
    made.src_alpha = to_factor(src_alpha, "src_alpha", made.src);
    made.dst_alpha = to_factor(dst_alpha, "dst_alpha", made.dst);
    made.equation = parse_blend_equation(equation);
    return made;
}

template <class Word>
auto word_of_blend(Word BlendFactors::* field) {
    return [field](const BlendFactors& self) { return std::string(to_string(self.*field)); };
}

/// All five words.
py::tuple blend_words(const BlendFactors& blend) {
    return py::make_tuple(std::string(to_string(blend.src)), std::string(to_string(blend.dst)),
                          std::string(to_string(blend.src_alpha)),
                          std::string(to_string(blend.dst_alpha)),
                          std::string(to_string(blend.equation)));
}

std::string represent_blend(const BlendFactors& blend) {
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

    auto blend = declare<BlendFactors>(module, "Blend", blend_doc);
    blend
        .def(
            py::init([](const std::string& src, const std::string& dst, const WordOrNone& src_alpha,
                        const WordOrNone& dst_alpha, const std::string& equation) {
                return std::make_shared<BlendFactors>(
                    blend_from_words(src, dst, src_alpha, dst_alpha, equation));
            }),
            py::arg("src"), py::arg("dst"), py::kw_only(), py::arg("src_alpha") = py::none(),
            py::arg("dst_alpha") = py::none(), py::arg("equation") = "add")
        .def_property_readonly("src", word_of_blend(&BlendFactors::src),
                               "str: what multiplies the surface's colour.")
        .def_property_readonly("dst", word_of_blend(&BlendFactors::dst),
                               "str: what multiplies the colour that is there.")
        .def_property_readonly("src_alpha", word_of_blend(&BlendFactors::src_alpha),
                               "str: what multiplies the surface's alpha.")
        .def_property_readonly("dst_alpha", word_of_blend(&BlendFactors::dst_alpha),
                               "str: what multiplies the alpha that is there.")
        .def_property_readonly("equation", word_of_blend(&BlendFactors::equation),
                               "str: what becomes of both products.")
        .def(
            "__eq__", [](const BlendFactors& a, const BlendFactors& b) { return a == b; },
            py::is_operator(), py::arg("other"))
        .def("__hash__", [](const BlendFactors& self) { return py::hash(blend_words(self)); })
        .def("__repr__", &represent_blend)
        .def("__reduce__", [](const py::object& self) {
            const py::tuple words = blend_words(self.cast<const BlendFactors&>());
            return reduced(self, py::make_tuple(words[0], words[1]), words);
        });
    def_setstate(blend, "tuple", [](const py::object& self, const py::tuple& words) {
        self.cast<BlendFactors&>() = blend_from_words(
            words[0].cast<std::string>(), words[1].cast<std::string>(), WordOrNone(words[2]),
            WordOrNone(words[3]), words[4].cast<std::string>());
    });
}
