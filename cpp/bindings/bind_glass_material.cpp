// cubecam.GlassMaterial
#include "material_kind.hpp"

#include "cubecam/materials/glass.hpp"

namespace cubecam::bindings {

namespace {

constexpr const char* glass_doc =
    R"doc(Glass: F * environment(R) + (1 - F) * tint * environment(T).

R is the reflected direction, and T the refracted direction of GLSL's ``refract``, for a single surface.
F is Fresnel's reflectance of a dielectric for unpolarised light: the mean of both polarisations
(M. Born and E. Wolf, "Principles of Optics", section 1.5.2). Where there is no T, F is 1.

Parameters
----------
ior : float
    The index of refraction inside divided by that outside, above 0. 1.5 is glass in air, 1.33 water in
    air, 1/1.33 a bubble of air in water. GLSL's ``refract`` takes the inverse, eta.
fresnel : bool
    False: F is 0, and only T shows.
tint : array_like (3,) or (4,), or str
    Linear RGB or RGBA that multiplies the refracted light; a CSS name or "#rrggbb" is sRGB and is decoded.
roughness : float
    From 0, clear, to 1, frosted. A rough surface sees the environment filtered by roughness
    (`CubeMap.prefilter`): round R, moved towards the normal (S. Lagarde and C. de Rousiers, "Moving
    Frostbite to Physically Based Rendering", 2014), and round T for roughness * (2 max(ior, 1/ior) - 2),
    at most roughness. F stays that of a smooth surface.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
    The options of every `Material`.

Raises
------
ValueError
    For a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> water = cc.GlassMaterial(ior=1.33, tint=(.8, .9, 1))
>>> water
GlassMaterial(ior=1.33, tint=(0.8, 0.9, 1, 1))
)doc";

const MaterialBinding glass(Glass::name, [](py::module_& module) {
    bind_material_kind<Glass>(module, glass_doc);
});

}  // namespace

}  // namespace cubecam::bindings
