"""The state of many paths at once: arrays with a row for each path."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, fields

import numpy as np

from ..arrays import Array, Bools, Ints

#: Bodies of glass that may lie in each other.
NESTED = 4


@dataclass
class Paths:
    """R paths, each with the ray that it follows next."""

    origin: Array  # (R, 3), world
    direction: Array  # (R, 3), unit length
    reach: Array  # (R,), where the ray ends; infinite but for a camera's far plane
    factor: Array  # (R, 4): how much of the light, and of alpha, counts for the picture
    slot: Ints  # (R,): the row of the sums to which the light is added
    pixel: Ints  # (R,): for random numbers, as `sample` and `step`
    sample: Ints
    step: Ints  # (R,): surfaces met so far
    bounces: Ints  # (R,): of these, mirrors, glass and rough surfaces that the path left
    start: Ints  # (R,): the triangle that the ray left, -1 for none
    left: Ints  # (R,): its node, -1 for none
    crossed: Bools  # (R,): whether it went through this triangle
    reflected: Bools  # (R,): whether the ray left a surface, so that it sees what captures see
    surroundings: Ints  # (R,): what it sees where it meets nothing, -1 for the background
    ambient: Bools  # (R,): whether it sees ambient light, too
    density: Array  # (R,): with which a rough surface chose the direction; 0 if it had no choice
    unblocked: Bools  # (R,): whether nothing stands in the way, at the end of the path
    bodies: Ints  # (R, NESTED): nodes of the bodies that the ray is in, the innermost first, -1 for none
    channel: Ints  # (R,): the one colour that counts after dispersion, -1 for all

    def __len__(self) -> int:
        return len(self.slot)

    def rows(self, chosen: Ints | Bools) -> Paths:
        """Give some of the paths."""
        return Paths(**{f.name: getattr(self, f.name)[chosen] for f in fields(Paths)})

    def copy(self) -> Paths:
        """Give the same paths in arrays of their own."""
        return Paths(**{f.name: getattr(self, f.name).copy() for f in fields(Paths)})


def joined(parts: Sequence[Paths]) -> Paths:
    """Give the paths of all parts."""
    return Paths(
        **{f.name: np.concatenate([getattr(p, f.name) for p in parts]) for f in fields(Paths)}
    )


def first_paths(
    origin: Array, direction: Array, reach: Array, pixel: Ints, sample: Ints, slot: Ints
) -> Paths:
    """Give paths that start at an eye, which is in no body, and see the background."""
    count = len(slot)
    return Paths(
        origin=origin,
        direction=direction,
        reach=reach,
        factor=np.ones((count, 4)),
        slot=slot,
        pixel=pixel,
        sample=sample,
        step=np.zeros(count, np.int64),
        bounces=np.zeros(count, np.int64),
        start=np.full(count, -1),
        left=np.full(count, -1),
        crossed=np.zeros(count, np.bool_),
        reflected=np.zeros(count, np.bool_),
        surroundings=np.full(count, -1),
        ambient=np.zeros(count, np.bool_),
        density=np.zeros(count),
        unblocked=np.zeros(count, np.bool_),
        bodies=np.full((count, NESTED), -1),
        channel=np.full(count, -1),
    )


def entered(bodies: Ints, node: Ints) -> Ints:
    """Give the bodies of rays that enter a node, too."""
    return np.concatenate([node[:, None], bodies[:, :-1]], axis=1)


def left_body(bodies: Ints) -> Ints:
    """Give the bodies of rays that leave the innermost one."""
    return np.concatenate([bodies[:, 1:], np.full((len(bodies), 1), -1)], axis=1)
