"""Directions towards the light of an environment, more often where it is brighter."""

from __future__ import annotations

import numpy as np

from ...plot._faces import TABLE, texels_of
from ..arrays import Array
from ..matrices import luminance, turned

#: What stands for infinite light: the largest number of half floats, as in docs/conventions.md.
LARGEST = 65504.0
#: Faces with more texels than this along an edge are averaged, which only makes the choice of directions coarser.
_TEXELS = 512

#: For each face of docs/conventions.md: the direction of growing s, of growing t, and of the face.
RIGHT, DOWN, FORWARD = np.moveaxis(TABLE, 1, 0)


class LightDirections:
    """Draws directions with a density proportional to the luminance of a cubemap's texels.

    M. Pharr, W. Jakob, G. Humphreys, "Physically Based Rendering", 4th edition, section 12.5.2, for cubes: a texel is
    chosen by its luminance times its solid angle, and a place in it uniformly in s and t.

    Parameters
    ----------
    faces : ndarray (6, N, N, C)
        Linear colours of the texels, in the layout of docs/conventions.md.
    turn : ndarray (3, 3)
        The matrix from the world to the cube.
    """

    def __init__(self, faces: Array, turn: Array) -> None:
        # Only the proportions matter: 8 bits need no division.
        light = np.nan_to_num(np.asarray(faces, np.float64)[..., :3], posinf=LARGEST)
        light = np.broadcast_to(light, (*light.shape[:3], 3))  # grey has one channel
        light = _halved(np.maximum(light, 0), _TEXELS)
        n = light.shape[1]
        middles = (2 * np.arange(n) + 1) / n - 1
        a, b = np.meshgrid(middles, middles)
        angle = (1 + a * a + b * b) ** -1.5
        # Lookups are bilinear, so a texel also shows its neighbours: none has a chance of 0 beside a bright one.
        bright = luminance(light)
        bright = np.maximum(bright, _spread(bright) / 4)
        weights = (bright * angle).reshape(-1)
        total = weights.sum()
        self.dark = not total > 0
        chance = weights / total if not self.dark else np.full(weights.shape, 1 / weights.size)
        self._n, self._turn = n, np.asarray(turn, np.float64)
        self._sums = np.cumsum(chance)
        self._sums[-1] = 1.0
        # The density in s and t of -1 to 1; of solid angle, it is this times (1 + s^2 + t^2)^1.5.
        self._density = chance * (n / 2) ** 2

    def sample(self, numbers: Array) -> tuple[Array, Array]:
        """Give unit directions (R, 3) and their densities per solid angle (R, 1) for numbers (R, 3) from 0 to 1."""
        texel = np.searchsorted(self._sums, numbers[:, 0], side="right")
        texel = np.minimum(texel, len(self._sums) - 1)
        face, place = np.divmod(texel, self._n * self._n)
        row, column = np.divmod(place, self._n)
        s = 2 * (column + numbers[:, 1]) / self._n - 1
        t = 2 * (row + numbers[:, 2]) / self._n - 1
        towards = FORWARD[face] + s[:, None] * RIGHT[face] + t[:, None] * DOWN[face]
        length = np.sqrt(1 + s * s + t * t)
        directions = turned(self._turn.T, towards / length[:, None])
        return directions, (self._density[texel] * length**3)[:, None]

    def density(self, directions: Array) -> Array:
        """Give the density per solid angle (R, 1) with which `sample` draws unit directions (R, 3)."""
        d = turned(self._turn, directions)
        face, row, column = texels_of(d, self._n)
        texel = (face * self._n + row) * self._n + column
        # The largest component of a unit vector is 1 / sqrt(1 + s^2 + t^2).
        return np.asarray((self._density[texel] / np.abs(d).max(axis=1) ** 3)[:, None])


def _halved(light: Array, largest: int) -> Array:
    """Average squares of texels until a face has at most `largest` along an edge."""
    n = light.shape[1]
    by = -(-n // largest)
    if by == 1:
        return light
    # A size that `by` does not divide is repeated up to one that it does: it only makes the choice coarser.
    rows = np.minimum(np.arange(-(-n // by) * by), n - 1)
    light = light[:, rows][:, :, rows]
    small = len(rows) // by
    return np.asarray(light.reshape(6, small, by, small, by, 3).mean(axis=(2, 4)))


def _spread(bright: Array) -> Array:
    """Give the largest luminance of a texel and its eight neighbours on the same face."""
    n = bright.shape[1]
    padded = np.pad(bright, ((0, 0), (1, 1), (1, 1)), mode="edge")
    around = [padded[:, i : i + n, j : j + n] for i in range(3) for j in range(3)]
    return np.asarray(np.max(around, axis=0))
