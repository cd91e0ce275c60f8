#pragma once

#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace cubecam {

/// How a light sees its casters: the views of its map's layers, and the numbers with which a lookup
/// finds a point in them.
struct ShadowView {
    enum class Kind { parallel = 0, single = 1, cube = 2 };  ///< as in shaders/include/shadows.glsl

    Kind kind = Kind::single;
    std::vector<View> views;  ///< one, or six in the order of a cube's faces
    /// World to the light's axes: x to the right and y up in its map, z away from it. For a cube
    /// they are the world's axes, with the light as origin.
    glm::dmat4 to_light;
    /// The map contains offset + scale * z if rays are parallel, otherwise offset + scale / z.
    double offset = 0.0;
    double scale = 0.0;
    double texels = 0.0;  ///< for one unit of x, or of x / z
    double near = 0.0;    ///< z of the nearest possible caster
};

/// Makes the view of a light that has a shadow; `scene` contains the casters.
ShadowView shadow_view(const LightValue& light, const SceneSnapshot& scene);

}  // namespace cubecam
