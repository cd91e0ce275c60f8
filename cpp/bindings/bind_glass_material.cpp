// cubecam.GlassMaterial
#include "material_kind.hpp"

#include "cubecam/materials/glass.hpp"

namespace cubecam::bindings {

namespace {

constexpr const char* glass_doc =
    R"doc(Glass: F * environment(R) + (1 - F) * tint * environment(T).

R is the reflected direction, and T the refracted direction of GLSL's ``refract``: at a single surface,
or through both sides of the body. F is Fresnel's reflectance of a dielectric for unpolarised light: the
mean of both polarisations (M. Born and E. Wolf, "Principles of Optics", section 1.5.2). Where there is
no T, F is 1.

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
    at most roughness. F stays that of a smooth surface. With two surfaces, see the notes.
surfaces : int
    1: light is refracted where it enters, and the environment is looked up in this direction: right for
    the surface of water, and the fastest. 2: light goes on through the body, the mesh, is reflected
    totally inside or refracted again where it leaves, and the environment is looked up from there, with
    the parallax of a `Probe`.
dispersion : float
    How much red and blue part, as KHR_materials_dispersion defines it: 20 divided by the Abbe number, not
    negative. Red, green and blue have the indices ior - s, ior and ior + s, with
    s = (ior - 1) * 0.025 * dispersion; of an ior below 1, the inverses have. Each of them is followed.
attenuation_distance : float
    The way in the body, in world units, after which white light has `attenuation_color`, above 0, as
    KHR_materials_volume defines it; inf absorbs nothing. With ``surfaces=1`` there is no such way, and
    nothing is absorbed.
attenuation_color : array_like (3,), or str
    Linear RGB, from 0 to 1.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
    The options of every `Material`.

Raises
------
ValueError
    For a value out of its range or not finite.

Notes
-----
With ``surfaces=2`` a body should be closed, with triangles that are counter-clockwise seen from outside.
Each mesh has a small cube of its own inner side, as the middle of its bounds sees it; any number of nodes
share it, and it is made again when the vertices move. So a ray finds its way out of what the middle sees
directly: all of a ball, a box, a prism or an egg, of a ring, or of a bowl. From other parts, such as the
handle of a teapot, and out of open meshes, light does not find its way: it is looked up where it has got
to, as with ``surfaces=1``. So is what the back of a double-sided surface shows.

Light meets the inner side up to four times. If it is reflected totally the fourth time, it leaves the
body in that direction. What is reflected there in part is not followed: it is taken to be as bright as
what leaves the body. Light does not enter a body again that it has left, or another body inside. The tint
counts once.

A rough body spreads what passes like a mirror of the roughness r' with r'^4 = r^4 (2 v^2 + k ior^2),
v = (ior - 1) / 2, after k total reflections: facets that lean by a small angle d turn light by 2 d where
a mirror reflects it, by (ior - 1) d where it goes through a surface, and by 2 ior d where it is reflected
inside, and variances add up (L. Belcour, "Efficient Rendering of Layered Materials using an Atomic
Decomposition with Statistical Operators", 2018). Facets of the two sides are independent.

`cubecam.truth` follows rays through all surfaces of the scene, whatever `surfaces` says.

Examples
--------
>>> import cubecam as cc
>>> water = cc.GlassMaterial(ior=1.33, tint=(.8, .9, 1))
>>> water
GlassMaterial(ior=1.33, tint=(0.8, 0.9, 1, 1))
>>> bottle = cc.GlassMaterial(surfaces=2, attenuation_distance=.5, attenuation_color="seagreen")
)doc";

const MaterialBinding glass(Glass::name, [](py::module_& module) {
    bind_material_kind<Glass>(module, glass_doc);
});

}  // namespace

}  // namespace cubecam::bindings
