#pragma once

#include <glm/glm.hpp>

namespace cubecam {

/// What the shaders know of a view: one record for each view that a draw call goes to, read as
/// vertex attributes that advance once an instance (shaders/view.glsl says what each means).
struct Instance {
    glm::mat4 matrix;    ///< world to clip with depth reversed; for a skybox, clip to world
    glm::vec4 eye;       ///< xyz: eye, or where w is 1 (parallel) the direction that every ray goes
    glm::vec4 position;  ///< xyz: where distance counts from; w: parallel views' near plane
    glm::vec4 forward;   ///< xyz: the camera's axis; w: the layer
};

}  // namespace cubecam
