#pragma once

#include "cubecam/render/resources/view.hpp"

#include <glm/glm.hpp>

#include <cstddef>

namespace cubecam {

/// The data of a view for the shaders: a draw call has one record for each of its views, which
/// shaders read as vertex attributes that advance once for each instance
/// (shaders/include/view.glsl).
struct ViewRecord {
    glm::mat4 matrix;    ///< world to clip with depth reversed; for a skybox, see sky_rays.hpp
    glm::vec4 eye;       ///< xyz: eye, or the direction of all rays if w is 1 (parallel)
    glm::vec4 position;  ///< xyz: distance counts from here; w: parallel views' near plane
    glm::vec4 forward;   ///< xyz: the camera's axis; w: the layer
};

/// `matrix` becomes the record's matrix; positions count from `origin`.
ViewRecord make_view_record(const View& view, const glm::dmat4& matrix, const glm::dvec3& origin,
                            std::size_t layer);

/// Converts a matrix to GL's clip space into one with reversed depth in 0..1: near 1, far 0. It
/// uses double, where no precision is lost.
glm::dmat4 reverse_depth(glm::dmat4 to_clip);

}  // namespace cubecam
