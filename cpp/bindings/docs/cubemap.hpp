/// Docstrings of cubecam.CubeMap and cubecam.Face.
#pragma once

namespace cubecam::docs {

inline constexpr const char* face = R"doc(The six faces of a cube, in the order of every array here.

A face is an integer from 0 to 5: ``cube.faces[cc.Face.POS_Y]``. Axes and orientation are those of OpenGL
4.6, section 8.13; docs/conventions.md has a drawing.)doc";

inline constexpr const char* cubemap = R"doc(Six square pictures that surround a point.

The memory always has the layout of OpenGL's cube maps: ``faces[f, row, col]`` is the texel with
``s = (col + .5)/N`` and ``t = (row + .5)/N`` on face `f` of +X -X +Y -Y +Z -Z (OpenGL 4.6, section
8.13; docs/conventions.md). Threads may share a cubemap. Cubemaps are compared by their contents.

Parameters
----------
faces : array_like (6, N, N, C), or six of (N, N, C)
    C is 1, 3 or 4. uint8 (which stands for value/255), float16 and float32 are kept; float64 becomes
    float32. NaN raises ValueError; inf is kept. Lookups and resampling
    give inf where an infinite texel has a weight, and no NaN beside it; the GPU may give NaN there.
convention : {"gl", "inside", "three"}, default "gl"
    The convention of `faces`: "gl" is the layout above; "inside" shows the faces as seen from the center
    of the cube (OpenEXR); "three" is that of three.js and D3D skybox files.
mipmaps : bool, default False
    True: lookups, here and on the GPU, are trilinear over box-filtered levels. False: they are bilinear.
encoding : {"linear", "srgb"}, optional
    What the numbers are: proportional to light, or encoded for a screen, as in 8-bit files. It changes no
    lookup, only how pictures of the cube are saved and shown (docs/conventions.md). None: that of the
    CubeMap given as `faces`; for an array, "srgb" for uint8, else "linear".

Raises
------
ValueError
    For faces that are not square or not of one shape, another number of channels, NaN, or an unknown
    convention or encoding.
TypeError
    For bool, complex, text, or integers other than uint8.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cube = cc.CubeMap(np.full((6, 8, 8, 3), 0.5, np.float32))
>>> cube
CubeMap(size=8, channels=3, dtype=float32, mipmaps=False, encoding='linear')
>>> cube.sample([0, 1, 0])
array([0.5, 0.5, 0.5], dtype=float32)
)doc";

inline constexpr const char* faces =
    R"doc(ndarray (6, N, N, C) in `dtype`: the pixels, in the convention "gl".

The array is a read-only view. It stays valid without the cube, and keeps its values when the cube changes. To change
texels, take a copy, ``cube.numpy(writable=True)``, and make a CubeMap of it, or give one face to `set_face`.)doc";

inline constexpr const char* sample = R"doc(Look up directions, bilinear and without seams.

The numbers are those of GLSL ``textureLod`` with GL_LINEAR and GL_TEXTURE_CUBE_MAP_SEAMLESS (OpenGL 4.6,
section 8.14): a texel beyond an edge is taken from the neighbouring face; the fourth texel at a corner, where
only three meet, is the average of these three.

Parameters
----------
directions : array_like (..., 3)
    Directions from the center of the cube outwards, in world axes, of any length except 0.
lod : float or array_like (...,), default 0
    Level of detail: 0 is `faces`, each further level has half the size. Levels other than 0 need
    ``mipmaps=True``; they are looked up trilinearly and clamped to the levels of the cube.

Returns
-------
ndarray (..., C) float32
    A new array; uint8 is looked up as value/255.

Raises
------
ValueError
    For a direction that is not finite or has length 0, a `lod` other than 0 without mipmaps, or a `lod`
    of another shape.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> faces = np.arange(6, dtype=np.float32).reshape(6, 1, 1, 1).repeat(4, 1).repeat(4, 2)
>>> cube = cc.CubeMap(faces)
>>> cube.sample([[1, 0, 0], [0, -1, 0], [1, 0, 1]]).ravel()
array([0., 3., 2.], dtype=float32)
)doc";

inline constexpr const char* to_equirect = R"doc(Make an equirectangular panorama of this cube.

