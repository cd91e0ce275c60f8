"""Distributions, masking and Fresnel terms: glTF 2.0 appendix B.3, KHR_materials_anisotropy, KHR_materials_sheen.

Every `*_from` function takes components of h or of a direction x along the tangent t, the bitangent b and the
normal n. An isotropic lobe is the one with two equal alphas.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..vectors import Array, dot

#: Of lights, whose reflection would be a point without area at 0.
SMALLEST_ALPHA = 1 / 1024
SMALLEST_SHEEN_ALPHA = 1e-3


def max3(color: Any) -> Array:
    color = np.asarray(color)
    result: Array = np.maximum(np.maximum(color[..., :1], color[..., 1:2]), color[..., 2:])
    return result


def mix(a: Any, b: Any, share: Any) -> Any:
    return a + (b - a) * share


def half_way(v: Array, l: Array) -> Array:  # noqa: E741
    h = v + l
    result: Array = h / np.maximum(np.sqrt(dot(h, h)), 1e-12)
    return result


def schlick(f0: Any, f90: Any, cosine: Any) -> Array:
    """Schlick 1994, appendix B.3.3: f0 + (f90 - f0) (1 - cosine)^5."""
    result: Array = f0 + (f90 - f0) * (1 - np.clip(np.abs(cosine), 0, 1)) ** 5
    return result


def trowbridge_reitz(n_h: Any, alpha: Any) -> Array:
    """The share of microfacets per solid angle around h, appendix B.3.1; the integral of D n.h is 1."""
    squared = alpha**2
    return np.where(n_h > 0, squared / (np.pi * (n_h**2 * (squared - 1) + 1) ** 2), 0.0)


def trowbridge_reitz_anisotropic(t_h: Any, b_h: Any, n_h: Any, alpha_t: Any, alpha_b: Any) -> Array:
    """KHR_materials_anisotropy: two alphas, along the tangent and along the bitangent."""
    area = alpha_t * alpha_b
    squared = (alpha_b * t_h) ** 2 + (alpha_t * b_h) ** 2 + (area * n_h) ** 2
    return np.where(n_h > 0, area**3 / (np.pi * squared**2), 0.0)


def smith_half(n_x: Any, alpha: Any) -> Array:
    """G1(x) / (2 n.x) of appendix B.3.1: 1 / (n.x + sqrt(alpha^2 + (1 - alpha^2) (n.x)^2))."""
    result: Array = 1 / (n_x + np.sqrt(alpha**2 + (1 - alpha**2) * n_x**2))
    return result


def smith_half_anisotropic(t_x: Any, b_x: Any, n_x: Any, alpha_t: Any, alpha_b: Any) -> Array:
    """The same with the length of (alpha_t t.x, alpha_b b.x, n.x) for the root (Heitz 2014, section 5.4)."""
    result: Array = 1 / (n_x + np.sqrt((alpha_t * t_x) ** 2 + (alpha_b * b_x) ** 2 + n_x**2))
    return result


def specular_brdf(n: Array, v: Array, l: Array, alpha: Any) -> Array:  # noqa: E741
    """V D of appendix B.3.1 with separable masking, V = G / (4 n.l n.v); 0 below the surface."""
    n_v, n_l, n_h = dot(n, v), dot(n, l), dot(n, half_way(v, l))
    above = (n_v > 0) & (n_l > 0)
    visibility = smith_half(np.where(above, n_v, 1), alpha) * smith_half(
        np.where(above, n_l, 1), alpha
    )
    return np.where(above, visibility * trowbridge_reitz(n_h, alpha), 0.0)


def specular_brdf_anisotropic(
    frame: tuple[Array, Array, Array],
    v: Array,
    l: Array,  # noqa: E741
    alpha_t: Any,
    alpha_b: Any,
) -> Array:
    """The same with two alphas; frame: the vectors t, b, n."""
    t, b, n = frame
    h = half_way(v, l)
    n_v, n_l = dot(n, v), dot(n, l)
    above = (n_v > 0) & (n_l > 0)
    visibility = smith_half_anisotropic(
        dot(t, v), dot(b, v), np.where(above, n_v, 1), alpha_t, alpha_b
    ) * smith_half_anisotropic(dot(t, l), dot(b, l), np.where(above, n_l, 1), alpha_t, alpha_b)
    density = trowbridge_reitz_anisotropic(dot(t, h), dot(b, h), dot(n, h), alpha_t, alpha_b)
    return np.where(above, visibility * density, 0.0)


def charlie(n_h: Any, sheen_roughness: Any) -> Array:
    """Conty and Kulla 2017, "Production Friendly Microfacet Sheen BRDF", as KHR_materials_sheen has it."""
    power = 1 / np.maximum(np.asarray(sheen_roughness, float) ** 2, SMALLEST_SHEEN_ALPHA)
    sine = np.sqrt(np.clip(1 - n_h**2, 0, 1))
    result: Array = (2 + power) * sine**power / (2 * np.pi)
    return result


def _charlie_fit(x: Any, alpha: Any) -> Array:
    share = (1 - alpha) ** 2
    a = mix(21.5473, 25.3245, share)
    b = mix(3.82987, 3.32435, share)
    c = mix(0.19823, 0.16801, share)
    d = mix(-1.97760, -1.27393, share)
    e = mix(-4.32054, -4.85967, share)
    result: Array = a / (1 + b * x**c) + d * x + e
    return result


def charlie_lambda(cosine: Any, alpha: Any) -> Array:
    """The fit of lambda in the same paper, mirrored at a cosine of a half."""
    low = cosine < 0.5
    fit = _charlie_fit(np.where(low, cosine, 1 - np.clip(cosine, 0.5, 1)), alpha)
    result: Array = np.exp(np.where(low, fit, 2 * _charlie_fit(0.5, alpha) - fit))
    return result


def charlie_visibility(n_v: Any, n_l: Any, sheen_roughness: Any) -> Array:
    """1 / ((1 + lambda(v) + lambda(l)) 4 n.v n.l), between 0 and 1."""
    alpha = np.maximum(np.asarray(sheen_roughness, float) ** 2, SMALLEST_SHEEN_ALPHA)
    lambdas = charlie_lambda(n_v, alpha) + charlie_lambda(n_l, alpha)
    result: Array = np.clip(1 / ((1 + lambdas) * 4 * n_v * n_l), 0, 1)
    return result


def sheen_brdf(n: Array, v: Array, l: Array, sheen_roughness: Any) -> Array:  # noqa: E741
    """D V of the sheen, without its colour; 0 below the surface."""
    n_v, n_l, n_h = dot(n, v), dot(n, l), dot(n, half_way(v, l))
    above = (n_v > 0) & (n_l > 0)
    visibility = charlie_visibility(
        np.where(above, n_v, 1), np.where(above, n_l, 1), sheen_roughness
    )
    return np.where(above, visibility * charlie(n_h, sheen_roughness), 0.0)
