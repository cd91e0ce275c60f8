"""Both ways of light at a surface of `GlassMaterial`: reflected and refracted, at facets if the glass is rough."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Array, Bools
from ..shading.fresnel import fresnel_dielectric
from ..shading.standard.microfacets import smith_half
from ..shading.standard.samples import frame_around, visible_normal
from ..shading.vectors import dot, reflect, refract

#: Below this alpha a surface is a perfect mirror; a facet then differs from the surface by less than a thousandth.
SMOOTH = 1e-4


@dataclass
class Way:
    """The direction in which each path goes on (R, 3), its weight (R, 1), and whether it went through the surface."""

    direction: Array
    weight: Array
    through: Bools


def glass_way(
    normal: Array, view: Array, eta: Array, alpha: float, fresnel: bool, numbers: Array
) -> Way:
    """Choose one of both ways for each path, by the share of light that takes it.

    Parameters
    ----------
    normal : ndarray (R, 3)
        Unit normals on the side that the ray comes from.
    view : ndarray (R, 3)
        Unit directions back along the ray.
    eta : ndarray (R, 1)
        Index of refraction on the ray's side over that beyond the surface.
    alpha : float
        Of the facets, the square of the roughness.
    fresnel : bool
        Whether the surface reflects by Fresnel's equations; if not, only where all light is reflected.
    numbers : ndarray (R, 3)
        From 0 to 1: two for the facet, one for the choice.

    Notes
    -----
    B. Walter et al., "Microfacet Models for Refraction through Rough Surfaces", EGSR 2007: facets are chosen among
    those that the ray sees, so that the weight is the share of light that the other facets let through.
    """
    facet = normal
    if alpha >= SMOOTH:
        tangent, bitangent = frame_around(normal)
        local = np.concatenate([dot(tangent, view), dot(bitangent, view), dot(normal, view)], -1)
        local[:, 2] = np.maximum(local[:, 2], 1e-4)
        h = visible_normal(local, numbers.T, alpha, alpha)
        facet = h[:, :1] * tangent + h[:, 1:2] * bitangent + h[:, 2:] * normal
    cosine = dot(facet, view)
    refracted = refract(-view, facet, eta)
    total = (refracted * refracted).sum(-1) == 0
    share = fresnel_dielectric(cosine, eta)[:, 0] if fresnel else total.astype(np.float64)
    share = np.where(total, 1.0, share)
    through = numbers[:, 2] >= share
    direction = np.where(through[:, None], refracted, reflect(-view, facet))
    weight = np.ones_like(cosine)
    if alpha >= SMOOTH:
        # A facet sends light below the surface that it should stay above, and the other way round: that is lost.
        side = dot(normal, direction)[:, 0]
        right = np.where(through, side < 0, side > 0)
        towards = np.maximum(np.abs(side), 1e-6)[:, None]
        weight = np.where(right[:, None], 2 * towards * smith_half(towards, alpha), 0.0)
    return Way(direction, weight, through)
