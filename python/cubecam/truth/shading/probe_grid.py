"""The light of a `ProbeGrid` at a place: what nodes of a grid know of it, and how much each counts.

Z. Majercik, J.-P. Guertin, D. Nowrouzezahrai, M. McGuire, "Dynamic diffuse global illumination with ray-traced
irradiance fields" (Journal of Computer Graphics Techniques 8(2), 2019), section 4.4 and listing 2. Arrays are those of
the grid: coefficients (nz, ny, nx, 9, 3), distances (nz, ny, nx, R, R, 2), active (nz, ny, nx).
"""

from __future__ import annotations

import itertools

import numpy as np
import numpy.typing as npt

from .vectors import Array

#: What a cosine lobe keeps of each order, over pi: R. Ramamoorthi, P. Hanrahan, "An efficient representation for
#: irradiance environment maps" (SIGGRAPH 2001), equation 8.
LOBE = (1.0, 2 / 3, 1 / 4)
#: The weight below which weights are made smaller, and the least one.
CRUSHED, LEAST = 0.2, 1e-6


def node_light(coefficients: npt.ArrayLike, normals: npt.ArrayLike) -> Array:
    """Irradiance over pi from radiance's coefficients of orders 0 to 2; 0 where the sum is below.

    Parameters
    ----------
    coefficients : array_like (..., 9, 3)
        Integrals of radiance times the basis, as `CubeMap.sh` gives.
    normals : array_like (..., 3)
        Unit vectors.

    Returns
    -------
    ndarray (..., 3) float64

    Examples
    --------
    Uniform radiance of 2:

    >>> c = np.zeros((9, 3))
    >>> c[0] = 2 * np.sqrt(4 * np.pi)
    >>> node_light(c, (0, 0, 1)).round(12).tolist()
    [2.0, 2.0, 2.0]
    """
    x, y, z = np.moveaxis(np.asarray(normals, float), -1, 0)
    one, pi = np.ones_like(x), np.pi
    basis = np.stack(
        [
            one * np.sqrt(1 / (4 * pi)),
            y * np.sqrt(3 / (4 * pi)),
            z * np.sqrt(3 / (4 * pi)),
            x * np.sqrt(3 / (4 * pi)),
            x * y * np.sqrt(15 / (4 * pi)),
            y * z * np.sqrt(15 / (4 * pi)),
            (3 * z * z - 1) * np.sqrt(5 / (16 * pi)),
            x * z * np.sqrt(15 / (4 * pi)),
            (x * x - y * y) * np.sqrt(15 / (16 * pi)),
        ],
        axis=-1,
    )
    basis = basis * np.repeat(LOBE, (1, 3, 5))
    light: Array = np.maximum(np.einsum("...k,...kc->...c", basis, np.asarray(coefficients)), 0)
    return light


def octahedral_directions(resolution: int) -> Array:
    """The unit directions of the texels' centers of an octahedral map, (R, R, 3); row i has v = -1 + (2 i + 1) / R.

    Z. Cigolle and others, "A survey of efficient representations for independent unit vectors" (JCGT 3(2), 2014): the
    octahedron |x| + |y| + |z| = 1 seen from +z, its lower half folded outwards.
    """
    ticks = (np.arange(resolution) + 0.5) / resolution * 2 - 1
    v, u = np.meshgrid(ticks, ticks, indexing="ij")
    z = 1 - np.abs(u) - np.abs(v)
    fold = np.maximum(-z, 0)
    x, y = u - np.copysign(fold, u), v - np.copysign(fold, v)
    found: Array = np.stack([x, y, z], axis=-1)
    unit: Array = found / np.sqrt((found**2).sum(axis=-1, keepdims=True))
    return unit


def octahedral_place(directions: npt.ArrayLike) -> Array:
    """(u, v) from -1 to 1 of directions (..., 3) in an octahedral map."""
    d = np.asarray(directions, float)
    p = d / np.abs(d).sum(axis=-1, keepdims=True)
    u, v, z = np.moveaxis(p, -1, 0)
    below = z < 0
    return np.stack(
        [
            np.where(below, (1 - np.abs(v)) * np.where(u < 0, -1, 1), u),
            np.where(below, (1 - np.abs(u)) * np.where(v < 0, -1, 1), v),
        ],
        axis=-1,
    )


def looked_up(maps: npt.ArrayLike, directions: npt.ArrayLike) -> Array:
    """Bilinear lookups of octahedral maps (n, R, R, C) in directions (n, 3), across their edges.

    Beyond an edge lies the same edge, mirrored: (u, v) beyond u = 1 is (2 - u, -v).
    """
    maps = np.asarray(maps, float)
    size = maps.shape[1]
    at = (octahedral_place(directions) * 0.5 + 0.5) * size - 0.5
    low = np.floor(at).astype(int)
    share = at - low
    rows = np.arange(len(maps))
    found = np.zeros((len(maps), maps.shape[3]))
    for dx, dy in itertools.product((0, 1), (0, 1)):
        i, j = low[:, 1] + dy, low[:, 0] + dx
        off_x, off_y = (j < 0) | (j >= size), (i < 0) | (i >= size)
        i2, j2 = np.clip(i, 0, size - 1), np.clip(j, 0, size - 1)
        i2 = np.where(off_x, size - 1 - i2, i2)
        j2 = np.where(off_y, size - 1 - j2, j2)
        weight = np.where(dx, share[:, 0], 1 - share[:, 0]) * np.where(
            dy, share[:, 1], 1 - share[:, 1]
        )
        found += weight[:, None] * maps[rows, i2, j2]
    return found


