"""Directions by importance sampling: Hammersley's points, visible normals of GGX, and which mip level each looks up."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ..vectors import Array, dot, normalised
from .microfacets import (
    smith_half_anisotropic,
    trowbridge_reitz_anisotropic,
)

#: Of all lookups of samples: it trades noise for blur, measured against path-traced spheres.
LOD_BIAS = 0.25


def radical_inverse(index: Any) -> Array:
    """The bits of an index mirrored at the point: 1 -> .1, 2 -> .01, 3 -> .11 in base 2."""
    index = np.asarray(index, np.uint64)
    result, weight = np.zeros(index.shape), 0.5
    while index.any():
        result += weight * (index & np.uint64(1)).astype(float)
        index, weight = index >> np.uint64(1), weight / 2
    return result


def hammersley(count: int) -> Array:
    """(count, 2) points in the unit square: i / count and the radical inverse of i, both half a cell further."""
    index = np.arange(count)
    return np.stack([(index + 0.5) / count, radical_inverse(index) + 0.5 / count], -1)


def frame_around(n: Array) -> tuple[Array, Array]:
    """Tangent and bitangent of normals (..., 3): Duff et al. 2017, "Building an Orthonormal Basis, Revisited"."""
    x, y, z = n[..., 0], n[..., 1], n[..., 2]
    sign = np.where(z >= 0, 1.0, -1.0)
    a = -1 / (sign + z)
    b = x * y * a
    t = np.stack([1 + sign * x * x * a, sign * b, -sign * x], -1)
    return t, np.stack([b, sign + y * y * a, -y], -1)


def visible_normal(v: Array, point: Sequence[float] | Array, alpha_t: Any, alpha_b: Any) -> Array:
    """The half vector of one point, in the frame t, b, n, in which v (..., 3) is given: density D G1(v) v.h / n.v.

    Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with Spherical Caps": v as the surface of a hemisphere sees
    it, a point of the cap of the directions that it reflects into, and back.
    """
    stretch = np.concatenate(
        np.broadcast_arrays(alpha_t * np.ones_like(v[..., :1]), alpha_b, 1.0), axis=-1
    )
    warped = normalised(v * stretch)
    phi = 2 * np.pi * point[0]
    z = (1 - point[1]) * (1 + warped[..., 2]) - warped[..., 2]
    sine = np.sqrt(np.clip(1 - z**2, 0, 1))
    half = np.stack([sine * np.cos(phi), sine * np.sin(phi), z], -1) + warped
    half[..., 2] = np.maximum(half[..., 2], 0)
    return normalised(half * stretch)


def sampled_lobes(
    frame: tuple[Array, Array, Array],
    v: Array,
    alpha_t: Any,
    alpha_b: Any,
    points: Sequence[Sequence[float]] | Array,
    size: int,
) -> Iterator[tuple[Array, Array, Array, Array]]:
    """For each point, yield (l, v.h, weight, lod).

    weight: G1(l), the estimator's factor of Fresnel and radiance: the BRDF times n.l over the density of l, which is
    D G1(v) / (4 n.v); 0 below the surface.
    lod: the box mip whose texels cover the solid angle of a sample (Krivanek and Colbert 2008, "Real-time Shading with
    Filtered Importance Sampling"), of a cube of `size` texels along an edge, and LOD_BIAS more.
    """
    t, b, n = frame
    n_v = np.clip(dot(n, v), 1e-4, 1)
    local_v = np.concatenate([dot(t, v), dot(b, v), n_v], -1)
    half_v = smith_half_anisotropic(dot(t, v), dot(b, v), n_v, alpha_t, alpha_b)
    texel = 4 * np.pi / (6 * size**2)
    for point in points:
        h = visible_normal(local_v, point, alpha_t, alpha_b)
        v_h = dot(local_v, h)
        l = 2 * v_h * h - local_v  # noqa: E741
        n_l = l[..., 2:]
        lit = n_l > 0
        half_l = smith_half_anisotropic(
            l[..., :1], l[..., 1:2], np.where(lit, n_l, 1), alpha_t, alpha_b
        )
        weight = np.where(lit, 2 * n_l * half_l, 0.0)
        facets = trowbridge_reitz_anisotropic(h[..., :1], h[..., 1:2], h[..., 2:], alpha_t, alpha_b)
        density = facets * 2 * half_v / 4
        lod = 0.5 * np.log2(1 / (len(points) * np.maximum(density, 1e-30) * texel)) + LOD_BIAS
        world = l[..., :1] * t + l[..., 1:2] * b + n_l * n
        yield world, v_h, weight, np.maximum(lod, 0)
