#pragma once

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

namespace cubecam {

/// How a scene shows its environment.
struct EnvironmentPlacing {
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};  ///< cube to world; w, x, y, z; unit length
    float intensity = 1.0F;                   ///< the factor of its light

    /// Whether the environment is shown as it is.
    bool is_plain() const { return *this == EnvironmentPlacing{}; }

    bool operator==(const EnvironmentPlacing&) const = default;
};

}  // namespace cubecam
