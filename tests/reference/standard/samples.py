"""Directions by importance sampling: Hammersley's points, half vectors of GGX, and which mip level each looks up."""

import numpy as np

from ..shading import dot
from .microfacets import (
    smith_half_anisotropic,
    trowbridge_reitz_anisotropic,
)


def radical_inverse(index):
    """The bits of an index mirrored at the point: 1 -> .1, 2 -> .01, 3 -> .11 in base 2."""
    index = np.asarray(index, np.uint64)
    result, weight = np.zeros(index.shape), 0.5
    while index.any():
        result += weight * (index & np.uint64(1)).astype(float)
        index, weight = index >> np.uint64(1), weight / 2
    return result


def hammersley(count):
    """(count, 2) points in the unit square: i / count and the radical inverse of i, both half a cell further."""
    index = np.arange(count)
    return np.stack([(index + 0.5) / count, radical_inverse(index) + 0.5 / count], -1)


def frame_around(n):
    """Tangent and bitangent of normals (..., 3): Duff et al. 2017, "Building an Orthonormal Basis, Revisited"."""
    x, y, z = n[..., 0], n[..., 1], n[..., 2]
    sign = np.where(z >= 0, 1.0, -1.0)
    a = -1 / (sign + z)
    b = x * y * a
    t = np.stack([1 + sign * x * x * a, sign * b, -sign * x], -1)
    return t, np.stack([b, sign + y * y * a, -y], -1)


def half_vector(point, alpha_t, alpha_b):
    """The (t, b, n) components of the half vector of one point: density D n.h.

    Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", equation 35, with slopes stretched
    by two alphas.
    """
    phi = 2 * np.pi * point[0]
    slope = np.sqrt(point[1] / (1 - point[1]))
    x, y = alpha_t * np.cos(phi) * slope, alpha_b * np.sin(phi) * slope
    length = np.sqrt(x**2 + y**2 + 1)
    return x / length, y / length, 1 / length


def sampled_lobes(frame, v, alpha_t, alpha_b, points, size):
    """For each point, yield (l, v.h, weight, lod).

    weight: V 4 v.h n.l / n.h, the estimator's factor of Fresnel and radiance; 0 below the surface.
    lod: the box mip whose texels cover the solid angle of a sample (Krivanek and Colbert 2008), of a cube of `size`
    texels along an edge.
    """
    t, b, n = frame
    n_v = np.clip(dot(n, v), 1e-4, 1)
    half_v = smith_half_anisotropic(dot(t, v), dot(b, v), n_v, alpha_t, alpha_b)
    texel = 4 * np.pi / (6 * size**2)
    for point in points:
        h_t, h_b, h_n = half_vector(point, alpha_t, alpha_b)
        h = t * h_t + b * h_b + n * h_n
        v_h = dot(v, h)
        l = 2 * v_h * h - v  # noqa: E741
        n_l = dot(n, l)
        lit = (n_l > 0) & (v_h > 0)
        safe_l, safe_v_h = np.where(lit, n_l, 1), np.where(lit, v_h, 1)
        half_l = smith_half_anisotropic(dot(t, l), dot(b, l), safe_l, alpha_t, alpha_b)
        weight = np.where(lit, half_v * half_l * 4 * safe_v_h * safe_l / h_n, 0.0)
        density = trowbridge_reitz_anisotropic(h_t, h_b, h_n, alpha_t, alpha_b)
        density = density * h_n / (4 * safe_v_h)
        lod = np.maximum(0.5 * np.log2(1 / (len(points) * density * texel)), 0)
        yield l, v_h, weight, np.where(lit, lod, 0)
