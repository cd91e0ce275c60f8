"""Lookups in pictures, at level 0, as OpenGL makes them (4.6 section 8.14)."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from .vectors import Array


def to_float(texels: npt.ArrayLike) -> Array:
    """Texels as the numbers a shader sees: uint8 as value / 255."""
    texels = np.asarray(texels)
    return texels / 255.0 if texels.dtype == np.uint8 else texels.astype(float)


def wrapped(index: npt.NDArray[Any], count: int, wrap: str) -> Any:
    """The texel that stands for one outside of 0..count - 1."""
    if wrap == "repeat":
        return index % count
    if wrap == "mirror":
        index = index % (2 * count)
        return np.where(index < count, index, 2 * count - 1 - index)
    result: Array = np.clip(index, 0, count - 1)
    return result


def sample_image(
    image: npt.ArrayLike,
    uv: npt.ArrayLike,
    wrap: str | tuple[str, str] = "repeat",
    *,
    nearest: bool = False,
) -> Array:
    """Lookup in a (H, W, C) picture whose row 0 is on top; uv (0, 0) is its bottom-left corner.

    Bilinear, or of the nearest texel. `wrap` is a name, or one for u and one for v.
    """
    pixels = to_float(image)
    height, width = pixels.shape[:2]
    wrap_u, wrap_v = (wrap, wrap) if isinstance(wrap, str) else wrap
    x = np.asarray(uv)[..., 0] * width - 0.5
    y = (1 - np.asarray(uv)[..., 1]) * height - 0.5

    def texel(r: npt.NDArray[Any], c: npt.NDArray[Any]) -> Array:
        result: Array = pixels[wrapped(r, height, wrap_v), wrapped(c, width, wrap_u)]
        return result

    if nearest:
        return texel(np.floor(y + 0.5).astype(int), np.floor(x + 0.5).astype(int))
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - column)[..., None], (y - row)[..., None]
    top = texel(row, column) * (1 - fx) + texel(row, column + 1) * fx
    bottom = texel(row + 1, column) * (1 - fx) + texel(row + 1, column + 1) * fx
    result: Array = top * (1 - fy) + bottom * fy
    return result
