#include "cubecam/materials/material.hpp"

#include "cubecam/core/checks.hpp"

#include <utility>

namespace cubecam {

void check(const MaterialValue& value) {
    const float opacity = value.surface.opacity;
    if (!(opacity >= 0.0F && opacity <= 1.0F)) {
        expect(false, "opacity from 0 to 1", describe(opacity));
    }
}

Material::Material(MaterialValue value) : value_((cubecam::check(value), std::move(value))) {}

bool translucent(const MaterialValue& value) {
    return value.surface.opacity * value.traits().alpha < 1.0F;
}

}  // namespace cubecam
