"""Lights, plain numbers: where they are, and how much of their light arrives."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from .vectors import Array, Numbers, dot, normalised


@dataclass
class Point:
    position: Sequence[float]
    color: Sequence[float] = (1, 1, 1)
    intensity: float = 1.0
    decay: float = 0.0
    range: float = np.inf


@dataclass
class Directional:
    """A directional light; `travels` is the direction in which its light goes, from the lamp to the scene."""

    travels: Sequence[float]
    color: Sequence[float] = (1, 1, 1)
    intensity: float = 1.0


@dataclass
class Spot:
    """A spot light of KHR_lights_punctual.

    `angle` is half the cone's opening in degrees; `penumbra` is the share of it over which the light fades.
    """

    position: Sequence[float]
    travels: Sequence[float] = (0, -1, 0)
    angle: float = 30.0
    penumbra: float = 0.0
    color: Sequence[float] = (1, 1, 1)
    intensity: float = 1.0
    decay: float = 0.0
    range: float = np.inf

    def share(self, to_light: Array) -> Array:
        """The share of light along unit vectors to the lamp: the square of what lies between the cosines of the edge
        and of the inner cone."""
        cosine = dot(-to_light, normalised(self.travels))
        edge = np.cos(np.radians(self.angle))
        full = np.cos(np.radians(self.angle * (1 - self.penumbra)))
        if full == edge:
            return np.where(cosine > edge, 1.0, 0.0)
        t: Array = np.clip((cosine - edge) / (full - edge), 0, 1)
        return t * t


@dataclass
class Ambient:
    color: Sequence[float] = (1, 1, 1)
    intensity: float = 1.0


Light: TypeAlias = Point | Directional | Spot | Ambient


def falloff(light: Point | Spot, distance: Numbers) -> Array:
    """The share of light at a distance: distance^-decay, and the window of KHR_lights_punctual's range."""
    window: Array = np.clip(1 - (distance / light.range) ** 4, 0, 1)
    return window / distance**light.decay


def way_to(light: Point | Directional | Spot, position: Array) -> tuple[Array, Array]:
    """Unit vectors from points to a light, and the distances, which are infinite for a light that is far away."""
    if isinstance(light, Directional):
        return np.broadcast_to(-normalised(light.travels), position.shape), np.full(
            (*position.shape[:-1], 1), np.inf
        )
    offset = np.asarray(light.position, float) - position
    distance = np.sqrt(dot(offset, offset))
    return offset / distance, distance
