#include "cubecam/scene/light.hpp"

#include "cubecam/core/checks.hpp"
#include "cubecam/scene/node.hpp"

#include <cmath>
#include <utility>

namespace cubecam {

namespace {

void check_range(double range) {
    if (!(range > 0.0 && (fits_float(range) || range == no_range))) {
        expect(false, "a range above 0, or infinity for none", describe(range));
    }
}

void check_parameters(PointParameters& p) {
    expect_finite(p.position, "position");
    expect_not_negative(p.decay, "decay");
    check_range(p.range);
}

void make_unit_length(glm::dvec3& direction) {
    expect_finite(direction, "direction");
    const double length = glm::length(direction);
    expect(length > 0.0, "a direction of some length", describe(direction));
    // A direction that already has unit length keeps all its bits: setting the colour of a light
    // must not turn it.
    if (std::abs(length - 1.0) > 1e-14) direction /= length;
}

void check_parameters(DirectionalParameters& p) { make_unit_length(p.direction); }

void check_parameters(SpotParameters& p) {
    expect_finite(p.position, "position");
    make_unit_length(p.direction);
    expect(p.angle > 0.0 && p.angle < 90.0, "an angle above 0 and below 90 degrees",
           describe(p.angle));
    expect(p.penumbra >= 0.0 && p.penumbra <= 1.0, "a penumbra from 0 to 1", describe(p.penumbra));
    expect_not_negative(p.decay, "decay");
    check_range(p.range);
}

void check_parameters(AmbientParameters&) {}

LightValue checked(LightValue value) {
    check(value);
    return value;
}

}  // namespace

LightParameters transformed(LightParameters parameters, const glm::dmat4& world) {
    std::visit(
        [&](auto& p) {
            if constexpr (requires { p.position; }) {
                p.position = glm::dvec3(world * glm::dvec4(p.position, 1.0));
            }
            if constexpr (requires { p.direction; }) {
                p.direction = glm::normalize(glm::dmat3(world) * p.direction);
            }
        },
        parameters);
    return parameters;
}

void check(LightValue& value) {
    const glm::vec3& color = value.color;
    expect(color.r >= 0.0F && color.g >= 0.0F && color.b >= 0.0F && fits_float(glm::dvec3(color)),
           "color finite and not negative", describe(glm::dvec3(color)));
    expect_not_negative(value.intensity, "intensity");
    std::visit([](auto& parameters) { check_parameters(parameters); }, value.parameters);
    if (!value.shadow) return;
    expect(!std::holds_alternative<AmbientParameters>(value.parameters),
           "a shadow for a light with a direction", "one for an ambient light");
    check(*value.shadow);
}

Light::Light(LightValue value) : value_(checked(std::move(value))) {}

LightParameters Light::world_parameters() const {
    LightValue value = this->value();
    const auto parent = value.parent.lock();
    return parent ? transformed(value.parameters, parent->world_matrix()) : value.parameters;
}

}  // namespace cubecam
