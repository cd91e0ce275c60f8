"""Splits an environment into its brightest lamp, which can cast a shadow, and the rest."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .._core import CubeMap, DirectionalLight, Shadow
from ..io.pixels import LUMINANCE

__all__ = ["Split", "directions_of_light", "sky_irradiance", "split_lamp", "texels"]

Vectors = npt.NDArray[np.float64]

_WIDTH = 14.0  # degrees from the middle of a lamp to its rim
_LEAST = 0.1  # a lamp with a smaller share of the light is left where it is
_SIZE = 64  # texels along a face of the copy in which lamps are found


def texels(size: int) -> tuple[Vectors, Vectors]:
    """Give the directions (6, N, N, 3) and the solid angles (6, N, N) of a cubemap's texels.

    The faces are those of OpenGL 4.6, table 8.19; a texel of a cube of edge 2 has the solid angle
    ``dA / |d|**3`` to the first order.
    """
    s = (np.arange(size) + 0.5) / size * 2 - 1
    t, s = np.meshgrid(s, s, indexing="ij")
    one = np.ones_like(s)
    faces = [(one, -t, -s), (-one, -t, s), (s, one, t), (s, -one, -t), (s, -t, one), (-s, -t, -one)]
    directions = np.stack([np.stack(face, axis=-1) for face in faces])
    square = (directions**2).sum(axis=-1)
    return directions / np.sqrt(square)[..., None], (2 / size) ** 2 / square**1.5


@dataclass(frozen=True)
class Split:
    """An environment without its brightest lamp, and that lamp as a light; `light` is None where there is no lamp."""

    environment: CubeMap
    light: DirectionalLight | None


def split_lamp(cube: CubeMap) -> Split:
    """Take the brightest lamp out of an environment: the sum of the light stays the same.

    What is brighter, within 14 degrees of the brightest spot, than the rim of that disc becomes a directional light of
    the same irradiance (the integral of the radiance over the solid angle, in all three colours).
    """
    small = cube.resize(min(cube.size, _SIZE))
    directions, solid = texels(small.size)
    energy = _radiance(small) @ LUMINANCE * solid
    peak = _peak(directions, energy)
    light = _radiance(cube)
    directions, solid = texels(cube.size)
    cosine = directions @ peak
    near = cosine > np.cos(np.radians(_WIDTH))
    rim = near & (cosine < np.cos(np.radians(0.75 * _WIDTH)))
    level = np.median(light[rim], axis=0) if rim.any() else np.zeros(3)
    excess = np.where(near[..., None], np.maximum(light - level, 0), 0)
    lamp = (excess * solid[..., None]).sum(axis=(0, 1, 2))
    total = sky_irradiance(cube, peak)
    if not total > 0 or lamp @ LUMINANCE < _LEAST * total:
        return Split(cube, None)
    weight = (excess @ LUMINANCE * solid)[..., None]
    towards = (directions * weight).sum(axis=(0, 1, 2))
    faces = cube.faces.astype(np.float32)
    faces[..., :3] = light - excess
    intensity = float(lamp.max())
    # The lamp has a width of some degrees, so its shadow has a soft edge.
    shadow = Shadow(size=2048, radius=6)
    made = DirectionalLight(-towards, color=lamp / intensity, intensity=intensity, shadow=shadow)
    return Split(CubeMap(faces, encoding="linear"), made)


def _radiance(cube: CubeMap) -> Vectors:
    """Give RGB, without what is no light: NaN and numbers below 0."""
    faces = cube.faces[..., :3].astype(np.float64)
    if faces.shape[-1] == 1:
        faces = np.repeat(faces, 3, axis=-1)
    return np.asarray(np.clip(np.nan_to_num(faces, nan=0.0, posinf=65504.0), 0, None))


def _peak(directions: Vectors, energy: Vectors) -> Vectors:
    """Find the direction round which most light comes from a cone of some degrees."""
    flat, weights = directions.reshape(-1, 3), energy.ravel()
    best = flat[np.argsort(weights)[-64:]]
    inside = best @ flat.T > np.cos(np.radians(_WIDTH / 2))
    return np.asarray(best[int((inside @ weights).argmax())])


def sky_irradiance(cube: CubeMap, normals: npt.ArrayLike) -> Vectors:
    """Give the luminance of the irradiance on planes: (...) for normals (..., 3)."""
    small = cube.resize(min(cube.size, _SIZE))
    directions, solid = texels(small.size)
    energy = (_radiance(small) @ LUMINANCE * solid).ravel()
    cosine = np.maximum(np.asarray(normals, np.float64) @ directions.reshape(-1, 3).T, 0)
    return np.asarray(cosine @ energy)


def directions_of_light(cube: CubeMap, count: int) -> Vectors:
    """Choose directions from which a level ground gets its light, each with the same share of it.

    The texels above the horizon stand in a row, ordered along a curve that stays near itself, and the row is cut into
    pieces of equal irradiance (the inverse of the cumulated sum). The same cube always gives the same directions.

    Returns
    -------
    ndarray (count, 3)
        Unit vectors that point to the light, at least 3 degrees above the horizon.
    """
    small = cube.resize(min(cube.size, 32))
    directions, solid = texels(small.size)
    up = directions[..., 1]
    weights = (_radiance(small) @ LUMINANCE * solid * np.where(up > 0.05, up, 0)).ravel()
    if not weights.sum() > 0:  # a black sky: a dome of equal light
        weights = (solid * np.where(up > 0.05, up, 0)).ravel()
    # Columns of azimuth, every second one upside down.
    flat = directions.reshape(-1, 3)
    column = np.floor((np.arctan2(flat[:, 0], flat[:, 2]) / (2 * np.pi) + 0.5) * 24)
    height = np.where(column % 2 == 0, flat[:, 1], -flat[:, 1])
    order = np.lexsort((height, column))
    total = np.cumsum(weights[order])
    picked = np.searchsorted(total, (np.arange(count) + 0.5) / count * total[-1])
    return np.asarray(flat[order[np.minimum(picked, len(order) - 1)]])
