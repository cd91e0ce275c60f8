"""A lobe of GGX microfacets at many points: its value, its density, and facets drawn from it.

Formulas as in `cubecam.truth.shading.standard.microfacets`; here the two alphas are the true ones, as small as
`SMOOTH`. Below it the lobe is a mirror, which has no value and no density.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Array
from ..shading.standard.microfacets import (
    half_way,
    smith_half_anisotropic,
    trowbridge_reitz_anisotropic,
)
from ..shading.standard.samples import visible_normal
from ..shading.vectors import dot

__all__ = ["SMOOTH", "GgxLobe"]

#: The alpha below which a lobe is a mirror.
SMOOTH = 1e-4


class GgxLobe:
    """The microfacets of R points as their viewers see them.

    Parameters
    ----------
    frame : three arrays (R, 3)
        Tangent, bitangent and normal, of length 1.
    v : array (R, 3)
        Unit vectors to the viewer.
    alpha_t, alpha_b : arrays (R, 1)
        Roughness squared along the tangent and along the bitangent.

    Notes
    -----
    Directions that the methods take and return are in the frame: z goes along the normal. `local` and `world` turn
    them. `smooth` (R, 1) tells which points are mirrors. Masking is separable, as in glTF 2.0 appendix B.3.
    """

    def __init__(self, frame: tuple[Array, Array, Array], v: Array, alpha_t: Any, alpha_b: Any):
        self.frame = frame
        self.v = self.local(v)
        shape = (len(v), 1)
        alpha_t, alpha_b = np.broadcast_to(alpha_t, shape), np.broadcast_to(alpha_b, shape)
        self.smooth = np.maximum(alpha_t, alpha_b) < SMOOTH
        self.alphas = np.maximum(alpha_t, SMOOTH), np.maximum(alpha_b, SMOOTH)
        self.faced = self.v[:, 2:] > 0
        self.half_v = self.smith_half(np.where(self.faced, self.v, (0.0, 0.0, 1.0)))

    def local(self, direction: Array) -> Array:
        return np.concatenate([dot(axis, direction) for axis in self.frame], -1)

    def world(self, direction: Array) -> Array:
        t, b, n = self.frame
        return direction[:, :1] * t + direction[:, 1:2] * b + direction[:, 2:] * n

    def smith_half(self, direction: Array) -> Array:
        """G1 / (2 z) of directions with z > 0."""
        x, y, z = direction[:, :1], direction[:, 1:2], direction[:, 2:]
        return smith_half_anisotropic(x, y, z, *self.alphas)

    def masking(self, direction: Array) -> Array:
        """G1 (R, 1) of directions on either side; 1 where the surface is smooth."""
        z = np.abs(direction[:, 2:])
        return np.where(self.smooth, 1.0, 2 * z * self.smith_half(np.abs(direction)))

    def facets(self, l: Array) -> Array:  # noqa: E741
        """D (R, 1) of the facets that reflect v to l."""
        h = half_way(self.v, l)
        return trowbridge_reitz_anisotropic(h[:, :1], h[:, 1:2], h[:, 2:], *self.alphas)

    def value(self, l: Array) -> Array:  # noqa: E741
        """D V (R, 1), the BRDF without Fresnel's term; 0 below the surface, and for mirrors."""
        lit = self.faced & (l[:, 2:] > 0) & ~self.smooth
        above = np.where(lit, l, (0.0, 0.0, 1.0))
        return np.where(lit, self.half_v * self.smith_half(above) * self.facets(above), 0.0)

    def density(self, l: Array) -> Array:  # noqa: E741
        """The density (R, 1) with which reflection by `facet` goes to l: D G1(v) / (4 n.v) (Heitz 2018, equation 19).

        Its integral over the sphere is 1: some reflected directions are below the surface. 0 for mirrors.
        """
        return np.where(self.faced & ~self.smooth, self.facets(l) * self.half_v / 2, 0.0)

    def facet(self, u: Array) -> Array:
        """Half vectors (R, 3) of the facets that v sees, from points u (R, 2) of the unit square."""
        up = np.array((0.0, 0.0, 1.0))
        v = np.where(self.faced, self.v, up)
        return np.where(self.smooth, up, visible_normal(v, u[:, :2].T, *self.alphas))
