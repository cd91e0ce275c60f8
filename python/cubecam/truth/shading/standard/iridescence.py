"""KHR_materials_iridescence: the reflectance of a thin film.

The text approximates Belcour and Barla 2017, "A Practical Extension to Microfacet Theory for the Modeling of Varying
Iridescence": Schlick's Fresnel at both interfaces, no polarisation, two orders of interference.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..vectors import Array
from .microfacets import schlick

XYZ_TO_REC709 = np.array(
    [
        [3.2404542, -1.5371385, -0.4985314],
        [-0.9692660, 1.8760108, 0.0415560],
        [0.0556434, -0.2040259, 1.0572252],
    ]
)


def ior_to_f0(transmitted: Any, incident: Any) -> Array:
    result: Array = ((transmitted - incident) / (transmitted + incident)) ** 2
    return result


def f0_to_ior(f0: Any) -> Array:
    """The index of a dielectric in air that reflects f0 at normal incidence."""
    root = np.sqrt(f0)
    result: Array = (1 + root) / (1 - root)
    return result


def sensitivity(path: Any, shift: Any) -> Array:
    """The eye's colour matching functions, as Gaussians, in the Fourier domain, in linear Rec. 709.

    path: the optical path difference in nanometres; shift: the phase, (..., 3).
    """
    phase = 2 * np.pi * path * 1e-9
    value = np.array([5.4856e-13, 4.4201e-13, 5.2481e-13])
    position = np.array([1.6810e06, 1.7953e06, 2.2084e06])
    variance = np.array([4.3278e09, 9.3046e09, 6.6121e09])
    xyz = (
        value
        * np.sqrt(2 * np.pi * variance)
        * np.cos(position * phase + shift)
        * np.exp(-(phase**2) * variance)
    )
    second = (
        9.7470e-14
        * np.sqrt(2 * np.pi * 4.5282e09)
        * np.cos(2.2399e06 * phase[..., 0] + shift[..., 0])
        * np.exp(-4.5282e09 * phase[..., 0] ** 2)
    )
    xyz = xyz + np.stack([second, 0 * second, 0 * second], axis=-1)
    result: Array = (xyz / 1.0685e-7) @ XYZ_TO_REC709.T
    return result


def iridescent_fresnel(
    cosine: Any, film_ior: Any, thickness: Any, base_f0: Any, outside_ior: float = 1.0
) -> Array:
    """The film's reflectance (..., 3), not below 0.

    cosine: (..., 1) of the angle outside. thickness: nanometres, (..., 1). base_f0: (..., 3), of the base in air.
    """
    cosine = np.clip(np.abs(np.asarray(cosine, float)), 0, 1)
    base_f0 = np.asarray(base_f0, float)
    film_ior, thickness = np.asarray(film_ior, float), np.asarray(thickness, float)
    cosine_2_squared = 1 - (outside_ior / film_ior) ** 2 * (1 - cosine**2)
    cosine_2 = np.sqrt(np.maximum(cosine_2_squared, 0))

    r12 = schlick(ior_to_f0(film_ior, outside_ior), 1.0, cosine)
    t121 = 1 - r12
    base_ior = f0_to_ior(np.clip(base_f0 + 0.0001, 0, 0.9999))
    r23 = schlick(ior_to_f0(base_ior, film_ior), 1.0, cosine_2)

    phi12 = np.where(film_ior < outside_ior, np.pi, 0.0)
    phi23 = np.where(base_ior < film_ior, np.pi, 0.0)
    phi = (np.pi - phi12) + phi23
    path = 2 * film_ior * thickness * cosine_2

    r123 = np.clip(r12 * r23, 1e-5, 0.9999)
    root = np.sqrt(r123)
    rs = t121**2 * r23 / (1 - r123)
    total = r12 + rs
    order = rs - t121
    for m in (1, 2):
        order = order * root
        total = total + order * 2 * sensitivity(m * path, m * phi)
    return np.where(cosine_2_squared < 0, 1.0, np.maximum(total, 0))


def schlick_to_f0(reflectance: Any, cosine: Any) -> Array:
    """The f0 with which Schlick's formula gives a reflectance at a cosine, with f90 = 1; between 0 and 1."""
    grazing = np.minimum((1 - np.clip(cosine, 0, 1)) ** 5, 0.9999)
    result: Array = np.clip((reflectance - grazing) / (1 - grazing), 0, 1)
    return result
