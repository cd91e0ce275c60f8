"""Lookups in the six faces of a cube as OpenGL makes them: level 0, seamless (4.6, sections 8.13 and 8.14).

Faces are (6, N, N) or (6, N, N, C), in the order and layout of docs/conventions.md; directions are (..., 3) of any
length.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .images import to_float
from .vectors import Array

Ints = npt.NDArray[np.int64]

_X, _Y, _Z = np.eye(3)
#: Table 8.19: for each face the vectors whose products with a direction are sc, tc and |ma|.
_TABLE = np.array(
    [
        [-_Z, -_Y, _X],
        [_Z, -_Y, -_X],
        [_X, _Z, _Y],
        [_X, -_Z, -_Y],
        [_X, -_Y, _Z],
        [-_X, -_Y, -_Z],
    ]
)


class Footprint(NamedTuple):
    """The four texels around places of padded faces: indices (..., 4), and weights (..., 4) that sum to 1."""

    face: Ints
    row: Ints
    column: Ints
    weight: Array


def largest_part(v: npt.ArrayLike) -> Array:
    """The maximum norm of vectors (..., 3), as (...): how far they go along the axis of their face."""
    result: Array = np.abs(np.asarray(v, float)).max(axis=-1)
    return result


def place_on_faces(directions: npt.ArrayLike) -> tuple[Ints, Array, Array]:
    """The face, s and t that directions meet; of two equal components the axis of lower index is taken."""
    r = np.asarray(directions, float)
    axis = np.abs(r).argmax(axis=-1)
    ma = np.take_along_axis(r, axis[..., None], axis=-1)[..., 0]
    face = 2 * axis + (ma < 0)
    sc, tc = (np.einsum("...i,...i->...", _TABLE[:, k][face], r) for k in (0, 1))
    return face, (sc / np.abs(ma) + 1) / 2, (tc / np.abs(ma) + 1) / 2


def directions_of_texels(size: int) -> Array:
    """The directions (6, N, N, 3) through the middles of texels, with 1 or -1 along the face's axis."""
    middle = (2 * np.arange(size) + 1) / size - 1
    tc, sc = np.meshgrid(middle, middle, indexing="ij")
    place = np.stack([sc, tc, np.ones_like(sc)], axis=-1)
    result: Array = np.einsum("rck,fki->frci", place, _TABLE)
    return result


def padded(faces: npt.ArrayLike) -> Array:
    """Faces with one more texel on each side, (6, N + 2, N + 2, ...): those of the neighbours.

    At a corner of the cube only three texels meet; their average stands for the fourth.
    """
    inner = to_float(faces)
    n = inner.shape[1]
    result = np.zeros((6, n + 2, n + 2, *inner.shape[3:]))
    result[:, 1:-1, 1:-1] = inner
    along = (2 * np.arange(n) + 1) / n - 1
    beyond = 1 + 1e-3 / n  # just over the edge: the direction has left the face, but not the row
    for face in range(6):
        for edge, sc, tc in (
            ((slice(1, -1), 0), -beyond, along),
            ((slice(1, -1), -1), beyond, along),
            ((0, slice(1, -1)), along, -beyond),
            ((-1, slice(1, -1)), along, beyond),
        ):
            place = np.stack(np.broadcast_arrays(sc, tc, 1.0), axis=-1)
            other, s, t = place_on_faces(place @ _TABLE[face])
            row, column = (np.clip((x * n).astype(int), 0, n - 1) for x in (t, s))
            result[face][edge] = inner[other, row, column]
        for row, near_row in ((0, 1), (-1, -2)):
            for column, near_column in ((0, 1), (-1, -2)):
                three = (
                    result[face, near_row, near_column],
                    result[face, row, near_column],
                    result[face, near_row, column],
                )
                result[face, row, column] = sum(three) / 3
    return result


def footprint(directions: npt.ArrayLike, size: int) -> Footprint:
    """The texels of `padded` faces of `size` texels that a bilinear lookup mixes, and how much of each."""
    face, s, t = place_on_faces(directions)
    x, y = s * size + 0.5, t * size + 0.5  # texel 0 is the neighbour's
    column = np.clip(np.floor(x).astype(int), 0, size)
    row = np.clip(np.floor(y).astype(int), 0, size)
    fx, fy = x - column, y - row
    return Footprint(
        np.stack([face] * 4, axis=-1),
        np.stack([row, row, row + 1, row + 1], axis=-1),
        np.stack([column, column + 1, column, column + 1], axis=-1),
        np.stack([(1 - fx) * (1 - fy), fx * (1 - fy), (1 - fx) * fy, fx * fy], axis=-1),
    )


def gathered(pad: npt.NDArray[Any], four: Footprint) -> Array:
    """The four texels of each place: (..., 4) or (..., 4, C)."""
    result: Array = pad[four.face, four.row, four.column]
    return result


def sample_padded(pad: Array, directions: npt.ArrayLike) -> Array:
    """Bilinear lookup in faces that `padded` has made: (...) or (..., C)."""
    four = footprint(directions, pad.shape[1] - 2)
    texels = gathered(pad, four)
    weight = four.weight.reshape(*four.weight.shape, *(1,) * (pad.ndim - 3))
    result: Array = (texels * weight).sum(axis=four.weight.ndim - 1)
    return result


def sample_cube(faces: npt.ArrayLike, directions: npt.ArrayLike) -> Array:
    """Bilinear lookup in faces (6, N, N) or (6, N, N, C): (...) or (..., C); uint8 counts as value / 255."""
    return sample_padded(padded(faces), directions)
