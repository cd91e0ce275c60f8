/// The options that every material takes by keyword, from Python and back.
#pragma once

#include "choice.hpp"
#include "objects.hpp"
#include "stencil.hpp"
#include "values.hpp"

#include "cubecam/materials/material.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace cubecam::bindings {

using BlendLike = OneOf<Choice<blend_names>, BlendFactors, py::none>;
using DepthWriteLike = OneOf<py::bool_, py::none>;
using ColorWriteLike = OneOf<py::bool_, py::typing::Tuple<bool, bool, bool, bool>>;

inline bool to_bool(py::handle value, const char* name, const char* expected) {
    if (const auto truth = truth_value(value)) return *truth;
    refuse(value, name, expected);
}

inline void set_blend(SurfaceOptions& surface, py::handle value) {
    std::optional<Blend> blend;
    BlendFactors factors;
    if (py::isinstance<BlendFactors>(value)) {
        blend = Blend::factors;
        factors = value.cast<const BlendFactors&>();
    } else if (py::isinstance<py::str>(value)) {
        blend = parse_blend(value.cast<std::string>());
    } else if (!value.is_none()) {
        refuse(value, "blend", "the name of a mode, a Blend or None");
    }
    surface.blend = blend;
    surface.blend_factors = factors;
}

inline BlendLike from_blend(const SurfaceOptions& surface) {
    if (!surface.blend) return py::none();
    if (*surface.blend == Blend::factors) {
        return py::cast(std::make_shared<BlendFactors>(surface.blend_factors));
    }
    return py::str(std::string(to_string(*surface.blend)));
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

/// Defines `__init__`: the arguments of a material's kind, from which `make` makes the kind, then
/// the options that every material has.
template <class Kind, class... Own, class... Named>
void def_init(Class<MaterialOf<Kind>, Material>& made, Kind (*make)(Own...),
              const Named&... named) {
    made.def(py::init([make](Own... own, Strict<float> opacity, Flag double_sided,
                             const BlendLike& blend, const DepthWriteLike& depth_write,
                             Flag depth_test, const ColorWriteLike& color_write,
                             const OrNone<Stencil>& stencil, Flag flat_shading, const Text& name) {
                 SurfaceOptions surface;
                 surface.opacity = opacity;
                 surface.double_sided = double_sided;
                 set_blend(surface, blend);
                 surface.depth_write = to_depth_write(depth_write);
                 surface.depth_test = depth_test;
                 surface.color_write = to_color_write(color_write);
                 surface.stencil = to_stencil(stencil);
                 surface.flat_shading = flat_shading;
                 auto material = std::make_shared<MaterialOf<Kind>>(make(own...), surface);
                 material->set_name(name);
                 return material;
             }),
             named..., py::arg("opacity") = 1.0F, py::arg("double_sided") = false,
             py::arg("blend") = py::none(), py::arg("depth_write") = py::none(),
             py::arg("depth_test") = true, py::arg("color_write") = true,
             py::arg("stencil") = py::none(), py::arg("flat_shading") = false,
             py::arg("name") = "");
}

/// The options of a material by name, for pickling.
inline py::dict surface_state(py::handle material) {
    py::dict state;
    state["name"] = material.attr("name");
    for (const char* name : {"opacity", "double_sided", "blend", "depth_write", "depth_test",
                             "color_write", "stencil", "flat_shading"}) {
        state[name] = material.attr(name);
    }
    return state;
}

/// Defines the options as properties of the base of all materials.
void bind_surface_options(Class<Material>& material);

}  // namespace cubecam::bindings
