"""The rays of pictures: through the pixels of a camera, and through the texels of a cube."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np
import numpy.typing as npt

from .arrays import Array, Ints
from .matrices import placed, turned
from .paths.light_directions import DOWN, FORWARD, RIGHT

if TYPE_CHECKING:
    from .._core import Camera


@dataclass
class Rays:
    """R rays: origins on the near plane and unit directions (R, 3), and the lengths (R,) to the far plane."""

    origin: Array
    direction: Array
    reach: Array


class Eye(Protocol):
    """What a picture is seen with. Pixels are counted along the rows, then from row to row, then from face to face."""

    @property
    def shape(self) -> tuple[int, ...]:
        """Give the shape of the picture: (H, W) or (6, N, N)."""

    def rays(self, pixel: Ints, place: npt.ArrayLike) -> Rays:
        """Give the rays through places in pixels: (R, 2) from 0 to 1, to the right and down."""

    def depth(self, pixel: Ints, position: Array) -> tuple[Array, Array]:
        """Give distance and z (R,) of world positions (R, 3), as docs/conventions.md defines them."""


@dataclass
class CameraEye:
    """A camera and the size of its picture; `view` and `to_clip` are its matrices (4, 4)."""

    view: Array
    to_clip: Array
    near: float
    size: tuple[int, int]

    @classmethod
    def of(cls, camera: Camera, size: tuple[int, int]) -> CameraEye:
        view = np.asarray(camera.view, np.float64)
        clip = np.asarray(camera.projection(size[0] / size[1]), np.float64)
        return cls(view, clip, float(getattr(camera, "near", 0.0)), size)

    @property
    def shape(self) -> tuple[int, ...]:
        return self.size[1], self.size[0]

    def rays(self, pixel: Ints, place: npt.ArrayLike) -> Rays:
        row, column = np.divmod(pixel, self.size[0])
        place = np.broadcast_to(place, (len(pixel), 2))
        x = (column + place[:, 0]) / self.size[0] * 2 - 1
        y = 1 - (row + place[:, 1]) / self.size[1] * 2
        to_world = np.asarray(np.linalg.inv(self.to_clip @ self.view), np.float64)
        ends = []
        for depth in (-1.0, 1.0):
            ends.append(placed(to_world, np.stack([x, y, np.full_like(x, depth)], axis=-1)))
        way = ends[1] - ends[0]
        length = np.linalg.norm(way, axis=-1)
        return Rays(ends[0], way / length[:, None], length)

    def depth(self, pixel: Ints, position: Array) -> tuple[Array, Array]:
        in_view = placed(self.view, position)
        z = -in_view[:, 2]
        parallel = self.to_clip[3, 2] == 0
        return z - self.near if parallel else np.linalg.norm(in_view, axis=-1), z


@dataclass
class CubeEye:
    """The place of a capture, `turn` (3, 3) from the cube's axes to the world's, and the texels along an edge."""

    position: Array
    turn: Array
    near: float
    far: float
    texels: int

    @property
    def shape(self) -> tuple[int, ...]:
        return 6, self.texels, self.texels

    def rays(self, pixel: Ints, place: npt.ArrayLike) -> Rays:
        face, rest = np.divmod(pixel, self.texels**2)
        row, column = np.divmod(rest, self.texels)
        place = np.broadcast_to(place, (len(pixel), 2))
        s = 2 * (column + place[:, 0]) / self.texels - 1
        t = 2 * (row + place[:, 1]) / self.texels - 1
        way = FORWARD[face] + s[:, None] * RIGHT[face] + t[:, None] * DOWN[face]
        way = turned(self.turn, way)
        length = np.sqrt(1 + s * s + t * t)
        return Rays(
            self.position + self.near * way,
            way / length[:, None],
            (self.far - self.near) * length,
        )

    def depth(self, pixel: Ints, position: Array) -> tuple[Array, Array]:
        away = position - self.position
        forward = turned(self.turn, FORWARD[pixel // self.texels**2])
        return np.linalg.norm(away, axis=-1), (away * forward).sum(-1)
