"""What rays see that meet nothing."""

from __future__ import annotations

import numpy as np

from ..arrays import Array, Bools, Ints
from ..scene.snapshot import Snapshot
from .light_directions import LARGEST, LightDirections
from .state import Paths

#: Places in `Snapshot.surroundings`.
_ENVIRONMENT, _BACKGROUND = 0, 1


class FarLight:
    """The backgrounds and environments of a snapshot.

    A ray from a surface sees the node's own cubemap, the background if the node shows a probe, as captures do, and else
    the scene's environment, or the background in a scene without one.
    """

    def __init__(self, snapshot: Snapshot) -> None:
        self._ambient = snapshot.ambient
        self._all = snapshot.surroundings
        own = np.array([n.surroundings for n in snapshot.nodes], np.int64)
        dark = self._all[_ENVIRONMENT].kind == "none"
        self._missed = np.where((own == _ENVIRONMENT) & dark, _BACKGROUND, own)
        self._ended = np.where(own == _BACKGROUND, _ENVIRONMENT, own)
        self._known: dict[int, LightDirections | None] = {}

    def seen_from(self, node: Ints, unblocked: Bools) -> Ints:
        """Give what rays (R,) that leave nodes see: at the end of a path, the environment instead of the background."""
        return np.where(unblocked, self._ended[node], self._missed[node])

    def light(self, paths: Paths) -> Array:
        """Give the light and alpha (R, 4) that rays see which meet nothing, less what `toward` has counted of it."""
        light = np.zeros((len(paths), 4))
        around = np.where(paths.surroundings < 0, _BACKGROUND, paths.surroundings)
        for index in np.unique(around):
            rows = np.flatnonzero(around == index)
            seen = self._all[index].at(paths.direction[rows])
            seen[:, :3] = np.where(paths.ambient[rows, None], finite(seen[:, :3]), seen[:, :3])
            own = paths.density[rows, None]
            directions = self._directions(index) if own.any() else None
            if directions is not None:
                other = directions.density(paths.direction[rows])
                seen[:, :3] *= np.where(own > 0, balance(own, other), 1.0)
            light[rows] = seen
        light[:, :3] += np.where(paths.ambient[:, None], self._ambient, 0.0)
        return light

    def toward(self, around: Ints, numbers: Array) -> tuple[Array, Array, Array]:
        """Choose directions by their brightness.

        Give unit directions (R, 3), their densities (R,), and the light from there (R, 3), for numbers (R, 3); a
        density is 0 where the surroundings are equally bright on all sides, or dark.
        """
        direction = np.zeros((len(around), 3))
        density, light = np.zeros(len(around)), np.zeros((len(around), 3))
        for index in np.unique(around):
            chosen = self._directions(index)
            if chosen is None:
                continue
            rows = np.flatnonzero(around == index)
            direction[rows], dense = chosen.sample(numbers[rows])
            density[rows] = dense[:, 0]
            light[rows] = finite(self._all[index].at(direction[rows])[:, :3])
        return direction, density, light

    def _directions(self, index: int) -> LightDirections | None:
        """Give the directions of a cubemap's light, which rough surfaces alone need; None if it has none."""
        if index not in self._known:
            radiance = self._all[index]
            made = None
            if radiance.cube is not None:
                made = LightDirections(np.asarray(radiance.cube.faces), radiance.turn)
            self._known[index] = None if made is None or made.dark else made
        return self._known[index]


def finite(light: Array) -> Array:
    """Count infinite light as the largest number of a photograph (docs/conventions.md, "Light of whole cubes")."""
    return np.nan_to_num(light, nan=0.0, posinf=LARGEST, neginf=-LARGEST)


def balance(own: Array, other: Array) -> Array:
    """Give the weight of one of two ways to choose a direction: E. Veach, "Robust Monte Carlo Methods", 1997, 9.2.2."""
    return np.asarray(own / np.maximum(own + other, 1e-300))