The panorama is not mirrored; row 0 is at +Y. Each texel is filtered over its footprint, so that a smaller
panorama does not alias; a larger one is bilinear and has no seams.

Parameters
----------
width : int, optional
    Pixels of a row, an even number. None: 4 * size, which keeps the resolution.
center : {"-z", "+z", "+x", "-x"}, default "-z"
    The axis at the center: "-z" camera forward; "+z" OpenEXR, Mitsuba; "+x" three.js.
sampling : {"centers", "borders"}, default "centers"
    Where samples lie. "centers": in the middle of each texel. "borders": the first and last row and column
    lie on the edges, as in OpenEXR's latitude-longitude maps.
dtype : dtype, optional
    "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of the cube.

Returns
-------
ndarray (width / 2, width, C) in `dtype`
    A new array. Numbers are filtered in float32, with uint8 as value/255, then rounded to nearest. In uint8,
    numbers below 0 become 0 and numbers above 1 become 255; in float16, numbers above 65504 become inf.

Raises
------
ValueError
    For a width that is not even and positive, an unknown center or sampling, or another dtype.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> panorama = cc.CubeMap(np.ones((6, 16, 16, 4), np.float16)).to_equirect(center="+z")
>>> panorama.shape, panorama.dtype.name
((32, 64, 4), 'float16')
)doc";

inline constexpr const char* from_equirect = R"doc(Make a cube from an equirectangular panorama.

Each texel is filtered over its footprint, so that smaller faces do not alias; near the poles the footprint
covers whole rows. Larger faces are bilinear, across the seam and over the poles.

Parameters
----------
image : array_like (H, 2H, C)
    uint8 (value/255), float16, float32 or float64; not mirrored, row 0 at +Y. NaN raises ValueError; inf
    counts as the largest finite number of the image, or 65504 if that is more.
size : int, optional
    Texels along an edge of a face. None: the next power of two from W / pi, which loses no detail.
center : {"-z", "+z", "+x", "-x"}, default "-z"
    The axis at the center column.
sampling : {"centers", "borders"}, default "centers"
    Where the samples of `image` lie; with "borders" (OpenEXR) any shape from (2, 2) is allowed.
mipmaps : bool, default False
    Whether lookups in the new cube are trilinear.
dtype : dtype, optional
    "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of `image`.
encoding : {"linear", "srgb"}, optional
    What the numbers of `image` are, as in `CubeMap`.

Returns
-------
CubeMap
    The new cube in `dtype`, rounded as `to_equirect` rounds.

Raises
------
ValueError
    For an image that is not twice as wide as high, NaN, a size below 1, an unknown center or sampling, or
    another dtype.
TypeError
    For an image of bool, complex, text, or integers other than uint8.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cc.CubeMap.from_equirect(np.zeros((64, 128, 3), np.uint8))
CubeMap(size=64, channels=3, dtype=uint8, mipmaps=False, encoding='srgb')
)doc";

inline constexpr const char* set_face = R"doc(Replace one face.

Only this face is uploaded to the GPU again, and only if its pixels differ from the old ones.

Parameters
----------
face : Face, int from 0 to 5, or str
    The face, named in `convention`. A str is "+x", "px" or "pos_x", and so on.
pixels : array_like (N, N, C)
    The new pixels, in the cube's size, channels and dtype.
convention : {"gl", "inside", "three"}, default "gl"
    The convention of `pixels` and `face`.

Raises
------
ValueError
    For another shape, NaN, or an unknown face, or if `prefilter` made this cube: its levels would not belong to
    the new face. ``CubeMap(cube.faces)`` has no levels.
TypeError
    For another dtype (float64 counts as float32).
IndexError
    For a number outside 0 to 5.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cube = cc.CubeMap(np.zeros((6, 2, 2, 1), np.uint8))
>>> cube.set_face("+y", np.full((2, 2, 1), 255, np.uint8))
>>> cube.sample([0, 1, 0])
array([1.], dtype=float32)
)doc";

inline constexpr const char* to_convention = R"doc(Convert the six faces to another convention.

Parameters
----------
convention : {"gl", "inside", "three"}
    The convention of the result.

