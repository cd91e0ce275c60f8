#pragma once

#include "cubecam/math/frustum.hpp"
#include "cubecam/math/rect.hpp"
#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <array>

namespace cubecam {

/// Which nodes a view can see, and where. Float arithmetic on the GPU may put a vertex a little
/// off: by how much at most is part of the answer. It is not small where large numbers cancel, as
/// for a mesh modelled a million units from its own origin.
class Culling {
public:
    explicit Culling(const View& view);

    /// Whether a node can show in the view's picture; see Frustum.
    bool may_show(const NodeSnapshot& node) const;

    /// A rectangle that holds every pixel of a picture of `width` x `height` that a node can touch.
    /// GL's rows: y grows upwards.
    Rect screen_bounds(const NodeSnapshot& node, int width, int height) const;

private:
    /// How far off, at most, a vertex may be in clip space.
    glm::dvec4 clip_error(const NodeSnapshot& node) const;

    glm::dmat4 view_projection_;
    glm::dvec3 position_;
    Frustum frustum_;
    std::array<glm::dvec4, 3> error_of_size_;  ///< clip error for a unit of size along each axis
    glm::dvec4 least_error_;
};

}  // namespace cubecam
