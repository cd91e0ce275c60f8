"""The mesh of a node in world space, and meshes as PLY files."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import Mesh, Node, Skin

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


def surface_of(node: Node, mesh: Mesh) -> Surface:
    """Return the mesh of a node as it is drawn: with its morph targets and its skin, in world space."""
    parts = _morphed(node, mesh)
    positions, normals = parts["positions"].astype(float), parts["normals"].astype(float)
    triangles = np.asarray(mesh.indices, np.int32)
    if node.skin is not None and mesh.joints is not None:
        matrices = _vertex_matrices(node.skin, mesh)
        sides = np.linalg.det(matrices[:, :3, :3]) < 0
        turned = sides[triangles].sum(axis=1) >= 2
    else:
        matrices = np.asarray(node.world_matrix, float)[None]
        turned = np.full(len(triangles), np.linalg.det(matrices[0, :3, :3]) < 0)
    triangles = np.where(turned[:, None], triangles[:, ::-1], triangles)
    positions = np.einsum("vij,vj->vi", *_both(matrices[:, :3, :3], positions)) + matrices[:, :3, 3]
    normals = np.einsum("vij,vj->vi", *_both(_cofactors(matrices[:, :3, :3]), normals))
    return Surface(
        positions.astype(np.float32),
        _unit(normals).astype(np.float32),
        triangles,
        parts.get("uvs"),
        parts.get("uvs1"),
        parts.get("colors"),
    )


def _both(matrices: Array, vectors: Array) -> tuple[Array, Array]:
    return np.broadcast_to(matrices, (len(vectors), 3, 3)), vectors


def _morphed(node: Node, mesh: Mesh) -> dict[str, Array]:
    """Return the arrays of a mesh with the node's morph targets (glTF 2.0, section 3.7.2.2)."""
    parts: dict[str, Array] = {}
    for name in ("positions", "normals", "uvs", "uvs1", "colors"):
        array = getattr(mesh, name)
        if array is not None:
            parts[name] = np.array(array, np.float32)
    targets = [(t, w) for t, w in zip(mesh.morph_targets, node.weights, strict=False) if w]
    for target, weight in targets:
        for name in parts:
            change = getattr(target, name)
            if change is not None:
                parts[name] = parts[name] + np.float32(weight) * change
    if any(target.positions is not None for target, _ in targets):
        smooth = Mesh(np.asarray(mesh.positions), np.asarray(mesh.indices))
        if np.array_equal(smooth.normals, mesh.normals):  # the mesh computed them from its shape
            parts["normals"] = np.array(
                Mesh(parts["positions"], np.asarray(mesh.indices)).normals, np.float32
            )
    if "colors" in parts:
        parts["colors"] = np.clip(parts["colors"], 0, 1)
    parts["normals"] = _unit(parts["normals"])
    return parts


def _vertex_matrices(skin: Skin, mesh: Mesh) -> Array:
    """Return (V, 4, 4): the mean of the joints' matrices of each vertex (glTF 2.0, section 3.7.3)."""
    worlds = np.stack([np.eye(4) if j is None else np.asarray(j.world_matrix) for j in skin.joints])
    matrices = worlds @ np.asarray(skin.inverse_bind_matrices, float)
    weights = np.asarray(mesh.joint_weights, float)
    total = weights.sum(axis=1, keepdims=True)
    joints = np.where(total > 0, np.asarray(mesh.joints), 0)
    shares = np.where(
        total > 0, weights / np.where(total > 0, total, 1), [1.0] + [0.0] * (weights.shape[1] - 1)
    )
    return np.asarray((shares[:, :, None, None] * matrices[joints]).sum(axis=1))


def _cofactors(linear: Array) -> Array:
    """Return matrices that turn normals: the inverse transposes, up to a positive factor, also of singular ones."""
    a, b, c = linear[..., 0, :], linear[..., 1, :], linear[..., 2, :]
    rows = np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=-2)
    return np.asarray(rows * np.where(np.linalg.det(linear) < 0, -1, 1)[..., None, None])


def _unit(vectors: Array) -> Array:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.asarray(vectors / np.where(length > 0, length, 1))


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