Returns
-------
ndarray (6, N, N, C) in `dtype`
    A copy. ``CubeMap(array, convention=convention)`` makes exactly this cube again.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cube = cc.CubeMap(np.random.default_rng(1).random((6, 4, 4, 3)).astype("float32"))
>>> cc.CubeMap(cube.to_convention("three"), convention="three") == cube
True
)doc";

inline constexpr const char* to_layout = R"doc(Arrange all faces in one picture.

Parameters
----------
layout : {"cross", "vertical_cross", "row", "column", "equirect", "openexr"}, default "cross"
    "cross" (or "horizontal_cross") is 4N x 3N. Its middle row is -X +Z +X -Z from left to right (-X -Z +X +Z
    for "inside"); +Y is above and -Y below the second cell. "vertical_cross" is 3N x 4N, with the last face of
    that row below -Y, turned by 180 degrees. "row" and "column" have the faces in their order. "equirect" is
    ``to_equirect()``. "openexr" is OpenEXR's cube: a column of "inside" faces, resampled so that their samples
    lie on the borders.
convention : {"gl", "inside", "three"}, default "gl"
    The convention of the faces in the picture. "equirect" and "openexr" ignore it.
dtype : dtype, optional
    "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of the cube.

Returns
-------
ndarray (H, W, C) in `dtype`
    A new array; cells without a face are 0. Numbers that change their dtype or are resampled are rounded as
    `to_equirect` rounds them.

Raises
------
ValueError
    For an unknown layout or convention, or another dtype.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)).to_layout("cross", convention="inside").shape
(24, 32, 3)
)doc";

inline constexpr const char* from_layout =
    R"doc(Make a cube from one picture of all faces: the inverse of `to_layout`.

Parameters
----------
image : array_like (H, W, C)
layout : str, optional
    A layout of `to_layout`. None: the layout follows from the shape; width to height of 4:3 is a cross, 3:4 a
    vertical_cross, 6:1 a row, 1:6 a column, 2:1 an equirect. The convention does not follow from the shape.
convention : {"gl", "inside", "three"}, default "gl"
    The convention of the faces in `image`.
size, center
    As in `from_equirect`, for "equirect" only.
mipmaps : bool, default False
    Whether lookups in the new cube are trilinear.
dtype : dtype, optional
    "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of `image`.
encoding : {"linear", "srgb"}, optional
    What the numbers of `image` are, as in `CubeMap`.

Returns
-------
CubeMap
    The new cube in `dtype`, rounded as `to_equirect` rounds.

Raises
------
ValueError
    For a shape of no layout, or a shape that `layout` does not have.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cc.CubeMap.from_layout(np.zeros((24, 32, 3), np.uint8))
CubeMap(size=8, channels=3, dtype=uint8, mipmaps=False, encoding='srgb')
)doc";

inline constexpr const char* resize = R"doc(Resample the faces to another size.

Parameters
----------
size : int
    Texels along an edge of the new faces. Smaller faces average the area of each texel; larger faces are
    bilinear and have no seams.
dtype : dtype, optional
    "uint8", "float16" or "float32", in any form that numpy reads as a dtype. None: that of the cube.

Returns
-------
CubeMap
    A new cube in `dtype`, rounded as `to_equirect` rounds, with the same `mipmaps` and `encoding`. Its outputs are
    the nearest texels of this cube's outputs.

Raises
------
ValueError
    For a size below 1, or another dtype.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cc.CubeMap(np.zeros((6, 8, 8, 3), np.uint8)).resize(2).faces.shape
(6, 2, 2, 3)
)doc";

inline constexpr const char* rotate = R"doc(Turn what this cube shows.

The result shows in the direction R d what this cube shows in d, as ``Scene.environment_rotation`` turns an
environment. ``renderer.capture(scene, rotation=q).rotate(q)`` shows the scene in the world's axes again.

Parameters
----------
rotation : array_like (4,)
    The quaternion (w, x, y, z) of R, of any length except 0, as `axis_angle` gives.

Returns
-------
CubeMap
    A new cube of the same size, dtype, `mipmaps`, `encoding` and `levels`. A rotation that brings axes to axes, such
    as a quarter turn, copies texels; others filter each texel over its footprint, and round as `to_equirect` does.
    Outputs are the nearest texels of this cube's outputs: normals and positions stay vectors of the scene's world,
    "z" is converted to the axes of the new faces, and "depth" stays as the capture drew it.

