"""The share of light that a surface reflects."""

from __future__ import annotations

from typing import Any

import numpy as np

from .vectors import Array, Numbers


def schlick(f0: Any, cos_theta: Numbers) -> Any:
    """Fresnel by Schlick, "An Inexpensive BRDF Model for Physically-based Rendering", 1994."""
    return f0 + (1 - f0) * (1 - np.clip(cos_theta, 0, 1)) ** 5


def fresnel_dielectric(cos_i: Numbers, eta: Numbers) -> Array:
    """Unpolarised reflectance by Fresnel's equations; eta = n_outside / n_inside; 1 beyond the critical angle."""
    cos_i = np.clip(cos_i, 0, 1)
    sin_t2 = eta**2 * (1 - cos_i**2)
    cos_t = np.sqrt(np.maximum(1 - sin_t2, 0))
    with np.errstate(invalid="ignore"):  # 0 / 0 beyond the critical angle
        parallel = (cos_i - eta * cos_t) / (cos_i + eta * cos_t)
        perpendicular = (eta * cos_i - cos_t) / (eta * cos_i + cos_t)
    return np.where(sin_t2 >= 1, 1.0, (parallel**2 + perpendicular**2) / 2)
