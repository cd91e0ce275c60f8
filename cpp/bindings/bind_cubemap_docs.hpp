/// Docstrings of CubeMap and Face, apart from the code that they would drown.
#pragma once

namespace cubecam::docs {

inline constexpr const char* face = R"doc(The six faces of a cube, in the order of every array here.

As integers, 0 to 5: ``cube.faces[cc.Face.POS_Y]``. Axes and orientation are OpenGL's (OpenGL 4.6,
section 8.13), drawn in docs/conventions.md.)doc";

inline constexpr const char* cubemap = R"doc(Six square pictures that surround a point.

Memory is always laid out as OpenGL's cube maps are: ``faces[f, row, col]`` is the texel with
``s = (col + .5)/N`` and ``t = (row + .5)/N`` on face `f` of +X -X +Y -Y +Z -Z (OpenGL 4.6, section
8.13; docs/conventions.md). Safe to share between threads; compared by contents.

Parameters
----------
faces : array_like (6, N, N, C), or six of (N, N, C)
    C is 1, 3 or 4. uint8 (which stands for value/255), float16 or float32 are kept; float64 becomes
    float32. Linear, raw numbers. NaN is refused; inf is kept, and lookups near it give inf or NaN, as
    on the GPU.
convention : {"gl", "inside", "three"}, default "gl"
    How `faces` are given: "gl" as above; "inside" as one sees them from the middle (OpenEXR); "three"
    as three.js and D3D skybox files have them.
mipmaps : bool, default False
    Lookups, here and on the GPU, are trilinear over box-filtered levels.

Raises
------
ValueError
    Faces that are not square or not alike, another number of channels, NaN, an unknown convention.
TypeError
    bool, complex, text, or integers other than uint8.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cube = cc.CubeMap(np.full((6, 8, 8, 3), 0.5, np.float32))
>>> cube
CubeMap(size=8, channels=3, dtype=float32, mipmaps=False)
>>> cube.sample([0, 1, 0])
array([0.5, 0.5, 0.5], dtype=float32)
)doc";

inline constexpr const char* faces = R"doc(Pixels, ndarray (6, N, N, C) in `dtype`, "gl" layout.

A read-only view that outlives the cube, and keeps its values when the cube changes.)doc";

inline constexpr const char* sample = R"doc(Look directions up, seamlessly and bilinearly.

The same numbers as GLSL ``textureLod`` with GL_LINEAR and GL_TEXTURE_CUBE_MAP_SEAMLESS (OpenGL 4.6,
section 8.14): texels beyond an edge are the neighbour's, the missing fourth of a corner is the average of
the other three.

Parameters
----------
directions : array_like (..., 3)
    World axes, from the center of the cube outwards, of any length but 0.
lod : float or array_like (...,), default 0
    Level of detail: 0 is `faces`, each further level has half the size. Other than 0 only with
    ``mipmaps=True``, trilinear, clamped to the levels there are.

Returns
-------
ndarray (..., C) float32
    Yours to write. uint8 as value/255.

Raises
------
ValueError
    A direction that is not finite or has length 0; `lod` without mipmaps or of another shape.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> faces = np.arange(6, dtype=np.float32).reshape(6, 1, 1, 1).repeat(4, 1).repeat(4, 2)
>>> cube = cc.CubeMap(faces)
>>> cube.sample([[1, 0, 0], [0, -1, 0], [1, 0, 1]]).ravel()
array([0., 3., 2.], dtype=float32)
)doc";

inline constexpr const char* to_equirect = R"doc(The panorama that this cube holds.

Unmirrored, row 0 at +Y. Filtered over each texel's footprint, so that shrinking does not alias;
enlarging is bilinear and seamless.

Parameters
----------
width : int, optional
    Even; 4 * size by default, which keeps the resolution.
center : {"-z", "+z", "+x", "-x"}, default "-z"
    The axis at the center: "-z" camera forward; "+z" OpenEXR, Mitsuba; "+x" three.js.
sampling : {"centers", "borders"}, default "centers"
    Where samples lie. "borders": the first and last row and column lie on the edges, as in
    OpenEXR's latitude-longitude maps.
dtype : dtype, optional
    "uint8", "float16" or "float32", as numpy takes it. None: the cube's.

Returns
-------
ndarray (width / 2, width, C) in `dtype`
    Yours to write. Filtered in float32, with uint8 as value/255, then rounded to nearest; uint8 holds
    0 to 1, and what lies outside becomes 0 or 255; float16 holds up to 65504, and what is more
    becomes inf.

Raises
------
ValueError
    A width that is not even and positive, an unknown center or sampling, another dtype.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> panorama = cc.CubeMap(np.ones((6, 16, 16, 4), np.float16)).to_equirect(center="+z")
>>> panorama.shape, panorama.dtype.name
((32, 64, 4), 'float16')
)doc";

inline constexpr const char* from_equirect = R"doc(A cube from a panorama.

Filtered over each texel's footprint: shrinking does not alias, round the poles whole rows are
averaged; enlarging is bilinear, wraps round and goes on over the poles.

Parameters
----------
image : array_like (H, 2H, C)
    uint8 (value/255), float16, float32 or float64; unmirrored, row 0 at +Y. NaN is refused; inf
    counts as the largest other number in it, at least 65504.
size : int, optional
    Of a face; by default the next power of two from W / pi, which loses nothing.
center : {"-z", "+z", "+x", "-x"}, default "-z"
    The axis at the center column.
