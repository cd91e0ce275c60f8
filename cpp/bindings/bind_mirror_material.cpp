// cubecam.MirrorMaterial
#include "material_kind.hpp"

#include "cubecam/materials/mirror.hpp"

namespace cubecam::bindings {

namespace {

constexpr const char* mirror_doc =
    R"doc(A mirror: env_weight * tint * environment(R) + color_weight * color.

R = I - 2 (N.I) N with I from the eye to the surface, in world space. The environment is the node's:
the scene's, a CubeMap or a Probe.

Parameters
----------
tint : array_like (3,) or (4,), or str
    Linear RGB or RGBA, times what is reflected.
env_weight : float
    Weight of what is reflected, not negative.
color : array_like (3,) or (4,), or str
    Linear RGB or RGBA that the surface adds.
color_weight : float
    Its weight, not negative.
f0 : float, optional
    The reflectance seen head-on, from 0 to 1: env_weight is multiplied by
    f0 + (1 - f0) (1 - N.V)**5 (C. Schlick, "An Inexpensive BRDF Model for Physically-based
    Rendering", 1994). None: it is not.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
    As of every `Material`.

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
