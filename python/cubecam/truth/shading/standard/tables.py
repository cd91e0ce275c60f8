"""Integrals of the lobes over all lights: what the split sum of Karis 2013 and the sheen's albedo need.

Everything is a sum over midpoints. The error halves with each doubling of both counts or falls faster.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from ..vectors import Array
from .microfacets import SMALLEST_SHEEN_ALPHA, charlie, charlie_visibility, smith_half


def _midpoints(count: int) -> Array:
    return (np.arange(count) + 0.5) / count


def _half_vectors(alpha: float, turns: int, steps: int) -> tuple[Array, Array, Array]:
    """x and z of half vectors, and the share of facets that each stands for, for a viewer in the plane y = 0.

    Facets are cut into shares that become smaller towards the steep ones, where the integrand has its bends.
    """
    phi = np.pi * _midpoints(turns)[:, None]  # the other half is its mirror image
    left = (1 - np.arange(steps + 1) / steps) ** 3
    share = (left[:-1] - left[1:]) / turns
    u = 1 - (left[:-1] + left[1:]) / 2
    cosine = np.sqrt((1 - u) / (1 + (alpha**2 - 1) * u))
    sine = np.sqrt(np.maximum(1 - cosine**2, 0))
    z, share = (np.broadcast_to(row, (turns, steps)).ravel() for row in (cosine, share))
    return (sine * np.cos(phi)).ravel(), z, share


def _scale_and_bias(n_v: Any, roughness: float, turns: int = 24, steps: int = 256) -> Array:
    """For one roughness: (..., 2) of n_v (...,)."""
    alpha = max(float(roughness) ** 2, 1e-4)
    x, z, share = _half_vectors(alpha, turns, steps)
    cosine = np.clip(np.asarray(n_v, float), 1e-4, 1)[..., None]
    v_h = np.sqrt(1 - cosine**2) * x + cosine * z
    n_l = 2 * v_h * z - cosine
    lit = (n_l > 0) & (v_h > 0)
    n_l = np.where(lit, n_l, 1)
    visibility = smith_half(n_l, alpha) * smith_half(cosine, alpha)
    weight = np.where(lit, visibility * 4 * v_h * n_l / z, 0)
    grazing = (1 - np.clip(v_h, 0, 1)) ** 5
    return np.stack([(weight * (1 - grazing)) @ share, (weight * grazing) @ share], -1)


def _sheen_albedo(n_v: Any, roughness: float, turns: int = 32, steps: int = 256) -> Array:
    """The integral of D V n.l over the hemisphere of l, for one sheen roughness.

    In the angle between h and n the distribution has no peak that midpoints miss, except at the horizon, where
    substituting the sine puts more of them: directions are drawn by h, whose density of l is 1 / (4 v.h).
    """
    alpha = max(float(roughness) ** 2, SMALLEST_SHEEN_ALPHA)
    power = 1 / alpha
    # The density of the sine s is proportional to s^(power + 1), whose integral is inverted.
    sine = _midpoints(steps) ** (1 / (power + 2))
    cosine_h = np.sqrt(1 - sine**2)
    phi = np.pi * _midpoints(turns)[:, None]  # the other half is its mirror image
    x, z = (sine * np.cos(phi)).ravel(), np.broadcast_to(cosine_h, (turns, steps)).ravel()
    s = np.broadcast_to(sine, (turns, steps)).ravel()
    # In s and phi the solid angle is s / cosine_h ds dphi.
    density = (power + 2) * s ** (power + 1) / (2 * np.pi) * z / s
    cosine = np.clip(np.asarray(n_v, float), 1e-4, 1)[..., None]
    v_h = np.sqrt(1 - cosine**2) * x + cosine * z
    n_l = 2 * v_h * z - cosine
    lit = (n_l > 0) & (v_h > 0)
    n_l = np.where(lit, n_l, 1)
    value = charlie(z, roughness) * charlie_visibility(cosine, n_l, roughness) * n_l * 4 * v_h
    result: Array = np.where(lit, value / density, 0).mean(-1)
    return result


#: Cosines of the table, denser where the terms change faster; and roughnesses for maps of them.
COSINES = np.linspace(np.sqrt(1e-4), 1, 96) ** 2
ROUGHNESSES = np.linspace(0, 1, 65)


@lru_cache(maxsize=256)
def _row(function: Callable[[Array, float], Array], roughness: float) -> Array:
    return function(COSINES, roughness)


def _looked_up(function: Callable[[Array, float], Array], n_v: Any, roughness: Any) -> Array:
    """The integral at arrays of cosines and roughnesses, interpolated over the cosine.

    A few values of roughness are taken as they are; for more of them, it interpolates between ROUGHNESSES.
    """
    n_v, roughness = np.broadcast_arrays(
        np.clip(np.asarray(n_v, float), 1e-4, 1), np.asarray(roughness, float)
    )
    values = np.unique(roughness)
    known = values if len(values) <= 8 else ROUGHNESSES
    rows = np.stack([_row(function, float(value)) for value in known])
    rows = rows.reshape(len(known), len(COSINES), -1)

    place = np.interp(roughness, known, np.arange(len(known)))
    low = np.clip(np.floor(place).astype(int), 0, max(len(known) - 2, 0))
    high = np.minimum(low + 1, len(known) - 1)
    along = np.interp(np.sqrt(n_v), np.sqrt(COSINES), np.arange(len(COSINES)))
    left = np.clip(np.floor(along).astype(int), 0, len(COSINES) - 2)
    fy, fx = (place - low)[..., None], (along - left)[..., None]
    at_low = rows[low, left] * (1 - fx) + rows[low, left + 1] * fx
    at_high = rows[high, left] * (1 - fx) + rows[high, left + 1] * fx
    result: Array = at_low * (1 - fy) + at_high * fy
    return result


def brdf_terms(n_v: Any, roughness: Any) -> Array:
    """A and B of single scattering, F0 A + F90 B, for arrays (...): (..., 2)."""
    return _looked_up(_scale_and_bias, n_v, roughness)


def sheen_albedo(n_v: Any, sheen_roughness: Any) -> Array:
    """E of KHR_materials_sheen for arrays (...): (...)."""
    return _looked_up(_sheen_albedo, n_v, sheen_roughness)[..., 0]
