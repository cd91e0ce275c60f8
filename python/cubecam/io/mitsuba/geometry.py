"""The mesh of a node in world space, and meshes as PLY files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import Node
from ..._drawn_meshes import cofactors, deformed_mesh, unit

Array = npt.NDArray[Any]


@dataclass(frozen=True)
class Surface:
    """A mesh in world space. All arrays but `triangles` are float32 with one row for each vertex."""

    positions: Array
    """(V, 3)"""
    normals: Array
    """(V, 3), unit vectors."""
    triangles: Array
    """(T, 3) int32, counter-clockwise from outside."""
    uvs: Array | None
    """(V, 2)"""
    uvs1: Array | None
    """(V, 2)"""
    colors: Array | None
    """(V, 4), linear."""

    def is_closed(self) -> bool:
        """Say whether each edge has as many triangles on one side as on the other, once equal points are one."""
        _, same = np.unique(self.positions, axis=0, return_inverse=True)
        corners = same.reshape(-1)[self.triangles]
        edges = np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]).astype(
            np.int64
        )
        edges = edges[edges[:, 0] != edges[:, 1]]
        low, high = edges.min(axis=1), edges.max(axis=1)
        names, place = np.unique(low * (int(high.max(initial=0)) + 1) + high, return_inverse=True)
        balance = np.zeros(len(names), np.int64)
        np.add.at(balance, place.reshape(-1), np.where(edges[:, 0] == low, 1, -1))
        return not balance.any()

    def behind(self, distance: float) -> Surface:
        """Return the other side of this surface: turned round, and moved against the normals by a distance."""
        moved = self.positions - np.float32(distance) * self.normals
        return Surface(
            moved, -self.normals, self.triangles[:, ::-1], self.uvs, self.uvs1, self.colors
        )


def surface_of(node: Node, nodes: frozenset[int]) -> Surface:
    """Return the mesh of a node with its morph targets and its skin, in world space.

    `nodes` are the ids of all nodes of the scene.
    """
    drawn = deformed_mesh(node, nodes)
    mesh, linear = drawn.mesh, drawn.matrix[:3, :3]
    triangles = mesh.indices.astype(np.int32)
    mirrors = np.linalg.det(linear) < 0
    if mirrors:  # counter-clockwise becomes clockwise
        triangles = triangles[:, ::-1]
    # The cofactors turn normals as the inverse of the transposed matrix does, also if that has no inverse.
    normals = mesh.normals.astype(float) @ cofactors(linear).T * (-1 if mirrors else 1)
    return Surface(
        (mesh.positions.astype(float) @ linear.T + drawn.matrix[:3, 3]).astype(np.float32),
        unit(normals).astype(np.float32),
        triangles,
        mesh.uvs,
        mesh.uvs1,
        mesh.colors,
    )


def ply(surface: Surface, uvs: Array | None, colors: Array | None, normals: bool) -> bytes:
    """Write a binary PLY file with the names of properties that Mitsuba's plugin ``ply`` reads.

    Parameters
    ----------
    surface : Surface
        The mesh.
    uvs : ndarray (V, 2), optional
        Texture coordinates, s and t.
    colors : ndarray (V, 3), optional
        What the attribute ``vertex_color`` holds.
    normals : bool
        Whether the normals are written. Without them Mitsuba computes those of the faces or smooth ones.
    """
    columns, names = [surface.positions], ["x", "y", "z"]
    if normals:
        columns.append(surface.normals)
        names += ["nx", "ny", "nz"]
    if uvs is not None:
        columns.append(uvs)
        names += ["u", "v"]
    if colors is not None:
        columns.append(colors)
        names += ["r", "g", "b"]
    faces = np.empty(len(surface.triangles), dtype=[("count", "u1"), ("corners", "<i4", 3)])
    faces["count"] = 3
    faces["corners"] = surface.triangles
    header = [
        "ply",
        "format binary_little_endian 1.0",
        f"element vertex {len(surface.positions)}",
        *(f"property float {name}" for name in names),
        f"element face {len(faces)}",
        "property list uchar int vertex_indices",
        "end_header\n",
    ]
    table = np.column_stack(columns).astype("<f4")
    return "\n".join(header).encode("ascii") + table.tobytes() + faces.tobytes()
