"""Paths that meet the same material, and what becomes of them there."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from ..arrays import Array, Bools, Ints
from ..surfaces.colors import Points
from .sampler import pairs
from .state import Paths

#: Pairs of random numbers that a path uses at each surface; pair 0 is the place in the pixel.
_PAIRS = 4
FACET, CHOICE, LIGHT, LIGHT_TEXEL = range(_PAIRS)


@dataclass
class Way:
    """How some of the paths at a surface go on: rows of the group, directions (R, 3) and weights (R, 3).

    `density` (R,) is that of the choice of a rough surface, 0 where there was none. `entered` and `left` say which rays
    go into the body of the surface or out of it.
    """

    rows: Ints
    direction: Array
    weight: Array
    density: Array | None = None
    entered: Bools | None = None
    left: Bools | None = None
    channel: Ints | None = None
    ambient: bool = False


@dataclass
class Shaded:
    """What a surface sends back (R, 3) without the ways on, its alpha (R, 1), and these ways."""

    light: Array
    alpha: Array
    ways: list[Way] = field(default_factory=list)


@dataclass
class Group:
    """Paths that meet surfaces of one material."""

    paths: Paths
    points: Points
    material: int  # its place in the snapshot

    @property
    def inside(self) -> Bools:
        """Whether each ray meets the body that it runs in from within."""
        own: Bools = self.paths.bodies[:, 0] == self.points.node
        return self.points.back & own

    def take(self, rows: Ints) -> Group:
        """Give some of the paths with their points."""
        return Group(self.paths.rows(rows), self.points.take(rows), self.material)

    def three(self, seed: int, pair: int, other: int) -> Array:
        """Give (R, 3) random numbers: a pair, and the first of another pair."""
        return np.concatenate([self.numbers(seed, pair), self.numbers(seed, other)[:, :1]], axis=1)

    def numbers(self, seed: int, pair: int) -> Array:
        """Give (R, 2) random numbers for one of the pairs of this surface."""
        p = self.paths
        return pairs(p.pixel, p.sample, 1 + p.step * _PAIRS + pair, seed)
