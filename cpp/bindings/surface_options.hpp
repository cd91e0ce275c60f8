/// What every material takes by keyword, from Python and back.
#pragma once

#include "objects.hpp"
#include "stencil.hpp"

#include "cubecam/materials/material.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>

namespace cubecam::bindings {

using BlendLike = OneOf<py::str, py::none>;
using DepthWriteLike = OneOf<py::bool_, py::none>;
using ColorWriteLike = OneOf<py::bool_, py::typing::Tuple<bool, bool, bool, bool>>;

inline bool to_bool(py::handle value, const char* name, const char* expected) {
    // numpy's own booleans, too, but no numbers: 0.5 is neither.
    const py::object kind = py::module_::import("numpy").attr("bool_");
    if (!py::isinstance<py::bool_>(value) && !py::isinstance(value, kind)) {
        refuse(value, name, expected);
    }
    return py::bool_(py::reinterpret_borrow<py::object>(value));
}

inline std::optional<Blend> to_blend(py::handle value) {
    if (value.is_none()) return std::nullopt;
    if (!py::isinstance<py::str>(value)) refuse(value, "blend", "the name of a mode or None");
    return parse_blend(value.cast<std::string>());
}

inline BlendLike from_blend(const std::optional<Blend>& blend) {
    return blend ? py::object(py::str(std::string(to_string(*blend)))) : py::none();
}

inline std::optional<bool> to_depth_write(py::handle value) {
    if (value.is_none()) return std::nullopt;
    return to_bool(value, "depth_write", "True, False or None");
}

inline glm::bvec4 to_color_write(py::handle value) {
    constexpr const char* expected = "a bool or four (red, green, blue, alpha)";
    if (py::isinstance<py::str>(value) || !py::isinstance<py::sequence>(value)) {
        return glm::bvec4(to_bool(value, "color_write", expected));
    }
    if (py::len(value) != 4) {
        throw py::value_error(std::string("color_write: expected ") + expected + ", got " +
                              std::to_string(py::len(value)) + " values");
    }
    glm::bvec4 write;
    for (int i = 0; i < 4; ++i) write[i] = to_bool(value[py::int_(i)], "color_write", expected);
    return write;
}

inline py::tuple from_color_write(const glm::bvec4& write) {
    return py::make_tuple(bool(write.r), bool(write.g), bool(write.b), bool(write.a));
}

/// Defines `__init__`: a material's own arguments, from which `make` makes its kind, then what
/// every material has.
template <class Kind, class... Own, class... Named>
void def_init(Class<MaterialOf<Kind>, Material>& made, Kind (*make)(Own...),
              const Named&... named) {
    made.def(py::init([make](Own... own, float opacity, bool double_sided, const BlendLike& blend,
                             const DepthWriteLike& depth_write, bool depth_test,
                             const ColorWriteLike& color_write, const OrNone<Stencil>& stencil) {
                 return std::make_shared<MaterialOf<Kind>>(
                     make(own...),
                     SurfaceOptions{opacity, double_sided, to_blend(blend),
                                    to_depth_write(depth_write), depth_test,
                                    to_color_write(color_write), to_stencil(stencil)});
             }),
             named..., py::kw_only(), py::arg("opacity") = 1.0F, py::arg("double_sided") = false,
             py::arg("blend") = py::none(), py::arg("depth_write") = py::none(),
             py::arg("depth_test") = true, py::arg("color_write") = true,
             py::arg("stencil") = py::none());
}

/// The same by name, for pickling.
inline py::dict surface_state(py::handle material) {
    py::dict state;
    for (const char* name : {"opacity", "double_sided", "blend", "depth_write", "depth_test",
                             "color_write", "stencil"}) {
        state[name] = material.attr(name);
    }
    return state;
}

/// The same as properties, on the base of all materials.
void bind_surface_options(Class<Material>& material);

}  // namespace cubecam::bindings
