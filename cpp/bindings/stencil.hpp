/// The stencil settings of a material, from Python and back.
#pragma once

#include "objects.hpp"

#include "cubecam/materials/stencil.hpp"

#include <memory>
#include <optional>

namespace cubecam::bindings {

inline std::optional<Stencil> to_stencil(py::handle value) {
    const auto given = to_shared_or_none<Stencil>(value, "stencil", "a Stencil or None");
    return given ? std::optional(*given) : std::nullopt;
}

inline OrNone<Stencil> from_stencil(const std::optional<Stencil>& stencil) {
    if (!stencil) return py::none();
    return py::cast(std::make_shared<Stencil>(*stencil));
}

}  // namespace cubecam::bindings
