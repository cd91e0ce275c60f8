#include "cubecam/materials/material.hpp"

#include "cubecam/core/checks.hpp"

#include <utility>

namespace cubecam {

void check(const MaterialValue& value) { expect_share(value.surface.opacity, "opacity"); }

Material::Material(MaterialValue value) : value_((cubecam::check(value), std::move(value))) {}

bool translucent(const MaterialValue& value) {
    return value.surface.opacity * value.traits().alpha < 1.0F;
}

}  // namespace cubecam
