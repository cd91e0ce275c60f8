// cubecam.Stencil
#include "numbers.hpp"
#include "stencil.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace cubecam::bindings {

namespace {

constexpr const char* stencil_doc =
    R"doc(A stencil test, and what drawing does to the stencil buffer.

Give it to any material as ``stencil=``, and ask for a buffer by ``depth_format="depth24_stencil8"``,
"depth32f_stencil8" or "stencil_index8"; without one it has no effect. The buffer holds 8 bits a
pixel and starts a picture at 0. What masks must be drawn before what is masked: see
``Node.render_order``. It never changes; compared by its values.

Parameters
----------
func : {"always", "never", "less", "equal", "lequal", "greater", "notequal", "gequal"}
    A pixel is drawn where ``reference & read_mask`` compares so with ``stored & read_mask``: "less"
    where the reference is less than what is stored.
reference : int
    From 0 to 255.
read_mask : int
    The bits that are compared, from 0 to 255.
write_mask : int
    The bits that may change, from 0 to 255.
fail : {"keep", "zero", "replace", "incr", "incr_wrap", "decr", "decr_wrap", "invert"}
    What becomes of the stored number where the test fails. "replace": the reference. "incr" stops
    at 255, "incr_wrap" goes on at 0; so, downwards, do "decr" and "decr_wrap".
depth_fail : str
    The same where the test passes and the depth test fails.
depth_pass : str
    The same where both pass, or there is no depth test.

Raises
------
ValueError
    For an unknown word, or a number out of its range.
TypeError
    For an argument of another type.

Notes
-----
OpenGL 4.6, section 17.3.3; front and back faces alike.

Examples
--------
A disc as a window: invisible itself, it lets the red plane behind it show within its outline only.

>>> import cubecam as cc
>>> scene = cc.Scene()
>>> hole = cc.BasicMaterial(color_write=False, depth_write=False,
...                         stencil=cc.Stencil(reference=1, depth_pass="replace"))
>>> disc = scene.add(cc.Mesh.sphere(.5), hole, scale=(1, 1, .01), position=(0, 0, 1), render_order=-1)
>>> seen = cc.BasicMaterial(color=(1, 0, 0), stencil=cc.Stencil(func="equal", reference=1))
>>> plane = scene.add(cc.Mesh.box((4, 4, .1)), seen)
>>> with cc.Renderer() as renderer:
...     frame = renderer.render(scene, cc.PerspectiveCamera(position=(0, 0, 3)), size=(32, 32),
...                             depth_format="depth24_stencil8", outputs=("stencil", "id"))
>>> int(frame.id[16, 16]), int(frame.stencil[16, 16]), int(frame.id[0, 0])
(2, 1, 0)
)doc";

std::uint8_t to_byte(py::handle value, const char* name) {
    return static_cast<std::uint8_t>(to_int(value, name, 0, 255));
}

using Whole = OneOf<py::int_>;

std::shared_ptr<Stencil> make_stencil(const std::string& func, const Whole& reference,
                                      const Whole& read_mask, const Whole& write_mask,
                                      const std::string& fail, const std::string& depth_fail,
                                      const std::string& depth_pass) {
    return std::make_shared<Stencil>(
        Stencil{parse_stencil_func(func, "func"), to_byte(reference, "reference"),
                to_byte(read_mask, "read_mask"), to_byte(write_mask, "write_mask"),
                parse_stencil_op(fail, "fail"), parse_stencil_op(depth_fail, "depth_fail"),
                parse_stencil_op(depth_pass, "depth_pass")});
}

py::tuple stencil_state(const Stencil& s) {
    return py::make_tuple(std::string(to_string(s.func)), s.reference, s.read_mask, s.write_mask,
                          std::string(to_string(s.fail)), std::string(to_string(s.depth_fail)),
                          std::string(to_string(s.depth_pass)));
}

/// What differs from a new one.
std::string represent_stencil(const Stencil& stencil) {
    static constexpr const char* names[] = {"func", "reference",  "read_mask", "write_mask",
                                            "fail", "depth_fail", "depth_pass"};
    const py::tuple mine = stencil_state(stencil);
    const py::tuple fresh = stencil_state({});
    std::string text;
    for (std::size_t i = 0; i < mine.size(); ++i) {
        const py::object value = mine[i];
        if (value.equal(fresh[i])) continue;
        text += (text.empty() ? "" : ", ") + std::string(names[i]) + "=" +
                py::repr(value).cast<std::string>();
    }
    return "Stencil(" + text + ")";
}

template <class Word>
auto word_of(Word Stencil::* field) {
    return [field](const Stencil& self) { return std::string(to_string(self.*field)); };
}

}  // namespace

}  // namespace cubecam::bindings

void bind_stencil(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    auto stencil = declare<Stencil>(module, "Stencil", stencil_doc);
    stencil
        .def(py::init(&make_stencil), py::kw_only(), py::arg("func") = "always",
             py::arg("reference") = 0, py::arg("read_mask") = 255, py::arg("write_mask") = 255,
             py::arg("fail") = "keep", py::arg("depth_fail") = "keep",
             py::arg("depth_pass") = "keep")
        .def_property_readonly("func", word_of(&Stencil::func), "str: the comparison.")
        .def_readonly("reference", &Stencil::reference, "int: what is compared and written.")
        .def_readonly("read_mask", &Stencil::read_mask, "int: the bits that are compared.")
        .def_readonly("write_mask", &Stencil::write_mask, "int: the bits that may change.")
        .def_property_readonly("fail", word_of(&Stencil::fail), "str: where the test fails.")
        .def_property_readonly("depth_fail", word_of(&Stencil::depth_fail),
                               "str: where only the depth test fails.")
        .def_property_readonly("depth_pass", word_of(&Stencil::depth_pass), "str: where both pass.")
        .def(
            "__eq__", [](const Stencil& a, const Stencil& b) { return a == b; }, py::is_operator(),
            py::arg("other"))
        .def("__hash__", [](const Stencil& self) { return py::hash(stencil_state(self)); })
        .def("__repr__", &represent_stencil)
        .def("__reduce__", [](const py::object& self) {
            return reduced(self, attributes_of(self, "func", "reference", "read_mask", "write_mask",
                                               "fail", "depth_fail", "depth_pass"));
        });
}
