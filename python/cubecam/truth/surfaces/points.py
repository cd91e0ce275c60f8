"""Surfaces where rays meet them: interpolated as the renderer interpolates (shaders/passes/surface.frag)."""

from __future__ import annotations

from dataclasses import dataclass, fields

import numpy as np

from ..._drawn_meshes import unit
from ..arrays import Array, Bools, Ints
from ..scene.snapshot import Snapshot
from .geometry import Hits
from .interpolation import interpolated

__all__ = ["Points", "surface_points"]


@dataclass
class Points:
    """Points on surfaces, arrays (P, ...) for the rays that met something.

    Attributes
    ----------
    row : ndarray (P,) int64
        Which ray met the surface.
    triangle, node : ndarray (P,) int64
        Places in the snapshot.
    position : ndarray (P, 3)
        World.
    v : ndarray (P, 3)
        Unit vectors from the surface to where the ray came from.
    face_normal : ndarray (P, 3)
        Unit normals of the triangles, on the side from which the ray came.
    normal : ndarray (P, 3)
        Interpolated unit normals, turned where the ray met the back; 0 where the mesh has none.
    tangent : ndarray (P, 4)
        Unit vectors and 1 or -1; all turned where the ray met the back; 0 where the mesh has none.
    uv, uv1 : ndarray (P, 2)
    color : ndarray (P, 4)
        The vertices' colours.
    place : ndarray (P, 3)
        Positions in the mesh's own space.
    back : ndarray (P,) bool
        Whether the ray met the back.
    lifted : ndarray (P, 3)
        Points just outside of the rounded surface that the normals describe, from which rays to lights begin: no facets
        show at the edge of light and shadow (J. Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021,
        chapter 4).
    """

    row: Ints
    triangle: Ints
    node: Ints
    position: Array
    v: Array
    face_normal: Array
    normal: Array
    tangent: Array
    uv: Array
    uv1: Array
    color: Array
    place: Array
    back: Bools
    lifted: Array

    def __len__(self) -> int:
        return len(self.row)

    def take(self, rows: Ints | Bools) -> Points:
        """Return some of the points."""
        return Points(**{each.name: getattr(self, each.name)[rows] for each in fields(self)})


def surface_points(
    snapshot: Snapshot, hits: Hits, directions: Array, origins: Array | None = None
) -> Points:
    """Return the points that rays met, in the order of the rays.

    Parameters
    ----------
    hits : Hits
        Of rays (R,).
    directions : ndarray (R, 3)
        Of the rays, of any length but 0.
    origins : ndarray (R, 3), optional
        Then positions lie exactly on the rays. None: positions lie exactly on the triangles.
    """
    row = np.flatnonzero(hits.triangle >= 0)
    triangle, weights = hits.triangle[row], hits.weights[row]
    corners, incident = snapshot.corners[triangle], directions[row]
    across = unit(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    back = (across * incident).sum(axis=1) > 0
    side = np.where(back, -1.0, 1.0)[:, None]
    position = interpolated(weights, corners)
    if origins is not None:
        position = origins[row] + hits.distance[row, None] * incident
    at_corners = snapshot.normals[triangle]
    tangent = interpolated(weights, snapshot.tangents[triangle])
    signs = np.where(tangent[:, 3:] < 0, -1.0, 1.0) * np.any(tangent != 0, axis=1)[:, None]
    return Points(
        row=row,
        triangle=triangle,
        node=snapshot.node[triangle],
        position=position,
        v=-unit(incident),
        face_normal=side * across,
        normal=side * unit(interpolated(weights, at_corners)),
        tangent=side * np.concatenate([unit(tangent[:, :3]), signs], axis=1),
        uv=interpolated(weights, snapshot.uvs[triangle]),
        uv1=interpolated(weights, snapshot.uvs1[triangle]),
        color=interpolated(weights, snapshot.colors[triangle]),
        place=interpolated(weights, snapshot.places[triangle]),
        back=back,
        lifted=_lifted(position, corners, side[:, None] * unit(at_corners), weights),
    )


def _lifted(position: Array, corners: Array, normals: Array, weights: Array) -> Array:
    """Move points onto the mean of what lies on or above the tangent planes of the corners.

    Each corner's plane lifts the point to itself if the point lies below it (listing 4-1 of the chapter).
    """
    below = np.minimum(((position[:, None] - corners) * normals).sum(axis=2), 0)
    lifted: Array = position - np.einsum("ri,ri,rij->rj", weights, below, normals)
    return lifted
