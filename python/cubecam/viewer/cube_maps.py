"""From a place in a picture of a cube to the direction that it shows, and back: cross, panorama, look.

A place is (x, y) in pixels from the top left corner of a picture of some size; the middle of the first pixel is at
(0.5, 0.5). A projection is made for one size. Pictures of one shape show the same at every size, so that a direction
under the pointer does not depend on the resolution at which the picture was drawn.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ..plot._faces import TABLE, cells
from ..typing import Center, Convention

__all__ = ["Cross", "Look", "Panorama", "Projection"]

Array = npt.NDArray[Any]
Floats = npt.NDArray[np.float64]

_UP = np.array([0.0, 1.0, 0.0])
_FORWARD = {
    "-z": np.array([0.0, 0.0, -1.0]),
    "+z": np.array([0.0, 0.0, 1.0]),
    "+x": np.array([1.0, 0.0, 0.0]),
    "-x": np.array([-1.0, 0.0, 0.0]),
}
#: The share of the picture that the cross or the panorama may fill at zoom 1.
_FILLED = 0.96


class Projection(Protocol):
    """What every way to show a cube offers."""

    def directions(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Floats:
        """Give world directions (..., 3) of any length but 0; NaN where the picture shows no face."""

    def places(self, directions: npt.ArrayLike) -> Floats:
        """Give the places (..., 2) at which directions are shown; NaN where they are not."""

    @property
    def pixels_per_face(self) -> float:
        """How many pixels the edge of a face is long, in the middle of the picture."""


@dataclass(frozen=True)
class Sheet:
    """A flat picture of `wide` x `high` units in a picture of pixels: fitted, enlarged by `zoom` and moved.

    `middle` is the place of the sheet, in units, that stands in the middle of the picture.
    """

    size: tuple[float, float]
    wide: float
    high: float
    zoom: float
    middle: tuple[float, float]

    @property
    def scale(self) -> float:
        """Pixels for a unit."""
        width, height = self.size
        return _FILLED * min(width / self.wide, height / self.high) * self.zoom

    def units(self, x: npt.ArrayLike, y: npt.ArrayLike) -> tuple[Floats, Floats]:
        """Convert pixels to units."""
        width, height = self.size
        u = (np.asarray(x, float) - width / 2) / self.scale + self.middle[0]
        v = (np.asarray(y, float) - height / 2) / self.scale + self.middle[1]
        return u, v

    def pixels(self, u: npt.ArrayLike, v: npt.ArrayLike) -> Floats:
        """Convert units to pixels, (..., 2)."""
        width, height = self.size
        x = (np.asarray(u, float) - self.middle[0]) * self.scale + width / 2
        y = (np.asarray(v, float) - self.middle[1]) * self.scale + height / 2
        return np.stack(np.broadcast_arrays(x, y), axis=-1)


class Cross:
    """The horizontal cross of a convention; a unit is the edge of a face."""

    def __init__(
        self,
        size: tuple[float, float],
        convention: Convention,
        zoom: float = 1.0,
        middle: tuple[float, float] = (2.0, 1.5),
    ) -> None:
        self.convention = convention
        self.sheet = Sheet(size, 4.0, 3.0, zoom, middle)
        self.cells = cells(convention)
        self._of_place = np.full((3, 4), -1)
        for slot, cell in enumerate(self.cells):
            self._of_place[cell.row, cell.column] = slot
        # For each slot the directions to the right, downwards and outwards.
        self._axes = np.stack(
            [np.stack([cell.right, cell.down, TABLE[cell.face, 2]]) for cell in self.cells]
        )

    @property
    def pixels_per_face(self) -> float:
        """How many pixels the edge of a face is long."""
        return self.sheet.scale

    def directions(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Floats:
        """Give world directions (..., 3) with a largest component of 1; NaN where there is no face."""
        u, v = np.broadcast_arrays(*self.sheet.units(x, y))
        column, row = np.floor(u).astype(int), np.floor(v).astype(int)
        inside = (column >= 0) & (column < 4) & (row >= 0) & (row < 3)
        slot = np.where(inside, self._of_place[np.clip(row, 0, 2), np.clip(column, 0, 3)], -1)
        right, down = 2 * (u - column) - 1, 2 * (v - row) - 1
        place = np.stack([right, down, np.ones_like(right)], axis=-1)
        found = np.einsum("...kx,...k->...x", self._axes[np.maximum(slot, 0)], place)
        return np.where(slot[..., None] >= 0, found, np.nan)

    def places(self, directions: npt.ArrayLike) -> Floats:
        """Give the places (..., 2) of directions."""
        r = np.asarray(directions, float)
        axis = np.abs(r).argmax(axis=-1)
        face = 2 * axis + (np.take_along_axis(r, axis[..., None], axis=-1)[..., 0] < 0)
        slots = np.argsort([cell.face for cell in self.cells])[face]
        right, down, outward = np.moveaxis(
            np.einsum("...kx,...x->...k", self._axes[slots], r), -1, 0
        )
        column, row = (
            np.array([getattr(c, name) for c in self.cells])[slots] for name in ("column", "row")
        )
        return self.sheet.pixels(column + (right / outward + 1) / 2, row + (down / outward + 1) / 2)


class Panorama:
    """The equirect of docs/conventions.md; a unit is its height, so that it is 2 units wide."""

    def __init__(
        self,
        size: tuple[float, float],
        center: Center,
        zoom: float = 1.0,
        middle: tuple[float, float] = (1.0, 0.5),
    ) -> None:
        self.center = center
        self.sheet = Sheet(size, 2.0, 1.0, zoom, middle)
        self._forward = _FORWARD[center]
        self._right = np.cross(self._forward, _UP)

    @property
    def pixels_per_face(self) -> float:
        """How many pixels a quarter of the horizon is long."""
        return self.sheet.scale / 2

    def directions(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Floats:
        """Give world directions (..., 3) of length 1; NaN beside the panorama."""
        u, v = np.broadcast_arrays(*self.sheet.units(x, y))
        # The names are those of docs/conventions.md: longitude l, latitude b.
        l, b = (u / 2 - 0.5) * 2 * np.pi, (0.5 - v) * np.pi  # noqa: E741
        level = np.cos(l)[..., None] * self._forward + np.sin(l)[..., None] * self._right
        found = np.cos(b)[..., None] * level + np.sin(b)[..., None] * _UP
        inside = (u >= 0) & (u < 2) & (v >= 0) & (v < 1)
        return np.where(inside[..., None], found, np.nan)

    def places(self, directions: npt.ArrayLike) -> Floats:
        """Give the places (..., 2) of directions."""
        r = np.asarray(directions, float)
        r = r / np.linalg.norm(r, axis=-1, keepdims=True)
        l = np.arctan2(r @ self._right, r @ self._forward)  # noqa: E741
        b = np.arcsin(np.clip(r[..., 1], -1, 1))
        return self.sheet.pixels(l / np.pi + 1, 0.5 - b / np.pi)


class Look:
    """The view of a person in the middle of the cube.

    `yaw` turns to the left, `pitch` upwards, both in degrees; yaw 0 and pitch 0 look along -Z. `fov` is the vertical
    field of view in degrees, below 180.
    """

    def __init__(self, size: tuple[float, float], yaw: float, pitch: float, fov: float) -> None:
        self.size = size
        turn, rise = np.radians([yaw, pitch])
        level = np.array([-np.sin(turn), 0.0, -np.cos(turn)])
        self.forward = np.cos(rise) * level + np.sin(rise) * _UP
        self.right = np.array([np.cos(turn), 0.0, -np.sin(turn)])
        self.up = np.cross(self.right, self.forward)
        self.tangent = np.tan(np.radians(fov) / 2)

    @property
    def pixels_per_face(self) -> float:
        """How many pixels the edge of a face is long that is seen from the front."""
        return self.size[1] / float(self.tangent)

    def directions(self, x: npt.ArrayLike, y: npt.ArrayLike) -> Floats:
        """Give world directions (..., 3), whose component along the view is 1."""
        width, height = self.size
        unit = 2 * self.tangent / height
        right = (np.asarray(x, float) - width / 2) * unit
        up = (height / 2 - np.asarray(y, float)) * unit
        right, up = np.broadcast_arrays(right, up)
        return np.asarray(right[..., None] * self.right + up[..., None] * self.up + self.forward)

    def places(self, directions: npt.ArrayLike) -> Floats:
        """Give the places (..., 2) of directions, which may be outside the picture; NaN for those behind the viewer."""
        width, height = self.size
        r = np.asarray(directions, float)
        ahead = r @ self.forward
        with np.errstate(divide="ignore", invalid="ignore"):
            unit = height / (2 * self.tangent * ahead)
            x, y = width / 2 + r @ self.right * unit, height / 2 - r @ self.up * unit
        return np.where((ahead > 0)[..., None], np.stack([x, y], axis=-1), np.nan)
