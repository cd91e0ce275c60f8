/// The shadow of a light, from Python and back.
#pragma once

#include "numbers.hpp"
#include "objects.hpp"

#include "cubecam/scene/shadow.hpp"

#include <pybind11/pybind11.h>

#include <memory>
#include <optional>

namespace cubecam::bindings {

using ShadowLike = OneOf<Shadow, bool, py::none>;

/// None and False give no shadow; True gives the default shadow.
inline std::optional<Shadow> to_shadow(py::handle value) {
    if (value.is_none()) return std::nullopt;
    if (const auto cast = truth_value(value)) {
        return *cast ? std::optional(Shadow{}) : std::nullopt;
    }
    return *to_shared<Shadow>(value, "shadow", "a Shadow, True or None");
}

inline OrNone<Shadow> from_shadow(const std::optional<Shadow>& shadow) {
    return or_none(shadow ? std::make_shared<Shadow>(*shadow) : nullptr);
}

}  // namespace cubecam::bindings
