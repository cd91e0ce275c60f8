/// Docstrings of cubecam.Texture.
#pragma once

namespace cubecam::docs {

inline constexpr const char* texture =
    R"doc(A picture with its place on a surface, for materials that have several maps.

A map of `StandardMaterial` is looked up at ``offset + R @ (scale * (u, v))``, where R turns by `rotation`. A
picture that lies by the mesh's uvs as they are needs no Texture. A Texture never changes; two are equal if
they have the same picture and equal numbers.

Parameters
----------
source : Image, array_like (H, W, C) or RenderTexture
    The picture; an array becomes an Image. In a map of colours, 8-bit pixels are sRGB, as in glTF, unless the
    Image says ``encoding="linear"``; they are decoded before they are filtered. In any other map the numbers
    count as they are.
uv_set : {0, 1}
    The mesh's texture coordinates: 0 for `Mesh.uvs`, 1 for `Mesh.uvs1`.
offset : array_like (2,)
    What is added to (u, v) last; (0, 0) is the picture's bottom-left corner.
rotation : float
    The angle by which (u, v) is turned around (0, 0), in degrees, from u towards v. The picture appears turned
    the other way.
scale : array_like (2,)
    The factors of u and v; 2 shows the picture twice in a length.

Raises
------
ValueError
    For another `uv_set`, or numbers that are not finite.
TypeError
    For a source of another type.

Notes
-----
KHR_texture_transform of glTF 2.0, except that v points upwards here. A transform in a glTF file has the same
rotation and scale here, and the offset ``(x + sin(r) * sy, 1 - y - cos(r) * sy)``.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> checks = cc.Image(np.indices((8, 8)).sum(axis=0)[..., None] % 2 * np.float32(1))
>>> cc.Texture(checks, uv_set=1, scale=(4, 4))
Texture(Image(8 x 8, 1 channels, float32, linear), uv_set=1, scale=(4, 4))
)doc";

}  // namespace cubecam::docs
