/// Docstrings of cubecam's materials.
#pragma once

namespace cubecam::bindings {

inline constexpr const char* color_property_doc = "ndarray (4,) float32: linear RGBA, read-only.";
inline constexpr const char* map_property_doc =
    "Image, RenderTexture or None: times the colour, by the mesh's uvs. An array (H, W, C) becomes"
    " an Image.";
inline constexpr const char* vertex_colors_property_doc =
    "bool: whether the colour is multiplied by the mesh's vertex colours.";

inline constexpr const char* material_doc =
    R"doc(Base of the materials: how a surface answers light.

A material may be shared by any number of nodes; a change shows on all of them. Colours are 3 or 4
numbers, linear; a fourth, from 0 to 1, multiplies `opacity`. What is not fully
opaque is blended over what lies behind it.

Every material takes these by keyword, and has them as attributes:

======================  =========================================================================
opacity=1               from 0 to 1, times the alpha of the colours
double_sided=False      True shows both sides; False culls back faces
blend=None              how its colour S, of alpha a, joins what is there already, D:
                        "opaque": S, with alpha 1;
                        "alpha": a S + (1 - a) D, alpha a + (1 - a) D;
                        "alpha_keep": the same colour, alpha stays D's;
                        "additive": a S + D, alpha a + D;
                        "multiply": (1 - a + a S) D, alpha stays D's;
                        "premultiplied": S + (1 - a) D in all four channels, for maps whose colour
                        is multiplied by their alpha already; opacity and the colour's alpha
                        multiply both.
                        None: "alpha" where anything is translucent, else "opaque"
depth_write=None        whether it hides what is drawn later and is farther; None: if its blend is
                        "opaque"
depth_test=True         False is drawn over what is nearer as well
color_write=True        which channels are written: one bool, or four (red, green, blue, alpha)
stencil=None            a `Stencil`: how it tests and changes the stencil buffer, if there is one
======================  =========================================================================

What is blended, or writes no depth, is drawn after the background, far to near; it writes colour
and none of the other outputs.
)doc";

inline constexpr const char* basic_doc = R"doc(Unlit: color * map * vertex colour * cubemap.

Parameters
----------
color : array_like (3,) or (4,)
    Linear RGB or RGBA.
map : Image, array_like (H, W, C) or RenderTexture, optional
    A picture, placed by the mesh's uvs.
cubemap : CubeMap or Probe, optional
    Looked up in the direction of the object-space position, so that a box or sphere shows the
    whole of it and turns with it. Its alpha does not count.
vertex_colors : bool
    Whether the mesh's colours count.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
    As of every `Material`.

Raises
------
ValueError
    For a value out of its range or not finite.
TypeError
    For a map or cubemap of another type.

Examples
--------
>>> import cubecam as cc
>>> cc.BasicMaterial((1, 0, 0, .5))
BasicMaterial(color=(1, 0, 0, 0.5))
)doc";

inline constexpr const char* phong_doc = R"doc(Phong's reflection model.

ka * color, once, plus for every light: kd * color * max(N.L, 0), and ks * max(R.V, 0)**shininess
in white where N.L > 0 (B. T. Phong, "Illumination for Computer Generated Pictures", CACM 18(6),
1975). An `AmbientLight` adds its light times ka * color.

Parameters
----------
color : array_like (3,) or (4,)
    Linear RGB or RGBA.
ka, kd, ks : float
    Ambient, diffuse and specular weights, not negative.
shininess : float
    Above 0; greater is a smaller highlight.
map : Image, array_like (H, W, C) or RenderTexture, optional
    A picture that multiplies color, placed by the mesh's uvs.
vertex_colors : bool
    Whether the mesh's colours multiply color.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
    As of every `Material`.

Raises
------
ValueError
    For a value out of its range or not finite.
TypeError
    For a map of another type.

Examples
--------
>>> import cubecam as cc
>>> red = cc.PhongMaterial(color=(1, .4, .4))
>>> red.ka, red.kd, red.ks, red.shininess
(0.2, 0.7, 1.0, 10.0)
>>> red.kd = .5
>>> red
PhongMaterial(color=(1, 0.4, 0.4, 1), kd=0.5)
)doc";

inline constexpr const char* mirror_doc =
    R"doc(A mirror: env_weight * tint * environment(R) + color_weight * color.

R = I - 2 (N.I) N with I from the eye to the surface, in world space. The environment is the node's:
the scene's, a CubeMap or a Probe.

Parameters
----------
tint : array_like (3,) or (4,)
    Linear RGB or RGBA, times what is reflected.
env_weight : float
    Weight of what is reflected, not negative.
color : array_like (3,) or (4,)
    Linear RGB or RGBA that the surface adds.
color_weight : float
    Its weight, not negative.
fresnel : float, optional
    F0, the reflectance seen head-on, from 0 to 1: env_weight is multiplied by
    F0 + (1 - F0) (1 - N.V)**5 (C. Schlick, "An Inexpensive BRDF Model for Physically-based
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
>>> gold.env_weight, gold.fresnel
(0.78, None)
)doc";

inline constexpr const char* glass_doc =
    R"doc(Glass: F * environment(R) + (1 - F) * tint * environment(T).

R is the reflected direction, T the refracted one as GLSL's ``refract`` gives it, for one surface.
F is Fresnel's reflectance of a dielectric for unpolarised light, the mean of both polarisations
(M. Born and E. Wolf, "Principles of Optics", section 1.5.2); where there is no T all is reflected.

Parameters
----------
eta : float
    Refractive index outside divided by the one inside, above 0; 1/1.52 is air to window glass.
fresnel : bool
    False: T alone.
tint : array_like (3,) or (4,)
    Linear RGB or RGBA, times what is refracted.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil
    As of every `Material`.

Raises
------
ValueError
    For a value out of its range or not finite.

Examples
--------
>>> import cubecam as cc
>>> water = cc.GlassMaterial(eta=1 / 1.33, tint=(.8, .9, 1))
>>> water.fresnel
True
)doc";

}  // namespace cubecam::bindings
