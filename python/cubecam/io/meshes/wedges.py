"""Polygons whose corners have values of their own, which become values of vertices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .parts import Part, check_positions
from .polygons import triangles


@dataclass
class Polygons:
    """F faces with M corners.

    `corners` (M,) holds the vertices of all faces one after another, and `counts` (F,) the number of each face's
    corners. `uvs` (M, 2) and `colors` (M, 4) are those of corners, or None.
    """

    corners: npt.NDArray[np.int64]
    counts: npt.NDArray[np.int64]
    uvs: npt.NDArray[np.float64] | None = None
    colors: npt.NDArray[np.float64] | None = None


def part(
    positions: npt.NDArray[np.float64],
    faces: Polygons,
    *,
    normals: npt.NDArray[np.float64] | None,
    uvs: npt.NDArray[np.float64] | None,
    colors: npt.NDArray[np.float64] | None,
) -> Part:
    """Cut polygons into triangles; values of corners replace those of vertices, which are split where they differ."""
    check_positions(positions)
    used = faces.corners
    wrong = used[(used < 0) | (used >= len(positions))]
    if len(wrong):
        raise MeshError(f"expected vertices 0 to {len(positions) - 1} in faces, got {wrong[0]}")
    places = triangles(positions, used, faces.counts)[0].reshape(-1)
    if not len(places):
        raise MeshError(f"expected faces, got {len(positions)} vertices without any")
    corners = used[places]
    columns = [values for values in (faces.uvs, faces.colors) if values is not None]
    if columns:
        values = np.concatenate([column[places] for column in columns], axis=1)
        sources, corners, values = split(len(positions), corners, values)
        positions = positions[sources]
        normals, uvs, colors = (
            None if old is None else old[sources] for old in (normals, uvs, colors)
        )
        uvs = uvs if faces.uvs is None else values[:, :2]
        colors = colors if faces.colors is None else values[:, -4:]
    return Part(positions, corners.reshape(-1, 3), normals, uvs, colors)


def split(
    vertices: int, corners: npt.NDArray[np.int64], values: npt.NDArray[np.float64]
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.float64]]:
    """Split vertices where their corners differ.

    Parameters
    ----------
    vertices : int
        The number of vertices, V.
    corners : (M,) int64
        The vertex of each corner, from 0 to V - 1.
    values : (M, K) float64
        The values of each corner.

    Returns
    -------
    sources : (N,) int64
        The vertex of which each new vertex is a copy. The first V are the old ones, and N is at least V.
    corners : (M,) int64
        The new vertex of each corner.
    values : (N, K) float64
        The values of the new vertices; 0 for a vertex that no corner has.
    """
    kept = np.zeros((vertices, values.shape[1]))
    kept[corners[::-1]] = values[::-1]  # of several, the last one stays: the first of the file
    other = np.flatnonzero((kept[corners] != values).any(axis=1))
    keys = np.concatenate([values[other], corners[other, None]], axis=1)
    order = np.lexsort(keys.T)  # the last key, the vertex, comes first
    keys = keys[order]
    new = np.ones(len(order), bool)
    new[1:] = (keys[1:] != keys[:-1]).any(axis=1)
    result = corners.copy()
    result[other[order]] = vertices - 1 + np.cumsum(new)
    first = other[order[new]]
    sources = np.concatenate([np.arange(vertices), corners[first]])
    return sources, result, np.concatenate([kept, values[first]])
