// cubecam.MirrorMaterial
#include "material_kind.hpp"

#include "cubecam/materials/mirror.hpp"

namespace cubecam::bindings {

namespace {

constexpr const char* mirror_doc =
    R"doc(A mirror: env_weight * tint * environment(R) + color_weight * color.

R = I - 2 (N.I) N, where I points from the eye to the surface, in world space. The environment is that of
the node, a CubeMap or a Probe, or else that of the scene; without any, a mirror
reflects black.

Parameters
----------
tint : array_like (3,) or (4,), or str
    Linear RGB or RGBA that multiplies the reflected light; a CSS name or "#rrggbb" is sRGB and is decoded.
env_weight : float
    Weight of the reflected light, not negative.
color : array_like (3,) or (4,), or str
    Linear RGB or RGBA that the surface adds; a CSS name or "#rrggbb" is sRGB and is decoded.
color_weight : float
    Weight of color, not negative.
f0 : float, optional
    The reflectance seen head-on, from 0 to 1: env_weight is multiplied by
    f0 + (1 - f0) (1 - N.V)**5 (C. Schlick, "An Inexpensive BRDF Model for Physically-based
    Rendering", 1994). None: env_weight is the same at all angles.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
    The options of every `Material`.

Raises
------
ValueError
    For a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> gold = cc.MirrorMaterial(color=(.95, .85, .4), env_weight=.78, color_weight=.3)
>>> gold.env_weight, gold.f0
(0.78, None)
)doc";

const MaterialBinding mirror(Mirror::name, [](py::module_& module) {
    bind_material_kind<Mirror>(module, mirror_doc);
});

}  // namespace

}  // namespace cubecam::bindings
