"""Where a ray meets what a picture shows: reflections that are looked up on the screen.

M. McGuire, M. Mara, "Efficient GPU Screen-Space Ray Tracing", Journal of Computer Graphics Techniques 3(4), 2014: the
ray is a line in the picture, walked in even steps, and ends where it passes behind a surface and not far behind it.
Here the steps are an eighth of a pixel, where a shader leaps over free cells.

Places are (x, y) in pixels, from the left and from the upper edge: the middle of the pixel of row i and column j is at
(j + 0.5, i + 0.5).
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .vectors import Array

#: How thick surfaces are: a share of the picture's height at the place, and pixels.
THICKNESS, THICK_PIXELS = 0.01, 2.0

#: Share of the picture's smaller side, from its border on, over which the environment fades in.
FADE = 0.05

_STEPS = 8  # of a pixel


class ScreenHits(NamedTuple):
    """Where rays end in the picture.

    Attributes
    ----------
    place : ndarray (n, 2) float64
        In pixels; NaN where the ray meets nothing that the picture shows.
    seen : ndarray (n, 2) float64
        Where the light of that surface is looked up: the same place, or, if not all four pixels round it are as near,
        the middle of the one whose surface is the next.
    found : ndarray (n,) bool
        Whether it meets something.
    share : ndarray (n,) float64
        How much of the light comes from the picture, 0 to 1; the rest comes from the environment.
    width : ndarray (n,) float64
        How wide the lobe is at the hit, in pixels; 0 for a sharp ray.
    """

    place: Array
    seen: Array
    found: npt.NDArray[np.bool_]
    share: Array
    width: Array


def screen_hits(
    position: npt.ArrayLike,
    direction: npt.ArrayLike,
    to_clip: npt.ArrayLike,
    depth: npt.ArrayLike,
    ids: npt.ArrayLike,
    own: npt.ArrayLike = 0,
    spread: float = 0.0,
) -> ScreenHits:
    """Follow rays through the depths of a picture.

    Parameters
    ----------
    position, direction : array_like (n, 3)
        World position from which each ray starts, and its unit vector.
    to_clip : array_like (4, 4)
        The camera's projection @ view, to OpenGL's clip space.
    depth : array_like (H, W)
        OpenGL's window-space depth, 0 near to 1 far: the output "depth".
    ids : array_like (H, W) int
        The node of each pixel; 0 is the background, which no ray meets.
    own : array_like (n,) or int
        The node from which each ray starts, which it does not meet. Default 0.
    spread : float
        Tangent of half the angle from which light is gathered. Default 0, a sharp ray.

    Returns
    -------
    ScreenHits

    Examples
    --------
    A wall across the view, at the depth 0.9 of a parallel projection, and a ray that comes from the left:

    >>> depth, ids = np.full((8, 8), 0.9), np.ones((8, 8), int)
    >>> found = screen_hits([(-0.5, 0, 0)], [(0.6, 0, -0.8)], np.diag([1, 1, -1, 1]), depth, ids)
    >>> found.place.round(6).tolist(), found.found.tolist()
    ([[4.4, 4.0]], [True])
    """
    start, way = (np.atleast_2d(np.asarray(v, float)) for v in (position, direction))
    depth, ids = np.asarray(depth, float), np.asarray(ids)
    height, width = depth.shape
    matrix = np.asarray(to_clip, float)
    own = np.broadcast_to(np.asarray(own), start.shape[:1])
    count = len(start)
    place, seen = np.full((2, count, 2), np.nan)
    found = np.zeros(count, bool)

    first = np.concatenate([start, np.ones((count, 1))], 1) @ matrix.T
    change = way @ matrix[:, :3].T
    for i in range(count):
        t = _times(first[i], change[i], width, height)
        if len(t) < 2:
            continue
        at = _in_picture(first[i] + t[:, None] * change[i], width, height)
        before = _bilinear(depth, at[:, :2]) - at[:, 2]
        before[0] = max(before[0], 1e-12)  # the reflecting surface itself
        crossings = np.flatnonzero((before[:-1] > 0) & (before[1:] <= 0))
        for c in crossings:
            part = before[c] / (before[c] - before[c + 1])
            here = at[c] + part * (at[c + 1] - at[c])
            ahead = at[c + 1] - at[c]
            ahead *= 0.25 / max(np.abs(ahead[:2]).max(), 1e-12)
            apart, texels = _surfaces(
                here, (here + ahead)[:2], depth, ids, int(own[i]), np.linalg.inv(matrix)
            )
            thick = THICKNESS * height + THICK_PIXELS
            if (np.abs(apart) <= thick).any():
                place[i], found[i] = here[:2], True
                seen[i] = (
                    here[:2] if (np.abs(apart) <= thick).all() else texels[np.abs(apart).argmin()]
                )
                break
            again = c + 1 + np.flatnonzero(before[c + 1 :] > 0)
            hidden = apart[(apart > 0) & np.isfinite(apart)]
            # A body may reach half as far behind its outline as it is wide.
            if len(again) == 0 or (
                len(hidden) and 0.5 * np.abs(at[again[0]] - here)[:2].max() > hidden.max()
            ):
                break

    # The lobe: its width over that of a pixel, at the hit.
    lobe = np.zeros(count)
    if spread > 0 and found.any():
        inverse = np.linalg.inv(matrix)
        for k in np.flatnonzero(found):
            hit = _bilinear(depth, place[k][None])[0]
            ends = _to_world(
                np.array([[place[k][0], y, hit] for y in (0, place[k][1], height)]),
                inverse,
                width,
                height,
            )
            high = np.linalg.norm(ends[0] - ends[2])
            lobe[k] = 2 * spread * np.linalg.norm(ends[1] - start[k]) * height / high
    inside = np.minimum(place, np.array([width, height]) - place).min(1) - 0.5
    share = np.clip(inside / (FADE * min(width, height) + lobe), 0, 1) * np.clip(
        2 - 16 * lobe / height, 0, 1
    )
    return ScreenHits(place, seen, found, np.where(found, share, 0.0), lobe)


def _times(first: Array, change: Array, width: int, height: int) -> Array:
    """The t of the ray that lie an eighth of a pixel from each other, while it is in the picture."""
    if first[3] <= 0:
        return np.empty(0)
    # n(t) = (C + t D) / (w + t w'): even steps of s = t / (w + t w') are even steps in the picture.
    line = (change[:3] - first[:3] / first[3] * change[3]) * (width / 2, height / 2, 0.5)
    a_pixel = np.abs(line[:2]).max()
    end = 1 / change[3] if change[3] > 0 else np.inf
    begin = _in_picture(first[None], width, height)[0]
    line[1] = -line[1]
    for axis, (low, high) in enumerate([(0.5, width - 0.5), (0.5, height - 0.5), (0, 1)]):
        if line[axis] != 0:
            end = min(end, max((low - begin[axis]) / line[axis], (high - begin[axis]) / line[axis]))
    if not 0 < end < np.inf or a_pixel == 0:
        return np.empty(0)
    s = np.linspace(0, end, int(np.ceil(end * a_pixel * _STEPS)) + 2)[:-1]
    return np.asarray(s * first[3] / (1 - s * change[3]))


def _in_picture(clip: Array, width: int, height: int) -> Array:
    """(x, y) in pixels and the depth from 0 to 1."""
    at = clip[:, :3] / clip[:, 3:]
    return np.stack(
        [(0.5 + 0.5 * at[:, 0]) * width, (0.5 - 0.5 * at[:, 1]) * height, 0.5 + 0.5 * at[:, 2]], 1
    )


def _to_world(place: Array, inverse: Array, width: int, height: int) -> Array:
    """World positions of (x, y, depth)."""
    at = np.stack(
        [
            2 * place[:, 0] / width - 1,
            1 - 2 * place[:, 1] / height,
            2 * place[:, 2] - 1,
            np.ones(len(place)),
        ],
        1,
    )
    world = at @ inverse.T
    return np.asarray(world[:, :3] / world[:, 3:])


def _bilinear(values: Array, place: Array) -> Array:
    height, width = values.shape
    x, y = place[:, 0] - 0.5, place[:, 1] - 0.5
    j, i = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = x - j, y - i
    columns, rows = (
        (np.clip(j + k, 0, width - 1) for k in (0, 1)),
        [np.clip(i + k, 0, height - 1) for k in (0, 1)],
    )
    left, right = columns
    upper = values[rows[0], left] * (1 - fx) + values[rows[0], right] * fx
    lower = values[rows[1], left] * (1 - fx) + values[rows[1], right] * fx
    return np.asarray(upper * (1 - fy) + lower * fy)


def _surfaces(
    here: Array, near: Array, depth: Array, ids: npt.NDArray[Any], own: int, inverse: Array
) -> tuple[Array, Array]:
    """How far the surfaces in the four pixels round `near` are before a place, and the middles of the pixels.

    In pixels as large as at the surface; infinitely far, if it is the background or the node itself.
    """
    height, width = depth.shape
    j, i = np.floor(near - 0.5).astype(int)
    forward = _to_world(
        np.array([[width / 2, height / 2, d] for d in (0.1, 0.2)]), inverse, width, height
    )
    axis = (forward[1] - forward[0]) / np.linalg.norm(forward[1] - forward[0])
    found, middles = [], []
    for row in np.clip((i, i + 1), 0, height - 1):
        for column in np.clip((j, j + 1), 0, width - 1):
            middles.append((column + 0.5, row + 0.5))
            if ids[row, column] in (0, own):
                found.append(-np.inf)
                continue
            places = [(*here[:2], depth[row, column]), here]
            places += [(here[0], y, depth[row, column]) for y in (0, height)]
            front, ray, top, bottom = _to_world(np.array(places), inverse, width, height)
            found.append((ray - front) @ axis / np.linalg.norm(top - bottom) * height)
    return np.array(found), np.array(middles)
