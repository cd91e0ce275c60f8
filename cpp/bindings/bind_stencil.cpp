// cubecam.Stencil
#include "choice.hpp"
#include "docs/stencil.hpp"
#include "numbers.hpp"
#include "stencil.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

namespace cubecam::bindings {

namespace {

std::uint8_t to_byte(py::handle value, const char* name) {
    return static_cast<std::uint8_t>(to_int(value, name, 0, 255));
}

using FuncName = Choice<stencil_func_names>;
using OpName = Choice<stencil_op_names>;

std::shared_ptr<Stencil> make_stencil(const FuncName& func, const WholeNumber& reference,
                                      const WholeNumber& read_mask, const WholeNumber& write_mask,
                                      const OpName& fail, const OpName& depth_fail,
                                      const OpName& depth_pass) {
    return std::make_shared<Stencil>(
        Stencil{parse_stencil_func(func, "func"), to_byte(reference, "reference"),
                to_byte(read_mask, "read_mask"), to_byte(write_mask, "write_mask"),
                parse_stencil_op(fail, "fail"), parse_stencil_op(depth_fail, "depth_fail"),
                parse_stencil_op(depth_pass, "depth_pass")});
}

py::tuple state_of(const Stencil& s) {
    return py::make_tuple(std::string(to_string(s.func)), s.reference, s.read_mask, s.write_mask,
                          std::string(to_string(s.fail)), std::string(to_string(s.depth_fail)),
                          std::string(to_string(s.depth_pass)));
}

/// The constructor call with the arguments that differ from the defaults.
std::string represent(const Stencil& stencil) {
    static constexpr const char* names[] = {"func", "reference",  "read_mask", "write_mask",
                                            "fail", "depth_fail", "depth_pass"};
    const py::tuple mine = state_of(stencil);
    const py::tuple fresh = state_of({});
    std::string text;
    for (std::size_t i = 0; i < mine.size(); ++i) {
        const py::object value = mine[i];
        if (value.equal(fresh[i])) continue;
        text += (text.empty() ? "" : ", ") + std::string(names[i]) + "=" +
                py::repr(value).cast<std::string>();
    }
    return "Stencil(" + text + ")";
}

auto op_of(StencilOp Stencil::* field) {
    return [field](const Stencil& self) -> OpName { return to_string(self.*field); };
}

}  // namespace

}  // namespace cubecam::bindings

void bind_stencil(pybind11::module_& module) {
    using namespace cubecam;
    using namespace cubecam::bindings;
    namespace py = pybind11;

    auto stencil = declare<Stencil>(module, "Stencil", docs::stencil);
    stencil
        .def(py::init(&make_stencil), py::kw_only(), py::arg("func") = "always",
             py::arg("reference") = 0, py::arg("read_mask") = 255, py::arg("write_mask") = 255,
             py::arg("fail") = "keep", py::arg("depth_fail") = "keep",
             py::arg("depth_pass") = "keep")
        .def_property_readonly(
            "func", [](const Stencil& self) -> FuncName { return to_string(self.func); },
            "str: the comparison of the reference with the stored number.")
        .def_readonly("reference", &Stencil::reference,
                      "int: the number that is compared and written.")
        .def_readonly("read_mask", &Stencil::read_mask, "int: the bits that are compared.")
        .def_readonly("write_mask", &Stencil::write_mask, "int: the bits that may change.")
        .def_property_readonly("fail", op_of(&Stencil::fail),
                               "str: how the number changes where the test fails.")
        .def_property_readonly("depth_fail", op_of(&Stencil::depth_fail),
                               "str: how the number changes where only the depth test fails.")
        .def_property_readonly("depth_pass", op_of(&Stencil::depth_pass),
                               "str: how the number changes where both tests pass.")
        .def(
            "__eq__", [](const Stencil& a, const Stencil& b) { return a == b; }, py::is_operator(),
            py::arg("other"))
        .def("__hash__", [](const Stencil& self) { return py::hash(state_of(self)); })
        .def("__repr__", &represent)
        .def("__reduce__", [](const py::object& self) {
            return reduced(self, attributes_of(self, "func", "reference", "read_mask", "write_mask",
                                               "fail", "depth_fail", "depth_pass"));
        });
}
