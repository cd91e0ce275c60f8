/// Docstrings of cubecam.Image.
#pragma once

namespace cubecam::docs {

inline constexpr const char* image =
    R"doc(A picture that a material shows. It never changes.

Materials compute with the numbers as they are (uint8 as value/255). Under lights, decode an 8-bit
photograph with ``load_image(path, srgb=True)`` first; see docs/conventions.md, "Encoding".

Parameters
----------
pixels : array_like (H, W, C)
    1 (grey), 3 (RGB) or 4 (RGBA) channels, row 0 on top. uint8, float16 or float32 is kept, float64
    becomes float32. uv (0, 0) is the bottom-left corner.
mipmaps : bool
    True: lookups are trilinear, for pictures that appear small. False: lookups are bilinear.
wrap : {"repeat", "clamp"}
    What lookups outside 0..1 return: "repeat" repeats the picture, "clamp" its border.
encoding : {"linear", "srgb"}, optional
    What the numbers are. It changes no lookup, only how pictures of it are saved and shown. None:
    that of the Frame or Image given as `pixels`; for an array, "srgb" for uint8, else "linear".

Raises
------
TypeError
    For pixels of another type.
ValueError
    For another shape, an image without pixels, NaN, or another `wrap` or `encoding`.

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
