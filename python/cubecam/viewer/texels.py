"""Which texel a direction meets, and what that texel is called in all three conventions.

Everything here is numpy and follows from the table in docs/conventions.md (OpenGL 4.6, section 8.13).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from .._core import CubeMap, Face, _to_array
from ..io.pixels import on_color, srgb_decode, to_float32
from ..plot._faces import NAMES, TABLE, cells, texels_of
from ..typing import Convention

if TYPE_CHECKING:
    from collections.abc import Iterable

__all__ = ["CONVENTIONS", "Place", "Texel", "levels_of", "place_in", "texel_directions", "texel_of"]

Array = npt.NDArray[Any]

CONVENTIONS: tuple[Convention, ...] = ("gl", "inside", "three")


class Place(NamedTuple):
    """Where a texel is stored in one convention: the name of the face ("+X" to "-Z"), row and column."""

    face: str
    row: int
    column: int

    def __str__(self) -> str:
        """Write the place as in a status line."""
        return f"{self.face} row {self.row} column {self.column}"


def place_in(convention: Convention, face: int, row: int, column: int, size: int) -> Place:
    """Convert a place of "gl" to another convention: the table "Texel by texel" of docs/conventions.md."""
    cell = next(c for c in cells(convention) if c.face == face)
    return Place(
        cell.name,
        size - 1 - row if cell.mirrored_t else row,
        size - 1 - column if cell.mirrored_s else column,
    )


@dataclass(frozen=True)
class Texel:
    """One texel of a cube, and the direction by which it was found.

    Attributes
    ----------
    face : Face
        The face in "gl", as `row` and `column`: the texel is ``cube.faces[face, row, column]``.
    row, column : int
    size : int
        Texels along an edge of this level.
    level : int
        0 for the cube's own faces.
    direction : tuple of 3 floats
        World space, from the center outwards, length 1.
    value : tuple of floats
        The texel's channels as linear numbers: uint8 counts as value/255, and the colours of a cube whose encoding is
        "srgb" are decoded.
    stored : tuple of numbers
        The texel's channels as the cube holds them.
    """

    face: Face
    row: int
    column: int
    size: int
    level: int
    direction: tuple[float, float, float]
    value: tuple[float, ...]
    stored: tuple[float, ...]

    @property
    def places(self) -> dict[Convention, Place]:
        """dict of str to Place: where each of the three conventions stores this texel."""
        return {
            name: place_in(name, int(self.face), self.row, self.column, self.size)
            for name in CONVENTIONS
        }

    def __str__(self) -> str:
        """Write all that a status line shows."""
        places = "   ".join(f"{name}: {place}" for name, place in self.places.items())
        x, y, z = self.direction
        numbers = ", ".join(f"{v:.4g}" for v in self.value)
        level = f"   level {self.level}" if self.level else ""
        return f"{places}   direction ({x:+.3f}, {y:+.3f}, {z:+.3f})   value ({numbers}){level}"


def texel_of(cube: CubeMap, direction: npt.ArrayLike, *, level: int = 0) -> Texel:
    """Find the texel of a cube that a direction of any length but 0 meets; `level` is noted only."""
    r = _to_array(direction, "direction").astype(float)
    r = r / np.linalg.norm(r)
    face, row, column = (int(i) for i in texels_of(r, cube.size))
    stored = cube.faces[face, row, column]
    light = to_float32(np.asarray(stored))
    if cube.encoding == "srgb":
        light = on_color(srgb_decode, light)
    x, y, z = r.tolist()
    return Texel(
        Face(face), row, column, cube.size, level, (x, y, z),
        tuple(light.tolist()), tuple(stored.tolist()),
    )  # fmt: skip


def texel_directions(size: int) -> npt.NDArray[np.float64]:
    """Give the directions of all texel centers, (6, size, size, 3); the component along the face's axis is 1."""
    centers = (np.arange(size) + 0.5) / size * 2 - 1
    tc, sc = np.meshgrid(centers, centers, indexing="ij")
    ones = np.ones_like(sc)
    # The rows of a face's matrix are orthonormal, so that its transpose is its inverse.
    places = np.stack([sc, tc, ones], axis=-1)
    return np.asarray(np.einsum("fkx,ijk->fijx", TABLE, places))


def levels_of(cube: CubeMap | Iterable[CubeMap]) -> list[CubeMap]:
    """List the levels of a cube, each as a cube: those of its mipmaps, or the cubes of a sequence.

    A level of mipmaps holds float32 numbers, which are those that a shader looks up: a bilinear lookup in the middle
    of a texel gives this texel alone.

    Raises
    ------
    TypeError
        For a thing that is neither a CubeMap nor a sequence of them.
    ValueError
        For an empty sequence, or cubes of unequal channels or encoding.
    """
    if isinstance(cube, CubeMap):
        return _mipmaps(cube) if cube.mipmaps else [cube]
    try:
        found = list(cube)
    except TypeError:
        raise TypeError(
            f"cube: expected a CubeMap or a sequence of them, got {type(cube).__name__}"
        ) from None
    if not found:
        raise ValueError("cube: expected at least one CubeMap, got an empty sequence")
    for level in found:
        if not isinstance(level, CubeMap):
            raise TypeError(f"cube: expected a sequence of CubeMap, got {type(level).__name__}")
        kinds = [(c.channels, c.encoding) for c in (found[0], level)]
        if kinds[0] != kinds[1]:
            raise ValueError(
                f"cube: expected levels of the same channels and encoding, got {kinds[0]} and {kinds[1]}"
            )
    return found


def _mipmaps(cube: CubeMap) -> list[CubeMap]:
    levels = [cube]
    for k in range(1, cube.size.bit_length()):
        values = cube.sample(texel_directions(max(1, cube.size >> k)), lod=float(k))
        levels.append(CubeMap(values, encoding=cube.encoding))
    return levels


def face_name(face: int) -> str:
    """Give the name of a face of "gl", "+X" to "-Z"."""
    return NAMES[face]
