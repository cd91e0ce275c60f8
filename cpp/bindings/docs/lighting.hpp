/// Docstrings of the methods of cubecam.CubeMap that filter its light.
#pragma once

namespace cubecam::docs {

inline constexpr const char* levels =
    R"doc(ndarray (6, M, M, C) in `dtype`, read-only, of each level, in a tuple: the filtered faces.

Level 0 is `faces`; level k holds the faces filtered for ``roughness[k]``, in the convention "gl". A cubemap that
`prefilter` did not make has one level. The levels of `mipmaps` are others, and `sample` looks those up.)doc";

inline constexpr const char* roughness =
    R"doc(ndarray (L,) float32, read-only: the roughness of each of `levels`, from 0 to 1.

A cubemap that `prefilter` did not make has one level, whose roughness is 0.)doc";

inline constexpr const char* prefilter =
    R"doc(Filter the light by roughness, as rough metal reflects it.

Level k holds, for each direction N, the mean radiance around N under the lobe of GGX for the roughness
``k / (levels - 1)``. The renderer uses the levels of a cubemap that has them; of other cubemaps it makes such levels
itself where a material needs them.

Parameters
----------
levels : int, default 6
    The number of levels with level 0, which is the cube itself, 2 to 64.
size : int, optional
    Texels along an edge of level 0. None: those of this cube; otherwise the cube is resampled first, as by `resize`.
progress : callable, optional
    A function that is called on this thread with the share that is done, from 0 to 1, about every 10 ms. If it raises,
    the work ends, and so it does with Ctrl-C.

Returns
-------
CubeMap
    A new cubemap with `levels` and `roughness`, of the same dtype, channels, `mipmaps` and `encoding`. The outputs of
    a capture are left out. `set_face` raises ValueError for it, since the levels would not belong to the new face;
    `resize` leaves the levels out, and so do files and `to_layout`. Copies, pickles and comparisons include the levels.

Raises
------
ValueError
    For a number of levels or a size outside its limits.
TypeError
    For numbers that are not whole, or a `progress` that cannot be called.

Notes
-----
The weight of the radiance from l is ``D(h) (N.l)`` with ``V = N`` and ``h = normalize(N + l)``, and the mean is
divided by the sum of weights (B. Karis, "Real Shading in Unreal Engine 4", 2013); D is that of glTF 2.0, appendix
B.3.2, with ``alpha = roughness^2``. All texels are summed, with their solid angles: there is no noise. Alpha is
filtered as a channel, and numbers are taken as they are, also with ``encoding="srgb"``.

The texels along an edge of a level are the power of two that is nearest, in ratio, to ``25.6 / roughness``, at least
32, and at most `size`: 128 at .2, 64 at .4, 32 from .6 on. Each texel is adjusted so that bilinear lookups, which
flatten peaks, are right on average: they differ from the sum over all texels of a 256 x 256 photograph by .3 % rms.

NaN counts as 0, infinity as 65504, the largest float16.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> faces = np.zeros((6, 64, 64, 3), np.float32)
>>> faces[cc.Face.POS_Y] = 1  # light from above
>>> cube = cc.CubeMap(faces).prefilter(levels=3)
>>> [level.shape for level in cube.levels]
[(6, 64, 64, 3), (6, 64, 64, 3), (6, 32, 32, 3)]
>>> cube.roughness.tolist()
[0.0, 0.5, 1.0]
>>> cc.CubeMap(cube.levels[2]).sample([0, 1, 0]).round(2)
array([0.55, 0.55, 0.55], dtype=float32)
)doc";

inline constexpr const char* irradiance =
    R"doc(Compute the diffuse light: the cosine-weighted mean around each direction.

Parameters
----------
size : int, default 32
    Texels along an edge of the result.
progress : callable, optional
    As in `prefilter`.

Returns
-------
CubeMap
    A new cubemap of the same dtype, channels, `mipmaps` and `encoding`. Its texel at N is
    ``(1/pi) * integral of radiance(l) max(N.l, 0) dl``, the irradiance divided by pi: what a white matt surface with the
    normal N sends to the eye. A constant cubemap stays as it is.

