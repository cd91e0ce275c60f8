"""How alike two pictures of linear light are, tile by tile."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[Any]

WITHIN = 10 / 255
#: Light that counts as none.
BLACK = 1e-3


def screen(light: Array) -> Array:
    """x / (1 + x): what is compared."""
    light = np.maximum(light.astype(np.float64), 0)
    made: Array = light / (1 + light)
    return made


def difference(a: Array, b: Array) -> Array:
    """(H, W): the greatest difference of a channel."""
    made: Array = np.abs(screen(a) - screen(b)).max(-1)
    return made


def lit(pictures: list[Array]) -> Array:
    """(H, W) bool: pixels in which any picture shows anything. Black around the tiles would always agree."""
    made: Array = np.any([picture.max(-1) > BLACK for picture in pictures], axis=0)
    return made


def tiles(mask: Array, count: int) -> list[Array]:
    """Masks of count x count equal tiles, row by row."""
    height, width = mask.shape
    row = np.arange(height)[:, None] * count // height
    column = np.arange(width)[None, :] * count // width
    return [mask & (row == i) & (column == j) for i in range(count) for j in range(count)]


def share(different: Array, mask: Array) -> float:
    """The share of the pixels of a mask that are within the bound."""
    return float((different[mask] <= WITHIN).mean()) if mask.any() else 1.0
