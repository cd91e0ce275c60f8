"""The faces of a cube in numpy, written from docs/conventions.md: the table of OpenGL 4.6, section 8.13.

Nothing here is taken from the core, which it is compared with.
"""

from __future__ import annotations

from typing import Any

import numpy as np

__all__ = ["directions", "hit_rectangles", "neighbours", "reflect", "texel_of", "unit"]

# For each face: the axes (index, sign) of the vectors whose products with r are sc, tc and ma.
_TABLE = (
    ((2, -1), (1, -1), (0, +1)),  # +X: -rz, -ry
    ((2, +1), (1, -1), (0, -1)),  # -X: +rz, -ry
    ((0, +1), (2, +1), (1, +1)),  # +Y: +rx, +rz
    ((0, +1), (2, -1), (1, -1)),  # -Y: +rx, -rz
    ((0, +1), (1, -1), (2, +1)),  # +Z: +rx, -ry
    ((0, -1), (1, -1), (2, -1)),  # -Z: -rx, -ry
)


def directions(size: int) -> Any:
    """Give the directions (6, N, N, 3) of the texels' centres; the component along the face's axis is 1 or -1."""
    center = (2 * np.arange(size) + 1) / size - 1
    return _at(*np.meshgrid(center, center, indexing="ij"))


def _at(tc: Any, sc: Any) -> Any:
    faces = np.zeros((6, *np.shape(sc), 3))
    for face, (s_axis, t_axis, major) in enumerate(_TABLE):
        for (axis, sign), value in ((s_axis, sc), (t_axis, tc), (major, 1.0)):
            faces[face, ..., axis] = sign * value
    return faces


def texel_of(rays: Any, size: int) -> tuple[Any, Any, Any]:
    """Give face, row and column of the texels that directions meet."""
    axis = np.argmax(np.abs(rays), axis=-1)
    negative = np.take_along_axis(rays, axis[..., None], -1)[..., 0] < 0
    face = 2 * axis + negative
    length = np.abs(np.take_along_axis(rays, axis[..., None], -1)[..., 0])
    place = []
    for row in (1, 0):  # tc, then sc
        index = np.array([entry[row][0] for entry in _TABLE])[face]
        sign = np.array([entry[row][1] for entry in _TABLE])[face]
        along = sign * np.take_along_axis(rays, index[..., None], -1)[..., 0] / length
        place.append(np.clip(np.floor((along + 1) / 2 * size), 0, size - 1).astype(int))
    return face, place[0], place[1]


def neighbours(size: int) -> tuple[tuple[Any, Any, Any], tuple[Any, Any, Any]]:
    """Give (face, row, column) of the texels along all edges, and of those beside them on the next face."""
    inside = np.arange(size)
    first, last = np.zeros(size, int), np.full(size, size - 1)
    border_rows = np.concatenate([inside, inside, first, last])
    border_columns = np.concatenate([first, last, inside, inside])
    center = (2 * np.arange(size) + 1) / size - 1
    beyond = 1 + 1 / size
    rows = np.concatenate([center, center, np.full(size, -beyond), np.full(size, beyond)])
    columns = np.concatenate([np.full(size, -beyond), np.full(size, beyond), center, center])
    faces = np.repeat(np.arange(6), 4 * size)
    here = (faces, np.tile(border_rows, 6), np.tile(border_columns, 6))
    return here, texel_of(_at(rows, columns).reshape(-1, 3), size)


def unit(vectors: Any) -> Any:
    """Give vectors of length 1."""
    return vectors / np.linalg.norm(vectors, axis=-1, keepdims=True)


def reflect(incident: Any, normal: Any) -> Any:
    """Mirror directions that point towards the surface: R = I - 2 (N.I) N."""
    along = (incident * normal).sum(-1, keepdims=True)
    return incident - 2 * along * normal


def hit_rectangles(rays: Any, rectangles: Any, background: Any) -> Any:
    """Give the colours that rays from the origin meet.

    A rectangle is (axis, place along it, ranges of the other two axes, colour).
    """
    colors = np.broadcast_to(np.asarray(background, float), rays.shape).copy()
    nearest = np.full(rays.shape[:-1], np.inf)
    for axis, place, ranges, color in rectangles:
        with np.errstate(divide="ignore", invalid="ignore"):
            steps = place / rays[..., axis]
        hit = (steps > 0) & (steps < nearest)
        others = [index for index in range(3) if index != axis]
        for index, (low, high) in zip(others, ranges, strict=True):
            with np.errstate(invalid="ignore"):
                at = steps * rays[..., index]
            hit &= (at > low) & (at < high)
        nearest = np.where(hit, steps, nearest)
        colors[hit] = color
    return colors
