"""Directions as arrays (..., 3). Incident ones point towards the surface, normals to the side the light came from."""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Array: TypeAlias = npt.NDArray[np.float64]
#: One number for all points, or an array that broadcasts with them, such as (..., 1).
Numbers: TypeAlias = Array | float


def normalised(v: npt.ArrayLike) -> Array:
    v = np.asarray(v, float)
    result: Array = v / np.sqrt(dot(v, v))
    return result


def dot(a: npt.ArrayLike, b: npt.ArrayLike) -> Array:
    # numpy sums short rows slowly; einsum is about ten times as fast.
    result: Array = np.einsum("...i,...i->...", np.asarray(a), np.asarray(b))[..., None]
    return result


def reflect(incident: Array, normal: Array) -> Array:
    """GLSL reflect: I - 2 (N.I) N."""
    return incident - 2 * dot(normal, incident) * normal


def refract(incident: Array, normal: Array, eta: Numbers) -> Array:
    """GLSL refract (4.50 section 8.5) of unit vectors; eta = n_outside / n_inside; 0 where all light is reflected."""
    cos_i = dot(normal, incident)
    k = 1 - eta**2 * (1 - cos_i**2)
    bent = eta * incident - (eta * cos_i + np.sqrt(np.maximum(k, 0))) * normal
    return np.where(k < 0, 0.0, bent)
