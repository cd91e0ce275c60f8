#pragma once

#include "cubecam/math/frustum.hpp"
#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <array>
#include <optional>

namespace cubecam {

/// What a part of a picture shows, in the space of a node's mesh.
struct PartFrustum {
    Frustum frustum;
    glm::dvec4 error;  ///< see Frustum::may_show
};

/// Finds which nodes a view can see, and where. The results allow for the largest error of float
/// arithmetic on the GPU, which is not small if large numbers cancel, as for a mesh that lies a
/// million units from its own origin.
class Culling {
public:
    explicit Culling(const View& view);

    /// Whether a node can be visible in the view's picture; see Frustum.
    bool may_show(const NodeSnapshot& node) const;

    /// Returns a rectangle that contains every pixel that a node can touch in a picture of `width`
    /// x `height`. As in GL, y grows upwards.
    Rect screen_bounds(const NodeSnapshot& node, int width, int height) const;

    /// The part of a node's mesh that can touch the pixels of a rectangle of such a picture.
    PartFrustum part_frustum(const NodeSnapshot& node, const Rect& rect, int width,
                             int height) const;

private:
    /// The largest error of a vertex in clip space.
    glm::dvec4 clip_error(const NodeSnapshot& node) const;

    glm::dmat4 view_projection_;
    glm::dvec3 position_;
    Frustum frustum_;
    std::optional<Plane> clip_;
    std::array<glm::dvec4, 3> error_of_size_;  ///< clip error for a unit of size along each axis
    glm::dvec4 least_error_;
};

}  // namespace cubecam
