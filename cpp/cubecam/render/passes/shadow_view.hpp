#pragma once

#include "cubecam/render/resources/view.hpp"
#include "cubecam/scene/snapshot.hpp"

#include <glm/glm.hpp>

#include <vector>

namespace cubecam {

/// How a light sees what casts shadows: the views of its map's layers, and what a lookup needs to
/// find a point in them.
struct ShadowView {
    enum class Kind { parallel = 0, single = 1, cube = 2 };  ///< as in shaders/include/shadows.glsl

    Kind kind = Kind::single;
    std::vector<View> views;  ///< one, or six in the order of a cube's faces
    /// World to the light's axes: x to the right and y up in its map, z away from it. For a cube
    /// the world's own axes, counted from the light.
    glm::dmat4 to_light;
    /// What the map holds is offset + scale * z where rays are parallel, else offset + scale / z.
    double offset = 0.0;
    double scale = 0.0;
    double texels = 0.0;  ///< to a unit of x, or of x / z
    double near = 0.0;    ///< z of the nearest that casts
};

/// For a light that has a shadow. `scene` is asked for what casts.
ShadowView shadow_view(const LightValue& light, const SceneSnapshot& scene);

}  // namespace cubecam
