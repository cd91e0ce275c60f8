"""Light of whole cubes in numpy: sums over all texels, spherical harmonics, integrals over all lights.

Written from the papers that each function names; nothing here knows the quadtrees and tables of cubecam.
"""

import numpy as np

from cubecam.truth.shading.standard.microfacets import (
    charlie,
    charlie_visibility,
    smith_half,
    trowbridge_reitz,
)

from .cube_faces import unit_texel_directions


def solid_angles(size):
    """(size, size): of the texels of a face, exactly: the integral of (1 + a^2 + b^2)^(-3/2) over each."""
    edges = 2 * np.arange(size + 1) / size - 1
    a, b = np.meshgrid(edges, edges)
    corner = np.arctan2(a * b, np.sqrt(a * a + b * b + 1))
    return np.diff(np.diff(corner, axis=0), axis=1)


def _weighted_mean(faces, directions, weight):
    """The mean of all texels, weighted by `weight(cosine of the angle to a direction)` and by solid angle."""
    faces = np.asarray(faces, float)
    size = faces.shape[1]
    texels = faces.reshape(-1, faces.shape[-1])
    towards = unit_texel_directions(size).reshape(-1, 3)
    area = np.tile(solid_angles(size).ravel(), 6)
    directions = np.asarray(directions, float)
    flat = directions.reshape(-1, 3)
    result = np.empty((len(flat), texels.shape[1]))
    for i, direction in enumerate(flat):
        weights = weight(np.clip(towards @ direction, -1, 1)) * area
        result[i] = weights @ texels / weights.sum()
    return result.reshape(*directions.shape[:-1], -1)


def filtered(faces, directions, roughness):
    """Karis 2013: the mean of the radiance weighted by D(h) n.l with v = n, h half way between n and l.

    faces: (6, N, N, C), numbers as they count; directions: (..., 3), unit vectors. (..., C).
    """
    alpha = float(roughness) ** 2

    def weight(n_l):
        n_h = np.sqrt((1 + n_l) / 2)
        return trowbridge_reitz(n_h, alpha) * np.maximum(n_l, 0)

    return _weighted_mean(faces, directions, weight)


def irradiance(faces, directions):
    """The irradiance divided by pi: the mean of the radiance, weighted by the cosine."""
    return _weighted_mean(faces, directions, lambda cosine: np.maximum(cosine, 0))


def sh_basis(directions):
    """(..., 9): the real basis up to order 2 as Ramamoorthi and Hanrahan 2001 list it, in this order of axes."""
    x, y, z = np.moveaxis(np.asarray(directions, float), -1, 0)
    return np.stack(
        [
            0.282095 * np.ones_like(x),
            0.488603 * y,
            0.488603 * z,
            0.488603 * x,
            1.092548 * x * y,
            1.092548 * y * z,
            0.315392 * (3 * z * z - 1),
            1.092548 * x * z,
            0.546274 * (x * x - y * y),
        ],
        -1,
    )


def project(faces):
    """(9, C): the coefficients of the faces, summed over texels."""
    faces = np.asarray(faces, float)
    size = faces.shape[1]
    basis = sh_basis(unit_texel_directions(size)) * solid_angles(size)[..., None]
    return np.einsum("frci,frcj->ij", basis, faces)


def _midpoints(count):
    return (np.arange(count) + 0.5) / count


def scale_and_bias(n_v, roughness, turns=96, steps=1500):
    """What a surface of glTF 2.0, appendix B.3, reflects of uniform light is f0 * scale + bias.

    Facets are summed in shares of equal D n.h, smaller ones towards the horizon, with alpha = roughness^2.
    """
    alpha = roughness**2
    edge = 1 - (1 - np.arange(steps + 1) / steps) ** 3
    share = np.diff(edge) / turns
    u = (edge[1:] + edge[:-1]) / 2
    z = np.sqrt((1 - u) / (1 + (alpha**2 - 1) * u))
    x = np.sqrt(1 - z * z) * np.cos(np.pi * _midpoints(turns))[:, None]
    v_h = np.sqrt(1 - n_v**2) * x + n_v * z
    n_l = 2 * v_h * z - n_v
    seen = (n_l > 0) & (v_h > 0)
    n_l = np.where(seen, n_l, 1)
    # The solid angle of l is that of h times 4 v.h.
    value = smith_half(n_l, alpha) * smith_half(n_v, alpha) * 4 * v_h * n_l / z * share
    grazing = (1 - np.clip(v_h, 0, 1)) ** 5
    return (
        np.where(seen, value * (1 - grazing), 0).sum(),
        np.where(seen, value * grazing, 0).sum(),
    )


def sheen_albedo(n_v, roughness, turns=180, steps=1200):
    """The integral of D V n.l of KHR_materials_sheen over the hemisphere of l, steps smaller at the horizon."""
    edge = (np.arange(steps + 1) / steps) ** 2
    n_l = ((edge[1:] + edge[:-1]) / 2)[:, None]
    phi = np.pi * _midpoints(turns)
    v_l = n_v * n_l + np.sqrt((1 - n_v**2) * (1 - n_l**2)) * np.cos(phi)
    n_h = (n_v + n_l) / np.sqrt(2 + 2 * v_l)
    value = charlie(n_h, roughness) * charlie_visibility(n_v, n_l, roughness) * n_l
    return 2 * np.pi * (value.mean(1) * np.diff(edge)).sum()
