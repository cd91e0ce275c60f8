"""Directions that a rough surface reflects or refracts, after GGX.

B. Walter, S. R. Marschner, H. Li and K. E. Torrance, "Microfacet Models for Refraction through Rough Surfaces",
Eurographics Symposium on Rendering, 2007; equations are numbered as there. A rough surface is made of smooth facets,
whose normals m are spread about the surface's normal n. ``alpha = roughness**2`` is the width of the spread: B. Burley,
"Physically-Based Shading at Disney", 2012.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from ..optics import reflect, refract

__all__ = ["density", "distribution", "facet_normals", "lobe", "shadowing"]

Floats = npt.NDArray[np.float64]


def distribution(cosine: npt.ArrayLike, alpha: float) -> Floats:
    """Give D(m), the density of facets for the cosine between m and n (equation 33); 0 for facets turned away."""
    c = np.asarray(cosine, float)
    inside = c * c * (alpha * alpha - 1) + 1
    return np.where(c > 0, alpha * alpha / (np.pi * inside * inside), 0.0)


def shadowing(cosine: npt.ArrayLike, alpha: float) -> Floats:
    """Give G1, the share of facets that are seen under the cosine between a direction and n (equation 34)."""
    c = np.clip(np.abs(np.asarray(cosine, float)), 1e-9, 1)
    tangent = (1 - c * c) / (c * c)
    return np.asarray(2 / (1 + np.sqrt(1 + alpha * alpha * tangent)))


def facet_normals(normal: npt.ArrayLike, alpha: float, count: int) -> Floats:
    """Give facet normals (count, 3) that are spread as D(m) |m.n| (equations 24, 35 and 36).

    The two numbers for each are Hammersley's points, so that the same call gives the same normals.
    """
    n = np.asarray(normal, float)
    k = np.arange(count)
    first = (k + 0.5) / count
    second = _radical_inverse(k)
    tangent = alpha * np.sqrt(first / (1 - first))
    cosine = 1 / np.sqrt(1 + tangent * tangent)
    sine = tangent * cosine
    side = np.eye(3)[np.abs(n).argmin()]
    across = np.cross(side, n)
    across /= np.linalg.norm(across)
    turn = 2 * np.pi * second
    along = np.cos(turn)[:, None] * across + np.sin(turn)[:, None] * np.cross(n, across)
    return np.asarray(sine[:, None] * along + cosine[:, None] * n)


def _radical_inverse(k: npt.NDArray[Any]) -> Floats:
    """Mirror the binary digits of whole numbers at the point: van der Corput's sequence."""
    result, share = np.zeros(len(k)), 0.5
    while k.any():
        result += share * (k & 1)
        k, share = k >> 1, share / 2
    return result


def lobe(
    incident: npt.ArrayLike, normal: npt.ArrayLike, alpha: float, count: int, eta: float | None
) -> tuple[Floats, Floats]:
    """Send `incident` to the facets of `facet_normals`, and give where it goes on and how much each counts.

    Parameters
    ----------
    incident : (3,)
        Points TOWARDS the surface; `normal` is on the side that it comes from. Both have length 1.
    alpha : float
        Above 0.
    count : int
        Facets.
    eta : float or None
        None: reflected. A number: refracted, as `cc.refract`.

    Returns
    -------
    directions : (K, 3)
        Of length 1. K is less than `count`, because some facets are seen from behind, send the light back through the
        surface, or refract nothing.
    weights : (K,)
        ``|i.m| G(i, o, m) / (|i.n| |m.n|)`` of equation 41, without Fresnel's term.
    """
    i, n = np.asarray(incident, float), np.asarray(normal, float)
    m = facet_normals(n, alpha, count)
    towards = np.broadcast_to(i, m.shape)
    out = reflect(towards, m) if eta is None else refract(towards, m, eta)
    side = out @ n
    good = (m @ i < 0) & (side > 0 if eta is None else side < 0)
    m, out = m[good], out[good]
    g = shadowing(i @ n, alpha) * shadowing(out @ n, alpha)
    weights = np.abs(m @ i) * g / (abs(float(i @ n)) * np.abs(m @ n))
    return np.asarray(out, float), np.asarray(weights)


def density(
    outgoing: npt.ArrayLike,
    incident: npt.ArrayLike,
    normal: npt.ArrayLike,
    alpha: float,
    eta: float | None,
) -> Floats:
    """Give how densely `lobe` spreads directions: per unit of solid angle, for directions (..., 3) of length 1.

    ``D(m) |m.n|`` times the Jacobian of the half vector, equations 14 and 17; 0 where no facet sends light.
    """
    o, i, n = (np.asarray(v, float) for v in (outgoing, incident, normal))
    # Walter's i points away from the surface; here it points towards it.
    if eta is None:
        half = o - i
        side = o @ n > 0
    else:
        # Equation 16 with eta = n_i / n_o, divided by n_o; turned to the side of n.
        half = eta * i - o
        half = half * np.sign(half @ n)[..., None]
        side = o @ n < 0
    length = np.linalg.norm(half, axis=-1)
    with np.errstate(divide="ignore", invalid="ignore"):
        m = half / length[..., None]
        im, om = m @ -i, np.einsum("...k,...k->...", m, o)
        if eta is None:
            jacobian = 1 / (4 * np.abs(om))
            facing = (im > 0) & (om > 0)
        else:
            jacobian = np.abs(om) / (eta * im + om) ** 2
            facing = (im > 0) & (om < 0)
        found = distribution(m @ n, alpha) * np.abs(m @ n) * jacobian
    return np.where(side & facing & np.isfinite(found), found, 0.0)
