/// Docstrings of cubecam.Image.
#pragma once

namespace cubecam::docs {

inline constexpr const char* image =
    R"doc(A picture that a material shows. It never changes.

`StandardMaterial` decodes 8-bit pictures in its maps of colours. All other materials compute with the
numbers as they are (uint8 as value/255): for these, under lights, decode an 8-bit photograph with
``load_image(path, srgb=True)`` first; see docs/conventions.md, "Encoding".

Parameters
----------
pixels : array_like (H, W, C)
    1 (grey), 3 (RGB) or 4 (RGBA) channels, row 0 on top. uint8, float16 or float32 is kept, float64
    becomes float32. uv (0, 0) is the bottom-left corner.
mipmaps : bool
    True: lookups are trilinear, for pictures that appear small. False: lookups are bilinear.
wrap : {"repeat", "clamp", "mirror"} or a pair of these
    What lookups outside 0..1 return, along both axes or along u and v: "repeat" repeats the picture, "clamp"
    its border, "mirror" repeats it with every other copy mirrored.
encoding : {"linear", "srgb"}, optional
    What the numbers are: how pictures of it are saved and shown, and whether a map of colours of
    `StandardMaterial` decodes its 8-bit numbers. None: that of the Frame or Image given as `pixels`; for an
    array, "srgb" for uint8, else "linear".
mag_filter : {"linear", "nearest"}
    What a lookup takes where a texel is larger than a pixel: a mix of four texels, or the nearest one.
min_filter : {"linear", "nearest", "linear_mipmap_linear", "linear_mipmap_nearest", "nearest_mipmap_linear", \
"nearest_mipmap_nearest"}, optional
    The same where a texel is smaller than a pixel. The last four use mip levels: the first word says how a
    level is looked up, the last one whether two levels are mixed. None: "linear_mipmap_linear" with
    `mipmaps`, else "linear".

Raises
------
TypeError
    For pixels of another type.
ValueError
    For another shape, an image without pixels, NaN, another name, or `mipmaps` with a `min_filter` that uses
    no levels.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> checks = np.indices((8, 8)).sum(axis=0)[..., None] % 2 * np.uint8(255)
>>> image = cc.Image(checks.astype(np.uint8), wrap="clamp")
>>> image.size, image.channels, image.dtype, image.encoding
((8, 8), 1, dtype('uint8'), 'srgb')
)doc";

}  // namespace cubecam::docs
