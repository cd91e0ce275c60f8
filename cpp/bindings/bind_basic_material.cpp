// cubecam.BasicMaterial
#include "material_kind.hpp"

#include "cubecam/materials/basic.hpp"

namespace cubecam::bindings {

namespace {

constexpr const char* basic_doc =
    R"doc(Unlit: color * map * vertex colour * cubemap.

Parameters
----------
color : array_like (3,) or (4,), or str
    Linear RGB or RGBA; a CSS name or "#rrggbb" is sRGB and is decoded.
map : Image, array_like (H, W, C) or RenderTexture, optional
    A picture, placed by the mesh's uvs.
cubemap : CubeMap or Probe, optional
    A cubemap that is looked up in the direction of the object-space position, so that a box or a
    sphere shows all of it, and turns it when it turns. The alpha of the cubemap does not count.
vertex_colors : bool
    Whether the mesh's colours multiply color.
opacity, double_sided, blend, depth_write, depth_test, color_write, stencil, flat_shading, name
    The options of every `Material`.

Raises
------
ValueError
    For a value out of its range or not finite.
TypeError
    For a map or cubemap of another type.

Examples
--------
>>> import cubecam as cc
>>> cc.BasicMaterial(color=(1, 0, 0, .5))
BasicMaterial(color=(1, 0, 0, 0.5))
)doc";

const MaterialBinding basic(Basic::name, [](py::module_& module) {
    bind_material_kind<Basic>(module, basic_doc);
});

}  // namespace

}  // namespace cubecam::bindings