Raises
------
ValueError
    For a size below 1.
TypeError
    For a size that is not whole, or a `progress` that cannot be called.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> faces = np.zeros((6, 64, 64, 1), np.float32)
>>> faces[cc.Face.POS_Z] = 1
>>> diffuse = cc.CubeMap(faces).irradiance()
>>> diffuse.sample([[0, 0, 1], [1, 0, 0], [0, 0, -1]]).ravel().round(2)
array([0.55, 0.11, 0.  ], dtype=float32)
)doc";

inline constexpr const char* sh = R"doc(Project the light onto spherical harmonics.

Parameters
----------
order : int, default 2
    The highest order, 0 to 64.

Returns
-------
ndarray ((order + 1)^2, C) float64
    The integral of radiance times basis function over the sphere: the sum over texels, weighted by their exact solid
    angles; uint8 as value/255. Row ``l (l + 1) + m`` belongs to the real orthonormal function of order l and degree m:
    Y00 = .282095; then .488603 times y, z, x; then 1.092548 xy, 1.092548 yz, .315392 (3zz - 1), 1.092548 xz,
    .546274 (xx - yy); and so on. NaN counts as 0, infinity as 65504.

Raises
------
ValueError
    For an order outside its limits.

See Also
--------
from_sh : the inverse, for light that has no more than these orders.

Notes
-----
P.-P. Sloan, "Stupid Spherical Harmonics (SH) Tricks", 2008. The irradiance divided by pi has the coefficients of order
0, 1 and 2 times 1, 2/3 and 1/4 (R. Ramamoorthi and P. Hanrahan, "An efficient representation for irradiance environment
maps", 2001).

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> coefficients = cc.CubeMap(np.ones((6, 8, 8, 1), np.float32)).sh()
>>> coefficients.shape, float(coefficients[0, 0].round(4))  # sqrt(4 pi)
((9, 1), 3.5449)
)doc";

inline constexpr const char* from_levels =
    R"doc(Make a filtered cubemap of its levels, for example those that another program filtered.

Parameters
----------
levels : sequence of CubeMap
    Level k of L, 2 to 64 of them, holds the light filtered for the roughness ``k / (L - 1)``; level 0 is the cube
    itself. All have the same dtype and number of channels; their sizes are free.

Returns
-------
CubeMap
    With `levels` and `roughness`, and the `mipmaps` and `encoding` of level 0.

Raises
------
ValueError
    For another number of levels, or levels of different channels or dtypes.
TypeError
    For levels that are no cubemaps.

See Also
--------
prefilter : makes the levels of a cubemap.

Examples
--------
>>> import numpy as np
>>> import cubecam as cc
>>> sharp, rough = (cc.CubeMap(np.full((6, n, n, 3), 0.5, np.float32)) for n in (64, 16))
>>> cc.CubeMap.from_levels([sharp, rough]).roughness.tolist()
[0.0, 1.0]
)doc";

inline constexpr const char* from_sh =
    R"doc(Make a cube of the light that coefficients of spherical harmonics describe.

Parameters
----------
coefficients : array_like ((order + 1)^2, C)
    As `sh` returns them, for one, three or four channels.
size : int, default 32
    Texels along an edge of a face.

Returns
-------
CubeMap
    float32: the sum of coefficient times basis function at the center of each texel. It may be negative.

Raises
------
ValueError
    For another number of rows or columns, numbers that are not finite, or a size below 1.
TypeError
    For values that are not real numbers.

Examples
--------
>>> import cubecam as cc
>>> cube = cc.CubeMap.from_sh([[0.0], [1.0], [0.0], [0.0]])  # .488603 y
>>> cube.sample([[0, 1, 0], [0, -1, 0]]).ravel().round(2)
array([ 0.49, -0.49], dtype=float32)
)doc";

}  // namespace cubecam::docs
