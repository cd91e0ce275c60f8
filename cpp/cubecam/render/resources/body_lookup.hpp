#pragma once

#include <glad/gl.h>
#include <glm/glm.hpp>

namespace cubecam {

/// The inner side of a mesh, as surfaces look it up through which light goes to its far side
/// (passes/body_pass.hpp makes it, shaders/include/body.glsl reads it).
///
/// Its space is that of the mesh, moved and scaled along the axes so that the mesh fills the cube
/// from -1 to 1: a flat body fills as many texels as a ball.
struct BodyLookup {
    GLuint nearness = 0;     ///< red: 1 / z of the nearest backs of surfaces, green: of the fronts
    GLuint normals = 0;      ///< a layer for each of them, the second one only if `outside`
    glm::vec3 middle{0.0F};  ///< of the mesh's bounds, in its own space
    glm::vec3 half{1.0F};    ///< of their extent
    bool outside = false;    ///< the middle is not in the body, as that of a ring
};

inline constexpr int body_size = 128;  ///< texels along an edge of a face
/// The faces have a border of one texel and lie in three columns and two rows.
inline constexpr int body_width = 3 * (body_size + 2);
inline constexpr int body_height = 2 * (body_size + 2);

}  // namespace cubecam
