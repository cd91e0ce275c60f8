"""How much each of several probes counts at a place: the weights of a `ProbeBlend`."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

from .vectors import Array


class Influence(NamedTuple):
    """Where a probe counts.

    Attributes
    ----------
    low, high : array_like (3,) or None
        Two opposite corners of the box in its own space, low < high. None: the probe counts everywhere.
    blend_distance : float
        How far outside of the shape it ceases to count, world units, above 0.
    shape : {"box", "sphere"}
        "sphere": the ellipsoid that the box encloses.
    matrix : array_like (4, 4) or None
        From the box's space to the world. None: the space is the world.
    """

    low: npt.ArrayLike | None = None
    high: npt.ArrayLike | None = None
    blend_distance: float = 1.0
    shape: str = "box"
    matrix: npt.ArrayLike | None = None


def distance_outside(positions: npt.ArrayLike, influence: Influence) -> Array:
    """The distance of points from an influence, in the world; 0 inside.

    A box: from the nearest point of the box in its own space. An ellipsoid: from its surface along the line to its
    middle. Both are the distance itself for boxes and spheres that are not stretched.

    Parameters
    ----------
    positions : array_like (..., 3)
        World.
    influence : Influence

    Returns
    -------
    ndarray (...) float64

    Examples
    --------
    >>> room = Influence((-1, -1, -1), (1, 1, 1))
    >>> distance_outside([(0, 0, 0), (3, 0, 0), (4, 5, 1)], room).tolist()
    [0.0, 2.0, 5.0]
    """
    p = np.asarray(positions, float)
    if influence.low is None or influence.high is None:
        return np.zeros(p.shape[:-1])
    low, high = np.asarray(influence.low, float), np.asarray(influence.high, float)
    matrix = np.eye(4) if influence.matrix is None else np.asarray(influence.matrix, float)
    local = (p - matrix[:3, 3]) @ np.linalg.inv(matrix[:3, :3]).T
    if influence.shape == "box":
        nearest = np.minimum(np.maximum(local, low), high)
    else:
        middle, half = (low + high) / 2, (high - low) / 2
        radius = np.sqrt((((local - middle) / half) ** 2).sum(axis=-1, keepdims=True))
        nearest = np.where(radius > 1, middle + (local - middle) / np.maximum(radius, 1), local)
    away = (local - nearest) @ matrix[:3, :3].T
    distance: Array = np.sqrt((away * away).sum(axis=-1))
    return distance


def weights(positions: npt.ArrayLike, influences: Sequence[Influence]) -> Array:
    """The weights of several probes, and of the scene's environment as the last one; they sum to 1.

    An influence is w = 1 - 3 t^2 + 2 t^3, with t the distance over the blend distance, at most 1. The blend distance is
    that of engines (Unity, "Reflection Probe: blend distance"; S. Lagarde, A. Zanuttini, "Local image-based lighting
    with parallax-corrected cubemaps", SIGGRAPH 2012 talks, blend by the distance to an inner volume, too); the cubic
    has no kink at either end. Weights are w / max(1, sum w), and the rest, 1 - min(1, sum w), is the environment's.

    Parameters
    ----------
    positions : array_like (..., 3)
        World.
    influences : sequence of Influence
        Of n probes.

    Returns
    -------
    ndarray (..., n + 1) float64

    Examples
    --------
    Half way through the blend distance of one room, inside of another:

    >>> rooms = Influence((-2, 0, 0), (0, 1, 1)), Influence((0, 0, 0), (2, 1, 1))
    >>> weights((0.5, 0.5, 0.5), rooms).round(4).tolist()
    [0.3333, 0.6667, 0.0]
    """
    shares = []
    for influence in influences:
        t = np.minimum(distance_outside(positions, influence) / influence.blend_distance, 1)
        shares.append(1 - t * t * (3 - 2 * t))
    w = np.stack(shares, axis=-1)
    total = w.sum(axis=-1, keepdims=True)
    return np.concatenate([w / np.maximum(total, 1), 1 - np.minimum(total, 1)], axis=-1)
