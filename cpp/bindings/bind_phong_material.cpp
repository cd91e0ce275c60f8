// cubecam.PhongMaterial
#include "material_kind.hpp"

#include "cubecam/materials/phong.hpp"

namespace cubecam::bindings {

namespace {

constexpr const char* phong_doc =
    R"doc(Phong's reflection model.

The colour is ka * color, plus, for every light, kd * color * max(N.L, 0) and, where N.L > 0, a white
highlight ks * max(R.V, 0)**shininess (B. T. Phong, "Illumination for Computer Generated Pictures",
CACM 18(6), 1975). An `AmbientLight` adds its light times ka * color.
Without a light ka * color is all that is left, a flat silhouette: an environment does not light it.

Parameters
----------
color : array_like (3,) or (4,), or str
    Linear RGB or RGBA; a CSS name or "#rrggbb" is sRGB and is decoded.
ka, kd, ks : float
    Ambient, diffuse and specular weights, not negative.
shininess : float
    Exponent of the highlight, above 0; a greater one makes a smaller highlight.
map : Image, array_like (H, W, C) or RenderTexture, optional
    A picture that multiplies color, placed by the mesh's uvs.
vertex_colors : bool
    Whether the mesh's colours multiply color.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
    The options of every `Material`.

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

const MaterialBinding phong(Phong::name, [](py::module_& module) {
    bind_material_kind<Phong>(module, phong_doc);
});

}  // namespace

}  // namespace cubecam::bindings
