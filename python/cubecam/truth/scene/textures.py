"""Lookups in the pictures that materials show: level 0, as OpenGL magnifies them (4.6, section 8.14)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..arrays import Array
from ..shading.images import wrapped


def _identity() -> Array:
    return np.eye(2, 3)


@dataclass
class Lookup:
    """A picture with its place on a surface; plain data.

    Parameters
    ----------
    pixels : ndarray (H, W, C)
        uint8 (which stands for value/255) or floats; C is 1 (grey), 3 or 4; row 0 on top.
    wrap : (str, str)
        "repeat", "clamp" or "mirror", along u and along v.
    nearest : bool
        Whether the nearest texel is taken, or a mix of four.
    matrix : ndarray (2, 3)
        The picture is looked up at ``matrix @ (u, v, 1)``; (0, 0) is its bottom-left corner.
    uv_set : int
        0 for the mesh's uvs, 1 for its second set.
    decode : bool
        Whether the colours of uint8 are sRGB (IEC 61966-2-1) and are decoded before they are mixed. Alpha is linear.
    """

    pixels: npt.NDArray[Any]
    wrap: tuple[str, str] = ("repeat", "repeat")
    nearest: bool = False
    matrix: Array | None = None
    uv_set: int = 0
    decode: bool = False

    def at(self, uv: Array, uv1: Array | None = None) -> Array:
        """Look up places on surfaces.

        Parameters
        ----------
        uv, uv1 : ndarray (R, 2)
            The two sets of texture coordinates.

        Returns
        -------
        ndarray (R, 4) float64
            Grey is red, green and blue alike; alpha is 1 where the picture has none.
        """
        place = uv if self.uv_set == 0 or uv1 is None else uv1
        if self.matrix is not None:
            m = self.matrix  # without BLAS, whose rounding may change with the number of rows
            place = place[:, :1] * m[:, 0] + place[:, 1:2] * m[:, 1] + m[:, 2]
        height, width = self.pixels.shape[:2]
        x = place[:, 0] * width
        y = (1 - place[:, 1]) * height
        if self.nearest:
            return self._texels(np.floor(y), np.floor(x))
        x, y = x - 0.5, y - 0.5
        column, row = np.floor(x), np.floor(y)
        fx, fy = (x - column)[:, None], (y - row)[:, None]
        top = self._texels(row, column) * (1 - fx) + self._texels(row, column + 1) * fx
        bottom = self._texels(row + 1, column) * (1 - fx) + self._texels(row + 1, column + 1) * fx
        mixed: Array = top * (1 - fy) + bottom * fy
        return mixed

    def _texels(self, row: Array, column: Array) -> Array:
        height, width, channels = self.pixels.shape
        rows = wrapped(row.astype(np.int64), height, self.wrap[1])
        columns = wrapped(column.astype(np.int64), width, self.wrap[0])
        texels = self.pixels[rows, columns]
        found = np.ones((len(texels), 4))
        colors = min(channels, 3)
        if self.pixels.dtype == np.uint8:
            table = _DECODED if self.decode else _FRACTIONS
            found[:, :3] = table[texels[:, :colors]]
            if channels == 4:
                found[:, 3] = _FRACTIONS[texels[:, 3]]
        else:
            found[:, :3] = texels[:, :colors]
            if channels == 4:
                found[:, 3] = texels[:, 3]
        return found


_FRACTIONS: Array = np.arange(256) / 255.0
_DECODED: Array = np.where(
    _FRACTIONS <= 0.04045, _FRACTIONS / 12.92, ((_FRACTIONS + 0.055) / 1.055) ** 2.4
)