sampling : {"centers", "borders"}, default "centers"
    Where the samples of `image` lie; with "borders" (OpenEXR) any shape from (2, 2) will do.
mipmaps : bool, default False
    Of the new cube.
dtype : dtype, optional
    "uint8", "float16" or "float32", as numpy takes it. None: that of `image`.

Returns
-------
CubeMap
    In `dtype`, rounded as `to_equirect` does.

Raises
------
ValueError
    An image that is not twice as wide as high, NaN, a size below 1, an unknown center or sampling,
    another dtype.
TypeError
    An image of bool, complex, text, or integers other than uint8.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cc.CubeMap.from_equirect(np.zeros((64, 128, 3), np.uint8))
CubeMap(size=64, channels=3, dtype=uint8, mipmaps=False)
)doc";

inline constexpr const char* set_face = R"doc(Replace one face.

Only this face is uploaded again, and nothing when it is the same.

Parameters
----------
face : Face, int from 0 to 5, or str
    "+x", "px", "pos_x", ... as `convention` calls it.
pixels : array_like (N, N, C)
    Of the cube's size, channels and dtype.
convention : {"gl", "inside", "three"}, default "gl"
    How `pixels` and `face` are meant.

Raises
------
ValueError
    Another shape, NaN, an unknown face.
TypeError
    Another dtype (float64 is taken for float32).
IndexError
    A number outside 0 to 5.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cube = cc.CubeMap(np.zeros((6, 2, 2, 1), np.uint8))
>>> cube.set_face("+y", np.full((2, 2, 1), 255, np.uint8))
>>> cube.sample([0, 1, 0])
array([1.], dtype=float32)
)doc";

inline constexpr const char* to_convention = R"doc(The six faces in another convention.

Parameters
----------
convention : {"gl", "inside", "three"}

Returns
-------
ndarray (6, N, N, C) in `dtype`
    A copy, yours to write. ``CubeMap(array, convention=convention)`` gives this cube
    back exactly.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cube = cc.CubeMap(np.random.default_rng(1).random((6, 4, 4, 3)).astype("float32"))
>>> cc.CubeMap(cube.to_convention("three"), convention="three") == cube
True
)doc";

inline constexpr const char* to_layout = R"doc(One picture of all faces.

Parameters
----------
layout : {"cross", "vertical_cross", "row", "column", "equirect", "openexr"}, default "cross"
    "cross" (or "horizontal_cross") is 4N x 3N with -X, the second cell, +X and the last from left to
    right, +Y above and -Y below the second; "vertical_cross" is 3N x 4N with the last one below -Y,
    turned by 180 degrees. "row" and "column" are in order of the faces. "equirect" is
    ``to_equirect()``. "openexr" is OpenEXR's cube: a column of "inside" faces whose samples lie on the
    borders, resampled.
convention : {"gl", "inside", "three"}, default "gl"
    Of the faces in it; the second cell is +Z, for "inside" -Z. Not looked at for "equirect" and
    "openexr", which have their own.
dtype : dtype, optional
    "uint8", "float16" or "float32", as numpy takes it. None: the cube's.

Returns
-------
ndarray (H, W, C) in `dtype`
    Yours to write; cells without a face are 0. In another dtype than the cube's, and where resampled,
    numbers are rounded as `to_equirect` does.

Raises
------
ValueError
    An unknown layout or convention, or another dtype.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)).to_layout("cross", convention="inside").shape
(24, 32, 3)
)doc";

inline constexpr const char* from_layout =
    R"doc(A cube from one picture of all faces, the inverse of `to_layout`.

Parameters
----------
image : array_like (H, W, C)
layout : str, optional
    As in `to_layout`. By default what the shape says: width to height of 4:3 cross, 3:4
    vertical_cross, 6:1 row, 1:6 column, 2:1 equirect. Shape never tells the convention.
convention : {"gl", "inside", "three"}, default "gl"
    Of the faces in `image`.
size, center
    As in `from_equirect`, for "equirect" only.
mipmaps : bool, default False
    Of the new cube.
dtype : dtype, optional
    "uint8", "float16" or "float32", as numpy takes it. None: that of `image`.

Returns
-------
CubeMap
    In `dtype`, rounded as `to_equirect` does.

Raises
------
ValueError
    A shape that is none of these, or not that of `layout`.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cc.CubeMap.from_layout(np.zeros((24, 32, 3), np.uint8))
CubeMap(size=8, channels=3, dtype=uint8, mipmaps=False)
)doc";

inline constexpr const char* resize = R"doc(The same cube with faces of another size.

Parameters
----------
size : int
    Texels along an edge. Shrinking averages the area of each texel; enlarging is bilinear and
    seamless.
dtype : dtype, optional
    "uint8", "float16" or "float32", as numpy takes it. None: the cube's.

Returns
-------
CubeMap
    In `dtype`, rounded as `to_equirect` does, with the same mipmaps, without captured outputs.

Raises
------
ValueError
    A size below 1, or another dtype.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)).resize(2).faces.shape
(6, 2, 2, 3)
)doc";

inline constexpr const char* outputs =
    R"doc(dict of str to ndarray: what a capture holds besides `faces`, by name. Read-only arrays.

Beside the attributes' arrays it holds those that a ``ShaderMaterial`` declares, `out vec4 heat;`,
float32 (6, N, N, 4), with fewer channels for vec3 and vec2 and (6, N, N) for float; 0 where the node
that is seen does not write them.
)doc";

}  // namespace cubecam::docs
