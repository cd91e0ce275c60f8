"""How StandardMaterial scatters light, for paths of rays: values, densities, and directions drawn from them.

It is the material of `cubecam.truth.shading.standard`, whose sums for lights (`lit_base`, `lit_coat`) and for the
environment are approximations of the integral that paths take: here alphas are the true ones down to mirrors, and the
light that facets pass to each other is a Lambertian lobe (Fdez-Aguera 2019). Arrays have one row for each of R points:
scalars (R, 1), colours and directions (R, 3), float64. Units are those of light: a scattered radiance is
`evaluate` times the irradiance of a surface that faces the light.
"""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ..arrays import Array
from ..shading.standard.material import Parameters, Surface
from .scattering import Sampled, StandardBsdf

__all__ = ["Sampled", "StandardBsdf", "evaluate", "extinction", "pdf", "sample", "sample_exit"]


def evaluate(p: Parameters, surface: Surface, l: Array) -> Array:  # noqa: E741
    """The BRDF times n.l, without mirrors and without emission.

    It is `mix(lit_base, lit_coat, clearcoat * F)` of `cubecam.truth.shading.standard.shade` with the true alphas and,
    where `p.multiple_scattering` holds, Fms / pi for the light that facets pass to each other (Fdez-Aguera 2019,
    "A Multiple-Scattering Microfacet Model for Real-Time Image-based Lighting"). The diffuse base gets the share
    1 - max3(Fss + Fms), as in the renderer's environment: with the share of the one facet that reflects a lamp
    (glTF 2.0, B.3.5), a white surface would send back more light than it gets.

    Parameters
    ----------
    p, surface
        As for `StandardBsdf`.
    l : array (R, 3)
        Unit vectors to the light.

    Returns
    -------
    array (R, 3)
        Per steradian; 0 for directions below the geometric normal.
    """
    return StandardBsdf(p, surface).evaluate(l)


def pdf(p: Parameters, surface: Surface, l: Array) -> Array:  # noqa: E741
    """The density (R, 1), per steradian, with which `sample` draws a reflected direction l (R, 3).

    Its integral over the sphere is the probability of the lobes that are neither mirrors nor go through the surface. A
    part of it is below the surface, where samples have weight 0.
    """
    return StandardBsdf(p, surface).pdf(l)


def sample(
    p: Parameters, surface: Surface, u: Array, channel: npt.NDArray[np.intp] | None = None
) -> Sampled:
    """Draw where each path goes on, at a surface that it meets from outside.

    Parameters
    ----------
    p, surface
        As for `StandardBsdf`.
    u : array (R, 3)
        Numbers in [0, 1): two for the direction, one for the lobe.
    channel : int array (R,), optional
        The channel that a path carries alone since an earlier dispersion, or -1.

    Notes
    -----
    Facets are those that the viewer sees (Dupuy and Benyoub 2023). A reflected direction's weight is `evaluate` over
    the density of all its lobes together. Through a thin wall (`thickness` 0) goes the reflected direction, mirrored
    at the surface (KHR_materials_transmission). Into a body it is refracted at a facet (Walter et al. 2007, section 5);
    a radiance is not scaled with the square of the index, which cancels where the path leaves the body.
    """
    return StandardBsdf(p, surface).sample(u, channel)


def sample_exit(
    p: Parameters, surface: Surface, u: Array, channel: npt.NDArray[np.intp] | None = None
) -> Sampled:
    """Draw where each path goes on that meets the surface from inside the body.

    Parameters are as for `sample`; the normals of `surface` point into the body, where the path comes from.
    `transmitted` holds where it leaves. Nothing is coloured here, since `sample` has done it at the entry; sheen, clear
    coat and the light that facets pass to each other are left out.
    """
    return StandardBsdf(p, surface).sample_exit(u, channel)


def extinction(p: Parameters) -> Array:
    """KHR_materials_volume: the part (..., 3) of light that a body takes for each unit of way, as an exponent.

    Light keeps exp(-extinction * length), which is attenuation_color ** (length / attenuation_distance).
    """
    color = np.maximum(np.asarray(p.attenuation_color, float), 1e-300)
    result: Array = -np.log(color) / np.asarray(p.attenuation_distance, float)
    return result
