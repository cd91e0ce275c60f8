#pragma once

#include "cubecam/scene/camera.hpp"

#include <glm/glm.hpp>

#include <optional>
#include <vector>

namespace cubecam {

/// What one picture is taken with; it goes to one layer of a target. A camera is one view, a
/// cubemap six.
struct View {
    glm::dmat4 view;             ///< world to camera
    glm::dmat4 view_projection;  ///< world to GL's clip space
    glm::dmat4 far_to_world;     ///< clip space to world, translation left out: what a skybox needs
    glm::dvec3 position;         ///< where distances count from and nodes are sorted by
    glm::dvec3 eye;              ///< where highlights and mirrors are seen from
    glm::dvec3 forward;          ///< unit vector along the camera's axis
    bool parallel = false;       ///< orthographic: every ray goes along `forward`
    double near = 0.0;  ///< parallel views only: where distance counts from, along the axis
};

View camera_view(const Matrices& matrices);

/// The six views of a cube in the order of its faces, 90 degrees each: GL's face table
/// (math/cube_face.hpp), so that a lookup by world direction needs no sign flip and row 0 of a face
/// is t = 0.
std::vector<View> cube_views(glm::dvec3 position, double near, double far,
                             std::optional<glm::dvec3> eye = std::nullopt);

}  // namespace cubecam
