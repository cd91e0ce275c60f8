/// Docstrings of cubecam.Image.
#pragma once

namespace cubecam::docs {

inline constexpr const char* image =
    R"doc(A picture that a material shows. It never changes.

Numbers are linear and raw (uint8 as value/255). Decode an 8-bit photograph with
``load_image(path, srgb=True)`` first.

Parameters
----------
pixels : array_like (H, W, C)
    1 (grey), 3 (RGB) or 4 (RGBA) channels, row 0 on top. uint8, float16 or float32 is kept, float64
    becomes float32. uv (0, 0) is the bottom-left corner.
mipmaps : bool
    True: lookups are trilinear, for pictures that appear small. False: lookups are bilinear.
wrap : {"repeat", "clamp"}
    What lookups outside 0..1 return: "repeat" repeats the picture, "clamp" its border.

Raises
------
TypeError
    For pixels of another type.
ValueError
    For another shape, an image without pixels, NaN, or another `wrap`.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> checks = np.indices((8, 8)).sum(axis=0)[..., None] % 2 * np.uint8(255)
>>> image = cc.Image(checks.astype(np.uint8), wrap="clamp")
>>> image.size, image.channels, image.dtype
((8, 8), 1, dtype('uint8'))
)doc";

}  // namespace cubecam::docs
