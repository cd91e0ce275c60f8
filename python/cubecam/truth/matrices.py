"""Small matrices times many vectors, without BLAS, whose threads cost more than they bring and round differently."""

from __future__ import annotations

import numpy as np

from ..io.pixels import LUMINANCE
from .arrays import Array


def turned(matrix: Array, vectors: Array) -> Array:
    """Give ``matrix @ v`` of a matrix (3, 3) for each of the vectors (R, 3)."""
    x, y, z = vectors[:, :1], vectors[:, 1:2], vectors[:, 2:3]
    return x * matrix[:, 0] + y * matrix[:, 1] + z * matrix[:, 2]


def placed(matrix: Array, points: Array) -> Array:
    """Give the points (R, 3) through a matrix (4, 4), divided by w."""
    x, y, z = points[:, :1], points[:, 1:2], points[:, 2:3]
    found = x * matrix[:, 0] + y * matrix[:, 1] + z * matrix[:, 2] + matrix[:, 3]
    return np.asarray(found[:, :3] / found[:, 3:])


def luminance(color: Array) -> Array:
    """Give the luminance (...) of linear colours (..., 3)."""
    r, g, b = LUMINANCE
    return np.asarray(r * color[..., 0] + g * color[..., 1] + b * color[..., 2])
