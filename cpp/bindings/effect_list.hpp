/// Image effects, from a sequence in Python.
#pragma once

#include "objects.hpp"

#include "cubecam/scene/image_effect.hpp"

#include <pybind11/typing.h>

#include <memory>
#include <vector>

namespace cubecam::bindings {

using EffectsLike = OneOf<py::typing::Iterable<ImageEffect>>;

inline std::vector<std::shared_ptr<ImageEffect>> to_effects(py::handle effects) {
    if (py::isinstance<ImageEffect>(effects) || !py::isinstance<py::iterable>(effects)) {
        refuse(effects, "effects", "a sequence of ImageEffects");
    }
    std::vector<std::shared_ptr<ImageEffect>> objects;
    for (const py::handle effect : py::iter(effects)) {
        objects.push_back(to_shared<ImageEffect>(effect, "effects", "ImageEffects"));
    }
    return objects;
}

}  // namespace cubecam::bindings
