"""Cubemaps as pictures of other projections, and back: the methods `CubeMap.to_fisheye`, `from_fisheye` and so on.

cpp/cubecam/math/projections.hpp has the formulas; this file has what callers see of them: names, arguments, sizes.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._calls import checked_call
from ._checks import finite_number, text_of, whole_number
from ._core import CubeMap, _project, _to_array, _unproject
from .typing import Encoding, FisheyeModel

if TYPE_CHECKING:
    from collections.abc import Callable

#: The greatest field of view of each model in degrees, and whether the model may have that one itself.
_WIDEST: dict[str, tuple[float, bool]] = {
    "equidistant": (360.0, True),
    "equisolid": (360.0, True),
    "stereographic": (360.0, False),
    "orthographic": (180.0, True),
}
#: How far from the centre of the picture a lens shows an angle, up to a factor.
_RADIUS: dict[str, Callable[[float], float]] = {
    "equidistant": lambda angle: angle,
    "equisolid": lambda angle: 2 * math.sin(angle / 2),
    "stereographic": lambda angle: 2 * math.tan(angle / 2),
    "orthographic": math.sin,
}
_MOST_TEXELS = 1 << 20
_Picture = npt.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]


@checked_call
def to_perspective(
    cube: CubeMap,
    fov: float,
    size: int | tuple[int, int],
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    dtype: npt.DTypeLike | None = None,
    output: str = "color",
) -> npt.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
    """Make the picture that a camera in the cube's centre takes.

    It is the picture that ``Renderer.render`` gives for ``PerspectiveCamera(fov=fov)`` of that place and direction, up
    to the resolution of the cube.

    Parameters
    ----------
    fov : float
        The vertical field of view in degrees, above 0 and below 180.
    size : int or (int, int)
        Pixels of an edge of a square picture, or (width, height).
    direction, up : array_like (3,)
        The direction in the middle of the picture, and what the picture shows above it; `up` is not along `direction`.
    dtype : dtype, optional
        "uint8", "float16" or "float32". None: that of the cube. Numbers are rounded as `to_equirect` rounds them.
    output : str
        "color", or a name in `outputs`: its nearest texels, in its own dtype.

    Returns
    -------
    ndarray (height, width, C), or (height, width) and (height, width, channels) of an output
        A new array, row 0 on top. Each pixel is filtered over its footprint.

    Raises
    ------
    ValueError
        For a field of view, size, direction or output that does not exist.
    TypeError
        For arguments of another type.

    Notes
    -----
    The pixel of row i and column j of W x H lies at x = 2 (j + .5) / W - 1, y = 1 - 2 (i + .5) / H; it shows the
    direction ``forward + tan(fov / 2) (x W/H right + y up)``.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
    >>> cube.to_perspective(60, (80, 60), direction=(1, 0, 0)).shape
    (60, 80, 3)
    """
    angle = _angle(fov, 180.0, False)
    return _projected(cube, "perspective", angle, direction, up, _pair(size), dtype, output)


@checked_call
def from_perspective(
    image: npt.ArrayLike,
    fov: float,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    size: int | None = None,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    encoding: Encoding | None = None,
) -> CubeMap:
    """Put a picture of a perspective camera into a cube, which is 0 around it: the inverse of `to_perspective`.

    Parameters
    ----------
    image : array_like (H, W, C)
        uint8 (value/255), float16, float32 or float64, row 0 on top. NaN raises ValueError; inf counts as the largest
        finite number of the image, or 65504 if that is more.
    fov, direction, up
        As in `to_perspective`.
    size : int, optional
        Texels along an edge of a face. None: the power of two whose texels are no larger than the pixels in the middle.
    mipmaps : bool
        Whether lookups in the new cube are trilinear.
    dtype : dtype, optional
        "uint8", "float16" or "float32". None: that of `image`.
    encoding : {"linear", "srgb"}, optional
        What the numbers of `image` are, as in `CubeMap`.

    Returns
    -------
    CubeMap
        Texels whose centre the picture does not show are 0, in all channels.

    Raises
    ------
    ValueError, TypeError
        As `to_perspective` and `from_equirect`.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.CubeMap.from_perspective([[[1.0, 1.0, 1.0]]], 90, size=4)
    >>> float(cube.faces[cc.Face.NEG_Z].min()), float(cube.faces[cc.Face.POS_Z].max())
    (1.0, 0.0)
    """
    pixels = _pixels(image)
    angle = _angle(fov, 180.0, False)
    detail = pixels.shape[0] / math.tan(angle / 2)
    return _cube(image, "perspective", angle, direction, up, size, detail, mipmaps, dtype, encoding)  # fmt: skip


@checked_call
def to_fisheye(
    cube: CubeMap,
    size: int | None = None,
    *,
    fov: float = 180.0,
    model: FisheyeModel = "equidistant",
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    dtype: npt.DTypeLike | None = None,
    output: str = "color",
) -> npt.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
    """Make the circular picture of a fisheye lens.

    Parameters
    ----------
    size : int, optional
        Pixels of an edge of the square picture; the circle touches its four sides. None: as many as keep the resolution
        in the middle.
    fov : float
        The field of view across the circle in degrees: above 0, up to 360 ("equidistant", "equisolid"), below 360
        ("stereographic") or up to 180 ("orthographic").
    model : {"equidistant", "equisolid", "stereographic", "orthographic"}
        How far from the middle an angle a from `direction` is shown: in proportion to a, sin(a/2), tan(a/2) or sin(a).
    direction, up, dtype, output
        As in `to_perspective`.

    Returns
    -------
    ndarray (size, size, C), or (size, size) and (size, size, channels) of an output
        A new array, row 0 on top. Pixels whose centre lies outside the circle are 0, in all channels, and of an output
        the value of the background.

    Raises
    ------
    ValueError, TypeError
        As `to_perspective`, and for an unknown model.

    Notes
    -----
    These are the lens models of Hugin and PanoTools (their "fisheye" is "equidistant"), which are those of Ray,
    Applied Photographic Optics, 2002: r = f a, 2 f sin(a/2), 2 f tan(a/2) and f sin(a).

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
    >>> up = cube.to_fisheye(101, direction=(0, 1, 0), up=(0, 0, -1))
    >>> up.shape, float(up[0, 0].max())
    ((101, 101, 3), 0.0)
    """
    angle = _lens_angle(fov, model)
    size = _edge(size, cube.size * _RADIUS[model](angle / 2))
    return _projected(cube, model, angle, direction, up, (size, size), dtype, output)


@checked_call
def from_fisheye(
    image: npt.ArrayLike,
    *,
    fov: float = 180.0,
    model: FisheyeModel = "equidistant",
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    size: int | None = None,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    encoding: Encoding | None = None,
) -> CubeMap:
    """Make a cube from the circular picture of a fisheye lens: the inverse of `to_fisheye`.

    Parameters
    ----------
    image : array_like (S, S, C)
        A square whose sides the circle touches, as in `from_perspective`. Pixels outside the circle do not count.
    fov, model, direction, up
        As in `to_fisheye`.
    size, mipmaps, dtype, encoding
        As in `from_perspective`.

    Returns
    -------
    CubeMap
        Texels whose centre the picture does not show are 0, in all channels.

    Raises
    ------
    ValueError, TypeError
        As `to_fisheye` and `from_equirect`, and for an image that is not square.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> cc.CubeMap.from_fisheye(np.ones((64, 64, 3), np.float32)).sample([[0, 0, -1], [0, 0, 1]]).tolist()
    [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]
    """
    pixels = _square(image)
    angle = _lens_angle(fov, model)
    edge = _RADIUS[model](angle / 2)
    # A stereographic lens shows most detail at the edge, the others in the middle.
    detail = pixels.shape[0] / edge * (1 + edge * edge / 4 if model == "stereographic" else 1)
    return _cube(image, model, angle, direction, up, size, detail, mipmaps, dtype, encoding)


@checked_call
def to_mirror_ball(
    cube: CubeMap,
    size: int | None = None,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    dtype: npt.DTypeLike | None = None,
    output: str = "color",
) -> npt.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
    """Make the picture of a mirror ball, photographed from far away.

    Parameters
    ----------
    size : int, optional
        Pixels of an edge of the square picture, whose sides the ball touches. None: twice the size of the cube.
    direction, up : array_like (3,)
        The direction in which the camera looks at the ball. The middle of the ball shows what lies behind the camera.
    dtype, output
        As in `to_perspective`.

    Returns
    -------
    ndarray (size, size, C), or (size, size) and (size, size, channels) of an output
        A new array, row 0 on top. It is mirrored, as the ball mirrors the world. Pixels whose centre lies outside the
        ball are 0, in all channels, and of an output the value of the background.

    Raises
    ------
    ValueError, TypeError
        As `to_perspective`.

    Notes
    -----
    P. Debevec, Rendering Synthetic Objects into Real Scenes, SIGGRAPH 1998: a ray that looks forward is reflected at
    the normal ``x right + y up - sqrt(1 - x^2 - y^2) forward``. It goes to
    ``2 n x right + 2 n y up + (2 x^2 + 2 y^2 - 1) forward`` with ``n = sqrt(1 - x^2 - y^2)``.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
    >>> cube.to_mirror_ball().shape
    (128, 128, 3)
    """
    size = _edge(size, 2 * cube.size)
    return _projected(cube, "mirror_ball", 1.0, direction, up, (size, size), dtype, output)


@checked_call
def from_mirror_ball(
    image: npt.ArrayLike,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    size: int | None = None,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    encoding: Encoding | None = None,
) -> CubeMap:
    """Make a cube from a photograph of a mirror ball: the inverse of `to_mirror_ball`.

    Parameters
    ----------
    image : array_like (S, S, C)
        A square whose sides the ball touches, as in `from_perspective`. Pixels outside the ball do not count.
    direction, up
        As in `to_mirror_ball`.
    size, mipmaps, dtype, encoding
        As in `from_perspective`.

    Returns
    -------
    CubeMap
        Little of the picture shows what lies behind the ball, in `direction`: there the cube is blurred.

    Raises
    ------
    ValueError, TypeError
        As `to_mirror_ball` and `from_equirect`, and for an image that is not square.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> cc.CubeMap.from_mirror_ball(np.ones((64, 64, 3), np.float32))
    CubeMap(size=32, channels=3, dtype=float32, mipmaps=False, encoding='linear')
    """
    pixels = _square(image)
    detail = pixels.shape[0] / 2
    return _cube(image, "mirror_ball", 1.0, direction, up, size, detail, mipmaps, dtype, encoding)  # fmt: skip


@checked_call
def to_angular_map(
    cube: CubeMap,
    size: int | None = None,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    dtype: npt.DTypeLike | None = None,
    output: str = "color",
) -> npt.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
    """Make an angular map, the form of Debevec's light probe images.

    Parameters
    ----------
    size : int, optional
        Pixels of an edge of the square picture. None: as many as keep the resolution in the middle.
    direction, up, dtype, output
        As in `to_perspective`.

    Returns
    -------
    ndarray (size, size, C), or (size, size) and (size, size, channels) of an output
        A new array, row 0 on top: a disc with `direction` in the middle and the opposite direction all round its rim.
        Pixels whose centre lies outside the disc are 0, in all channels, and of an output the value of the background.

    Raises
    ------
    ValueError, TypeError
        As `to_perspective`.

    Notes
    -----
    It is the "equidistant" fisheye of 360 degrees: the distance from the middle is in proportion to the angle from
    `direction`. P. Debevec, Light Probe Image Gallery: ``r = acos(Dz) / (pi sqrt(Dx^2 + Dy^2))``, u = Dx r, v = Dy r,
    with Dx to the right, Dy up and Dz forward.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
    >>> cube.to_angular_map(100).shape
    (100, 100, 3)
    """
    size = _edge(size, cube.size * math.pi)
    return _projected(cube, "equidistant", math.tau, direction, up, (size, size), dtype, output)


@checked_call
def from_angular_map(
    image: npt.ArrayLike,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    size: int | None = None,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    encoding: Encoding | None = None,
) -> CubeMap:
    """Make a cube from an angular map, such as Debevec's light probe images: the inverse of `to_angular_map`.

    Parameters
    ----------
    image : array_like (S, S, C)
        A square whose sides the disc touches, as in `from_perspective`. Pixels outside the disc do not count.
    direction, up
        As in `to_angular_map`.
    size, mipmaps, dtype, encoding
        As in `from_perspective`.

    Returns
    -------
    CubeMap
        The new cube in `dtype`.

    Raises
    ------
    ValueError, TypeError
        As `to_angular_map` and `from_equirect`, and for an image that is not square.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> cc.CubeMap.from_angular_map(np.ones((200, 200, 3), np.float32)).size
    64
    """
    pixels = _square(image)
    detail = pixels.shape[0] / math.pi
    return _cube(image, "equidistant", math.tau, direction, up, size, detail, mipmaps, dtype, encoding)  # fmt: skip


@checked_call
def to_octahedral(
    cube: CubeMap,
    size: int | None = None,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    dtype: npt.DTypeLike | None = None,
    output: str = "color",
) -> npt.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
    """Make an octahedral map: all directions in a square without empty corners.

    Parameters
    ----------
    size : int, optional
        Pixels of an edge of the square picture. None: twice the size of the cube.
    direction, up, dtype, output
        As in `to_perspective`; the opposite of `direction` is in the four corners.

    Returns
    -------
    ndarray (size, size, C), or (size, size) and (size, size, channels) of an output
        A new array, row 0 on top.

    Raises
    ------
    ValueError, TypeError
        As `to_perspective`.

    Notes
    -----
    Z. Cigolle et al., A Survey of Efficient Representations for Independent Unit Vectors, JCGT 3(2), 2014, "oct": for a
    direction (x, y, z) along right, up and forward, ``p = (x, y) / (|x| + |y| + |z|)``, and where z is below 0
    ``p = (1 - |p.yx|) * sign(p)``. Engines whose maps have the world's up in the middle have
    ``direction=(0, 1, 0)``.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
    >>> cube.to_octahedral().shape
    (128, 128, 3)
    """
    size = _edge(size, 2 * cube.size)
    return _projected(cube, "octahedral", 1.0, direction, up, (size, size), dtype, output)


@checked_call
def from_octahedral(
    image: npt.ArrayLike,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    size: int | None = None,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    encoding: Encoding | None = None,
) -> CubeMap:
    """Make a cube from an octahedral map: the inverse of `to_octahedral`.

    Parameters
    ----------
    image : array_like (S, S, C)
        A square, as in `from_perspective`. Lookups at its border continue on the other side of the fold.
    direction, up
        As in `to_octahedral`.
    size, mipmaps, dtype, encoding
        As in `from_perspective`.

    Returns
    -------
    CubeMap
        The new cube in `dtype`.

    Raises
    ------
    ValueError, TypeError
        As `to_octahedral` and `from_equirect`, and for an image that is not square.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> cc.CubeMap.from_octahedral(np.ones((64, 64, 3), np.uint8))
    CubeMap(size=64, channels=3, dtype=uint8, mipmaps=False, encoding='srgb')
    """
    pixels = _square(image)
    detail = pixels.shape[0]
    return _cube(image, "octahedral", 1.0, direction, up, size, detail, mipmaps, dtype, encoding)  # fmt: skip


@checked_call
def to_dual_paraboloid(
    cube: CubeMap,
    size: int | None = None,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    dtype: npt.DTypeLike | None = None,
    output: str = "color",
) -> npt.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
    """Make a dual paraboloid map: two discs of half the world each, side by side.

    Parameters
    ----------
    size : int, optional
        Pixels of an edge of each half. None: twice the size of the cube.
    direction, up, dtype, output
        As in `to_perspective`. The left half looks in `direction`, the right half back, with the same `up`.

    Returns
    -------
    ndarray (size, 2 size, C), or (size, 2 size) and (size, 2 size, channels) of an output
        A new array, row 0 on top; neither half is mirrored. Pixels whose centre lies outside the discs are 0, in all
        channels, and of an output the value of the background.

    Raises
    ------
    ValueError, TypeError
        As `to_perspective`.

    Notes
    -----
    W. Heidrich and H.-P. Seidel, View-independent Environment Maps, Graphics Hardware 1998: a direction (x, y, z) along
    right, up and forward of a half is shown at ``(x, y) / (1 + z)``. The right axis of the half that looks back is
    the left one of the other half. Where a shader uses the same x for both, flip the right half left-right.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
    >>> cube.to_dual_paraboloid().shape
    (128, 256, 3)
    """
    size = _edge(size, 2 * cube.size)
    return _projected(cube, "dual_paraboloid", 1.0, direction, up, (2 * size, size), dtype, output)


@checked_call
def from_dual_paraboloid(
    image: npt.ArrayLike,
    *,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    size: int | None = None,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    encoding: Encoding | None = None,
) -> CubeMap:
    """Make a cube from a dual paraboloid map: the inverse of `to_dual_paraboloid`.

    Parameters
    ----------
    image : array_like (S, 2S, C)
        Both halves side by side, as in `from_perspective`. Pixels outside the discs do not count.
    direction, up
        As in `to_dual_paraboloid`.
    size, mipmaps, dtype, encoding
        As in `from_perspective`.

    Returns
    -------
    CubeMap
        The new cube in `dtype`.

    Raises
    ------
    ValueError, TypeError
        As `to_dual_paraboloid` and `from_equirect`, and for an image that is not twice as wide as high.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> cc.CubeMap.from_dual_paraboloid(np.ones((64, 128, 3), np.float32)).size
    64
    """
    pixels = _pixels(image)
    if pixels.shape[1] != 2 * pixels.shape[0]:
        raise ValueError(
            "image: expected a picture twice as wide as high, got width "
            f"{pixels.shape[1]} and height {pixels.shape[0]}"
        )
    detail = pixels.shape[0]
    return _cube(image, "dual_paraboloid", 1.0, direction, up, size, detail, mipmaps, dtype, encoding)  # fmt: skip


@checked_call
def to_cylindrical(
    cube: CubeMap,
    size: int | tuple[int, int] | None = None,
    *,
    fov: float = 360.0,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    dtype: npt.DTypeLike | None = None,
    output: str = "color",
) -> npt.NDArray[np.uint8 | np.float16 | np.float32 | np.int32]:
    """Make a panorama on a cylinder round `up`, on which vertical lines stay straight and upright.

    Parameters
    ----------
    size : int or (int, int), optional
        (width, height), or the width of a picture that shows 45 degrees up and down. None: the width that keeps the
        resolution in the middle.
    fov : float
        The horizontal field of view in degrees, above 0 and up to 360.
    direction, up, dtype, output
        As in `to_perspective`. The cylinder stands along what is at right angles to `direction` on the side of `up`.

    Returns
    -------
    ndarray (height, width, C), or (height, width) and (height, width, channels) of an output
        A new array, row 0 on top. Straight up and down are outside of every picture.

    Raises
    ------
    ValueError, TypeError
        As `to_perspective`.

    Notes
    -----
    "Cylindrical" of Hugin and PanoTools: x is in proportion to the longitude, y to the tangent of the latitude, with
    square pixels in the middle. With f = width / fov pixels and fov in radians, the picture shows latitudes up to
    ``atan(height / (2 f))``.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_environment(cc.sample_data("sunset.exr"), size=64)
    >>> cube.to_cylindrical().shape
    (64, 201, 3)
    """
    angle = _angle(fov, 360.0, True)
    if size is None or not isinstance(size, tuple):
        width = _edge(size, cube.size * angle / 2)
        shape = width, max(1, round(2 * width / angle))
    else:
        shape = _pair(size)
    return _projected(cube, "cylindrical", angle, direction, up, shape, dtype, output)


@checked_call
def from_cylindrical(
    image: npt.ArrayLike,
    *,
    fov: float = 360.0,
    direction: npt.ArrayLike = (0, 0, -1),
    up: npt.ArrayLike = (0, 1, 0),
    size: int | None = None,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    encoding: Encoding | None = None,
) -> CubeMap:
    """Make a cube from a panorama on a cylinder: the inverse of `to_cylindrical`.

    Parameters
    ----------
    image : array_like (H, W, C)
        As in `from_perspective`. With a `fov` of 360 the first column continues the last one.
    fov, direction, up
        As in `to_cylindrical`.
    size, mipmaps, dtype, encoding
        As in `from_perspective`.

    Returns
    -------
    CubeMap
        Texels whose centre the picture does not show, such as those straight up, are 0, in all channels.

    Raises
    ------
    ValueError, TypeError
        As `to_cylindrical` and `from_equirect`.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> cc.CubeMap.from_cylindrical(np.ones((64, 201, 3), np.float32)).sample([[1, 0, 0], [0, 1, 0]]).tolist()
    [[1.0, 1.0, 1.0], [0.0, 0.0, 0.0]]
    """
    pixels = _pixels(image)
    angle = _angle(fov, 360.0, True)
    detail = 2 * pixels.shape[1] / angle
    return _cube(image, "cylindrical", angle, direction, up, size, detail, mipmaps, dtype, encoding)  # fmt: skip


def _projected(
    cube: CubeMap,
    kind: str,
    fov: float,
    direction: npt.ArrayLike,
    up: npt.ArrayLike,
    size: tuple[int, int],
    dtype: npt.DTypeLike | None,
    output: str,
) -> _Picture:
    return _project(cube, kind, fov, _axes(direction, up), size, dtype, output)


def _cube(
    image: npt.ArrayLike,
    kind: str,
    fov: float,
    direction: npt.ArrayLike,
    up: npt.ArrayLike,
    size: int | None,
    detail: float,
    mipmaps: bool,
    dtype: npt.DTypeLike | None,
    encoding: Encoding | None,
) -> CubeMap:
    """Make a cube; `detail` is the size whose texels in the middle of a face are as large as the finest pixels."""
    if size is None:
        size = 1 << max(0, math.ceil(math.log2(min(max(1.0, detail * 0.99), _MOST_TEXELS))))
        size = min(size, _MOST_TEXELS)
    return _unproject(
        image, kind, fov, _axes(direction, up), _texels(size), mipmaps, dtype, encoding
    )


def _texels(size: object) -> int:
    return whole_number(size, "size", 1, _MOST_TEXELS)


def _edge(size: int | tuple[int, int] | None, otherwise: float) -> int:
    return max(1, round(otherwise)) if size is None else _texels(size)


def _pair(size: int | tuple[int, int]) -> tuple[int, int]:
    if isinstance(size, tuple):
        return _texels(size[0]), _texels(size[1])
    return _texels(size), _texels(size)


def _pixels(image: npt.ArrayLike) -> npt.NDArray[Any]:
    pixels = _to_array(image, "image")
    if pixels.ndim != 3 or 0 in pixels.shape:
        raise ValueError(f"image: expected shape (H, W, C), got {pixels.shape}")
    return pixels


def _square(image: npt.ArrayLike) -> npt.NDArray[Any]:
    pixels = _pixels(image)
    if pixels.shape[0] != pixels.shape[1]:
        raise ValueError(
            f"image: expected a square, got width {pixels.shape[1]} and height {pixels.shape[0]}"
        )
    return pixels


def _angle(fov: float, most: float, inclusive: bool) -> float:
    """Check a field of view in degrees, and give it in radians."""
    angle = finite_number(fov, "fov")
    # The smallest numbers are 0 in radians.
    if not (math.radians(angle) > 0 and (angle < most or (inclusive and angle == most))):
        to = f"up to {most:g}" if inclusive else f"below {most:g}"
        raise ValueError(f"fov: expected degrees above 0 and {to}, got {text_of(fov)}")
    return math.radians(angle)


def _lens_angle(fov: float, model: str) -> float:
    if model not in _WIDEST:
        known = ", ".join(f'"{name}"' for name in _WIDEST)
        raise ValueError(f"model: expected one of {known}, got {text_of(model)}")
    return _angle(fov, *_WIDEST[model])


def _vector(value: npt.ArrayLike, name: str) -> npt.NDArray[np.float64]:
    vector = np.asarray(_to_array(value, name))
    if vector.dtype.kind not in "iuf":
        raise TypeError(f"{name}: expected three numbers, got {text_of(value)}")
    if vector.shape != (3,) or not np.isfinite(vector).all() or not vector.any():
        raise ValueError(
            f"{name}: expected three finite numbers that are not all 0, got {text_of(value)}"
        )
    vector = vector.astype(np.float64)
    vector = vector / np.abs(vector).max()
    return np.asarray(vector / np.linalg.norm(vector))


def _axes(direction: npt.ArrayLike, up: npt.ArrayLike) -> npt.NDArray[np.float64]:
    """Give what the viewer calls right, up and forward, in rows."""
    forward, above = _vector(direction, "direction"), _vector(up, "up")
    right = np.cross(forward, above)
    length = np.linalg.norm(right)
    if length < 1e-9:
        raise ValueError(
            f"up: expected a vector that is not along the direction {text_of(direction)}, got {text_of(up)}"
        )
    right = right / length
    return np.stack([right, np.cross(right, forward), forward])
