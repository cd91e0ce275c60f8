"""The way of light through a body of glass: where it goes in, is reflected inside, and comes out again.

Written from Snell's law and glTF's extensions, never from the shaders. A body is a function that says where a ray that
starts on its surface, or inside, leaves it: `ball`, `convex` and `seen_from_middle` make such functions.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .cubes import largest_part, padded, sample_padded
from .vectors import Array, normalised, reflect, refract

#: What stands for an index of refraction of 0, which is infinity (KHR_materials_ior).
_INFINITE = 1e6

#: From places (R, 3) and unit directions (R, 3): the distances (R,) to where the rays leave the body, inf where its far
#: side is not known, and the outward unit normals (R, 3) there.
Exit = Callable[[Array, Array], tuple[Array, Array]]


class Passage(NamedTuple):
    """How light leaves a body.

    Attributes
    ----------
    position, direction : ndarray (R, 3)
        Where it leaves the body and the unit direction in which it goes on.
    way : ndarray (R,)
        How far it went inside.
    met : ndarray (R,) of int
        How often it met the inner side; 0 where the far side is not known.
    """

    position: Array
    direction: Array
    way: Array
    met: npt.NDArray[np.int64]


def spread(ior: float, dispersion: float) -> Array:
    """KHR_materials_dispersion, "Implementation": the indices (3,) of red, green and blue.

    Of a body that is thinner than what is around it, the surroundings are dispersive.

    Examples
    --------
    >>> spread(1.5, 1.0).tolist()
    [1.4875, 1.5, 1.5125]
    """
    middle = ior if ior > 0 else _INFINITE
    denser = max(middle, 1 / middle)
    half = (denser - 1) * 0.025 * dispersion
    iors = np.maximum(denser + half * np.array([-1.0, 0.0, 1.0]), 1.0)
    return np.asarray(iors if middle >= 1 else 1 / iors)


def extinction(color: npt.ArrayLike, distance: float) -> Array:
    """KHR_materials_volume, "Attenuation": white light has the colour (3,) after the distance.

    Examples
    --------
    >>> np.exp(-3 * extinction((1, 0.5, 0.1), 1.5)).round(3).tolist()  # twice as far
    [1.0, 0.25, 0.01]
    """
    if not np.isfinite(distance):
        return np.zeros(3)
    # A colour of 0 lets nothing through; its logarithm must stay finite, since 0 times infinity is no number.
    return np.asarray(-np.log(np.maximum(np.asarray(color, np.float64), 1e-30)) / distance)


def through(
    position: npt.ArrayLike,
    direction: npt.ArrayLike,
    ior: float,
    leave: Exit,
    *,
    most: int = 4,
) -> Passage:
    """Follow light that has entered a body until it leaves it.

    Parameters
    ----------
    position, direction : array_like (R, 3)
        Where the light went in, and the unit direction in which it goes inside.
    ior : float
        The index of refraction inside over that outside.
    leave : Exit
        The body.
    most : int
        How often light may meet the inner side. Where it is reflected totally the last time, it goes straight on in the
        direction of the reflection.

    Notes
    -----
    Light that is reflected inside in part is not followed.

    Examples
    --------
    Through the middle of a ball:

    >>> found = through([(0, 0, 1)], [(0, 0, -1)], 1.5, ball(1.0))
    >>> found.position.tolist(), float(found.way[0])
    ([[0.0, 0.0, -1.0]], 2.0)
    """
    place, d = (np.array(x, float).reshape(-1, 3) for x in (position, direction))
    way = np.zeros(len(place))
    met = np.zeros(len(place), np.int64)
    rows = np.arange(len(place))
    for _ in range(most):
        if not len(rows):
            break
        distance, normal = leave(place[rows], d[rows])
        known = np.isfinite(distance)
        rows, distance, normal = rows[known], distance[known], normal[known]
        place[rows] += distance[:, None] * d[rows]
        way[rows] += distance
        met[rows] += 1
        towards = d[rows]
        out = refract(towards, -normal, ior)
        total = (out * out).sum(axis=-1) == 0
        d[rows] = np.where(total[:, None], reflect(towards, normal), out)
        rows = rows[total]
    return Passage(place, d, way, met)


def ball(radius: float) -> Exit:
    """A smooth ball round the origin."""

    def leave(place: Array, direction: Array) -> tuple[Array, Array]:
        # Of the two roots of |p + t d| = r, that of the exit.
        b = (place * direction).sum(axis=-1)
        c = (place * place).sum(axis=-1) - radius**2
        t = -b + np.sqrt(np.maximum(b * b - c, 0))
        return t, normalised(place + t[:, None] * direction)

    return leave


def convex(normals: npt.ArrayLike, heights: npt.ArrayLike) -> Exit:
    """What lies below planes: unit normals (F, 3) outwards and heights (F,) along them, from the origin."""
    n, h = np.asarray(normals, float), np.asarray(heights, float)

    def leave(place: Array, direction: Array) -> tuple[Array, Array]:
        along = direction @ n.T
        with np.errstate(divide="ignore", invalid="ignore"):
            t = np.where(along > 1e-12, (h - place @ n.T) / along, np.inf)
        face = t.argmin(axis=-1)
        return np.maximum(t.min(axis=-1), 0), n[face]

    return leave


def seen_from_middle(nearness: npt.ArrayLike, normals: npt.ArrayLike, *, steps: int = 512) -> Exit:
    """A body of which a cube knows the inner side, as its middle, the origin, sees it.

    A place q is inside where max(|qx|, |qy|, |qz|) W(q) < 1, with W = 1 / z of the side that lies in this direction, as
    in `parallax.march`. The ray is walked in many steps over the length after which it has left the corners of the cube
    from -2 to 2, and the first change is bisected.

    Parameters
    ----------
    nearness : array_like (6, N, N)
        W, in the order and layout of a cubemap; 0 where the body has no side.
    normals : array_like (6, N, N, 3)
        Outwards.
    """
    w, n = padded(nearness), padded(normals)

    def height(q: Array) -> Array:
        result: Array = largest_part(q) * sample_padded(w, q) - 1
        return result

    def leave(place: Array, direction: Array) -> tuple[Array, Array]:
        reach = 4 * np.sqrt(3.0)
        low, high = np.zeros(len(place)), np.full(len(place), np.inf)
        for step in range(1, steps + 1):
            t = reach * step / steps
            outside = ~np.isfinite(high) & (height(place + t * direction) >= 0)
            high[outside], low[outside] = t, t - reach / steps
        found = np.isfinite(high)
        a, b = low[found], high[found]
        for _ in range(40):
            middle = (a + b) / 2
            inside = height(place[found] + middle[:, None] * direction[found]) < 0
            a, b = np.where(inside, middle, a), np.where(inside, b, middle)
        distance = np.full(len(place), np.inf)
        distance[found] = b
        at = place + np.where(found, distance, 0.0)[:, None] * direction
        return distance, normalised(sample_padded(n, at))

    return leave