def visibility_weight(
    to_node: Array, normals: Array, bias: Array, moments: Array | None = None
) -> Array:
    """The weight of a node without its trilinear part.

    The smooth backface term ((1 + cos) / 2)^2 + .2, with the angle between the normal and the way to the node, times
    the cube of Chebyshev's bound for the share of distances that are beyond the place, v / (v + (d - m)^2), where d is
    larger than the mean m; v = |m^2 - s| with s the mean square. Less than .2 becomes w^3 / .04, after at least 1e-6.

    Parameters
    ----------
    to_node : ndarray (n, 3)
        From the place to the node.
    normals : ndarray (n, 3)
    bias : ndarray (n, 3)
        What is added to the place whose visibility counts.
    moments : ndarray (n, 2)
        m and s in the direction from the node to that place.

    Returns
    -------
    ndarray (n,) float64
    """
    length = np.sqrt((to_node**2).sum(axis=-1))
    cosine = (to_node * normals).sum(axis=-1) / np.maximum(length, 1e-10)
    weight = ((cosine + 1) / 2) ** 2 + 0.2
    if moments is not None:
        d = np.sqrt(((bias - to_node) ** 2).sum(axis=-1))
        mean, square = moments[:, 0], moments[:, 1]
        variance = np.abs(mean**2 - square)
        late = np.maximum(d - mean, 0)
        with np.errstate(invalid="ignore", divide="ignore"):
            bound = np.where(late > 0, variance / (variance + late**2), 1)
        weight = weight * np.where(d > mean, bound**3, 1)
    weight = np.maximum(weight, LEAST)
    crushed: Array = np.where(weight < CRUSHED, weight**3 / CRUSHED**2, weight)
    return crushed


def irradiance(
    positions: npt.ArrayLike,
    normals: npt.ArrayLike,
    incident: npt.ArrayLike,
    low: npt.ArrayLike,
    high: npt.ArrayLike,
    coefficients: npt.ArrayLike,
    distances: npt.ArrayLike,
    active: npt.ArrayLike,
    *,
    normal_bias: float = 0.1,
    view_bias: float = 0.2,
    visibility: bool = True,
    around: npt.ArrayLike = 0.0,
) -> Array:
    """Irradiance over pi at places of surfaces.

    Parameters
    ----------
    positions, normals, incident : array_like (n, 3)
        World; unit normals; unit vectors from the eye to the places.
    low, high : array_like (3,)
        The first and the last node.
    coefficients, distances, active
        The grid's arrays.
    normal_bias, view_bias : float
        In least steps between nodes.
    visibility : bool
        False: trilinear interpolation alone.
    around : array_like (n, 3) or float
        Irradiance over pi of the environment, which counts from one cell outside of the grid on, and alone from two.

    Returns
    -------
    ndarray (n, 3) float64
    """
    p, n, view = (np.asarray(a, float) for a in (positions, normals, incident))
    first, last = np.asarray(low, float), np.asarray(high, float)
    light, maps = np.asarray(coefficients, float), np.asarray(distances, float)
    on = np.asarray(active, bool)
    counts = np.array(on.shape[::-1])
    step = (last - first) / (counts - 1)
    inside = np.minimum(np.maximum(p, first), last)
    base = np.minimum(((inside - first) / step).astype(int), counts - 2)
    alpha = (inside - first) / step - base
    bias = step.min() * (normal_bias * n - view_bias * view)
    total, weights = np.zeros_like(p), np.zeros(len(p))
    for corner in itertools.product((0, 1), repeat=3):
        node = base + corner
        x, y, z = node.T
        part = np.where(corner, alpha, 1 - alpha).prod(axis=-1)
        to_node = first + node * step - p
        if visibility:
            seen = bias - to_node
            seen = np.where((seen**2).sum(axis=-1, keepdims=True) > 0, seen, (0, 0, 1.0))
            weight = visibility_weight(to_node, n, bias, looked_up(maps[z, y, x], seen))
        else:
            weight = np.ones(len(p))
        weight = part * np.where(on[z, y, x], weight, LEAST**3 / CRUSHED**2)
        total += weight[:, None] * node_light(light[z, y, x], n)
        weights += weight
    t = np.clip(np.sqrt((((p - inside) / step) ** 2).sum(axis=-1)) - 1, 0, 1)
    outside = (t * t * (3 - 2 * t))[:, None]
    result: Array = total / weights[:, None] * (1 - outside) + outside * np.asarray(around)
    return result
