#pragma once

#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <cstddef>
#include <span>

namespace cubecam {

/// The largest number of lights: their uniform block fits into the size that OpenGL guarantees.
inline constexpr std::size_t max_lights = 256;

/// The uniform block `Lights` of shaders/include/lights.glsl, std140.
struct LightsBlock {
    struct Light {
        glm::vec4 position;
        glm::vec4 color;
        glm::vec4 cone{0.0F, 0.0F, 0.0F, 1.0F};
    };

    glm::ivec4 counts{0};
    glm::vec4 ambient{0.0F};
    Light lights[max_lights];
};

/// The lights of a scene as shaders get them, and the properties that select a variant of a shader.
struct ShaderLights {
    LightsBlock block;
    glm::vec3 ambient{0.0F};       ///< the sum of all ambient lights
    std::size_t count = 0;         ///< how many other lights
    std::size_t shadow_count = 0;  ///< how many of these have a shadow; they come first
    bool decay = false;            ///< some light falls off
    bool cone = false;             ///< some light is a spot light
    bool range = false;            ///< some light has a range
};

/// `origin` is the origin of the shaders' positions.
/// @throws std::invalid_argument for more than max_lights.
ShaderLights make_shader_lights(std::span<const LightSnapshot> lights, const glm::dvec3& origin);

}  // namespace cubecam
