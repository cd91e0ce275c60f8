#include "cubecam/materials/material.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/core/revision.hpp"

#include <utility>

namespace cubecam {

void check(const MaterialValue& value) { expect_share(value.surface.opacity, "opacity"); }

Material::Material(MaterialValue value) : value_((cubecam::check(value), std::move(value))) {}

std::string Material::name() const {
    const std::lock_guard lock(name_guard_);
    return name_;
}

void Material::set_name(std::string name) {
    const std::lock_guard lock(name_guard_);
    if (name == name_) return;
    name_.swap(name);
    next_revision();  // what shows names looks at newest_revision()
}

bool translucent(const MaterialValue& value) {
    return value.surface.opacity * value.traits().alpha < 1.0F;
}

}  // namespace cubecam
