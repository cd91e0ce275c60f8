#pragma once

#include "cubecam/render/resources/view.hpp"

#include <glm/glm.hpp>

#include <cstddef>

namespace cubecam {

/// What the shaders know of a view: one record for each view that a draw call goes to, read as
/// vertex attributes that advance once an instance (shaders/include/view.glsl says what each
/// means).
struct ViewRecord {
    glm::mat4 matrix;    ///< world to clip with depth reversed; for a skybox, clip to world
    glm::vec4 eye;       ///< xyz: eye, or where w is 1 (parallel) the direction that every ray goes
    glm::vec4 position;  ///< xyz: where distance counts from; w: parallel views' near plane
    glm::vec4 forward;   ///< xyz: the camera's axis; w: the layer
};

/// `matrix` is what the record holds of it; positions count from `origin`.
ViewRecord make_view_record(const View& view, const glm::dmat4& matrix, const glm::dvec3& origin,
                            std::size_t layer);

/// GL's clip space with depth reversed and in 0..1: near 1, far 0. Done in double, where nothing is
/// lost.
glm::dmat4 reverse_depth(glm::dmat4 to_clip);

}  // namespace cubecam