Raises
------
ValueError
    For a quaternion of length 0, another shape, or numbers that are not finite.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> cube = cc.CubeMap(np.arange(6, dtype=np.float32).reshape(6, 1, 1, 1))  # each face its number
>>> turned = cube.rotate(cc.axis_angle((0, 1, 0), 90))  # +Z goes to +X
>>> float(cube.sample([0, 0, 1])[0]), float(turned.sample([1, 0, 0])[0])
(4.0, 4.0)
)doc";

inline constexpr const char* sample_output =
    R"doc(Look up an output of a capture: its nearest texels.

Parameters
----------
directions : array_like (..., 3)
    Directions from the center of the cube outwards, in world axes, of any length except 0.
lod : float, default 0
    0; outputs have one level.
output : str, default "color"
    "color", or a name in `outputs`, such as "distance", "normal" or "id".

Returns
-------
ndarray (...) or (..., channels) in the output's dtype
    A new array. Each entry is the texel that the direction meets; no two are mixed.

Raises
------
ValueError
    For a direction that is not finite or has length 0, another `lod`, or an output that the cube does not have.
)doc";

inline constexpr const char* to_equirect_output = R"doc(Make a panorama of an output of a capture.

Outputs are not filtered, since a mixture of two distances or ids belongs to no surface: each pixel is the
texel that its direction meets.

Parameters
----------
width, center, sampling
    As for the colours.
dtype : None
    An output keeps its dtype.
output : str, default "color"
    "color", or a name in `outputs`. "distance" is the length of the ray, as panoramas of depth hold it. "z" and "depth"
    are measured along the axis of the face on which the direction lies. Normals and positions are world
    vectors.

Returns
-------
ndarray (width / 2, width) or (width / 2, width, channels) in the output's dtype
    A new array.

Raises
------
ValueError
    For a width that is not even and positive, an unknown center or sampling, a dtype, or an output that the
    cube does not have.

Examples
--------
>>> import cubecam as cc
>>> scene = cc.Scene()
>>> ball = scene.add(cc.Mesh.sphere(1), position=(0, 0, -4))
>>> with cc.Renderer() as renderer:
...     cube = renderer.capture(scene, size=64, outputs=("distance", "id"))
>>> distances = cube.to_equirect(output="distance")
>>> distances.shape, float(distances[0, 0])
((128, 256), inf)
>>> sorted(set(cube.to_equirect(output="id").ravel().tolist())) == [0, ball.id]
True
)doc";

inline constexpr const char* to_convention_output =
    R"doc(Convert the faces of an output to another convention.

Its texels move as those of the colours do. The numbers stay as they are: normals and positions are world vectors in
every convention.

Parameters
----------
convention : {"gl", "inside", "three"}
    The convention of the result.
output : str, default "color"
    "color", or a name in `outputs`.

Returns
-------
ndarray (6, N, N) or (6, N, N, channels) in the output's dtype
    A copy.

Raises
------
ValueError
    For an unknown convention, or an output that the cube does not have.
)doc";

inline constexpr const char* to_layout_output = R"doc(Arrange all faces of an output in one picture.

Its texels move as those of the colours do, and are never mixed, in "equirect" and "openexr", too.

Parameters
----------
layout, convention
    As for the colours.
dtype : None
    An output keeps its dtype.
output : str, default "color"
    "color", or a name in `outputs`.

Returns
-------
ndarray (H, W) or (H, W, channels) in the output's dtype
    A new array; cells without a face are 0.

Raises
------
ValueError
    For an unknown layout or convention, a dtype, or an output that the cube does not have.
)doc";

inline constexpr const char* outputs =
    R"doc(dict of str to ndarray: the outputs of a capture besides `faces`, by name. The arrays are read-only.

The dict holds the built-in outputs, which are attributes as well, and the outputs that a ``ShaderMaterial``
declares, such as `out vec4 heat;`: float32 (6, N, N, 4), with fewer channels for vec3 and vec2 and
(6, N, N) for float. A declared output is 0 where the visible node does not write it.
)doc";

}  // namespace cubecam::docs
