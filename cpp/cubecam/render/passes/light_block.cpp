#include "cubecam/render/passes/light_block.hpp"

#include "cubecam/math/transform.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <variant>

namespace cubecam {
namespace {

/// Encodes how a spot light fades towards its edge: dot(cone.xyz, travel) + cone.w is 0 at the edge
/// and 1 where the penumbra ends.
glm::vec4 cone_of(const SpotParameters& spot) {
    const double edge = std::cos(radians(spot.angle));
    const double full = std::cos(radians(spot.angle * (1.0 - spot.penumbra)));
    const double steepness = 1.0 / std::max(full - edge, 1e-6);  // without a penumbra: a step
    return {spot.direction * steepness, -edge * steepness};
}

/// Place and range of a light: w is 1 without a range, otherwise -1 / range.
glm::vec4 place_of(ShaderLights& to, const glm::dvec3& place, double range) {
    if (range == no_range) return glm::vec4(place, 1.0F);
    to.range = true;
    return glm::vec4(place, -1.0 / range);
}

void add(ShaderLights& to, const LightValue& light, const glm::dvec3& origin) {
    const glm::vec3 color = light.color * light.intensity;
    if (std::holds_alternative<AmbientParameters>(light.parameters)) {
        to.ambient += color;
        return;
    }
    if (to.count == max_lights) {
        throw std::invalid_argument("lights: expected at most " + std::to_string(max_lights) +
                                    " lights beside ambient ones");
    }
    LightsBlock::Light& block = to.block.lights[to.count++];
    if (const auto* point = std::get_if<PointParameters>(&light.parameters)) {
        block.position = place_of(to, point->position - origin, point->range);
        block.color = glm::vec4(color, point->decay);
        to.decay = to.decay || point->decay != 0.0;
    } else if (const auto* spot = std::get_if<SpotParameters>(&light.parameters)) {
        block.position = place_of(to, spot->position - origin, spot->range);
        block.color = glm::vec4(color, spot->decay);
        block.cone = cone_of(*spot);
        to.decay = to.decay || spot->decay != 0.0;
        to.cone = true;
    } else {
        const auto& sun = std::get<DirectionalParameters>(light.parameters);
        block.position = glm::vec4(-sun.direction, 0.0F);
        block.color = glm::vec4(color, 0.0F);
    }
}

}  // namespace

ShaderLights make_shader_lights(std::span<const LightSnapshot> lights, const glm::dvec3& origin) {
    ShaderLights made;
    // Lights with a shadow come first, so that a shader knows them when it is compiled. The order
    // must not depend on whether a drawn node receives shadows: sums of floats depend on the order.
    for (const LightSnapshot& light : lights) {
        if (light.value.shadow) add(made, light.value, origin);
    }
    made.shadow_count = made.count;
    for (const LightSnapshot& light : lights) {
        if (!light.value.shadow) add(made, light.value, origin);
    }
    made.block.counts.x = static_cast<int>(made.count);
    made.block.ambient = glm::vec4(made.ambient, 1.0F);
    return made;
}

}  // namespace cubecam
