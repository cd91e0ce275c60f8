"""`Mesh.from_trimesh`: parts from objects of trimesh, which cubecam itself does not need."""

from __future__ import annotations

import sys
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import Mesh
from .parts import Part, joined
from .placing import placed


def _from_trimesh(mesh: object) -> Mesh:
    """Make a mesh from a mesh or a scene of trimesh: `Mesh.from_trimesh`, which has the documentation."""
    # Whoever has an object of trimesh has imported it.
    trimesh = sys.modules.get("trimesh")
    if trimesh is None or not isinstance(mesh, (trimesh.Trimesh, trimesh.Scene)):
        raise TypeError(
            f"mesh: expected a trimesh.Trimesh or a trimesh.Scene, got {type(mesh).__name__}"
        )
    scene: Any = trimesh.Scene([mesh]) if isinstance(mesh, trimesh.Trimesh) else mesh
    for geometry in scene.geometry.values():
        if isinstance(geometry, trimesh.Trimesh) and len(geometry.faces):
            geometry.vertex_normals  # noqa: B018 - so that the cache of trimesh has them, as _placed expects
    parts = _parts(scene)
    if not parts:
        raise ValueError("mesh: expected triangles, got none")
    return joined(parts, None)


def _parts(scene: Any) -> list[Part]:
    """Read each mesh of a trimesh scene that has triangles."""
    import trimesh

    parts = []
    for name in scene.graph.nodes_geometry:
        matrix, key = scene.graph[name]
        geometry = scene.geometry[key]
        if isinstance(geometry, trimesh.Trimesh) and len(geometry.faces):
            if geometry.vertices.shape[1] != 3:
                got = geometry.vertices.shape[1]
                raise ValueError(f"expected vertices of three numbers, got {got}")
            parts.append(_placed(geometry, np.asarray(matrix, dtype=np.float64)))
    return parts


def _placed(geometry: Any, matrix: npt.NDArray[np.float64]) -> Part:
    """Read the data of a trimesh object, and move them to their place."""
    normals = None
    # The property would compute missing normals; only the cache shows whether the file has normals.
    if "vertex_normals" in geometry._cache:
        normals = geometry.vertex_normals
    uvs = getattr(geometry.visual, "uv", None)
    colors = None
    if geometry.visual.kind == "vertex":
        colors = _unit_colors(geometry.visual.vertex_colors)
    elif "color" in getattr(geometry.visual, "vertex_attributes", {}):
        colors = _unit_colors(geometry.visual.vertex_attributes["color"])  # beside a texture
    count = len(geometry.vertices)
    part = Part(
        np.asarray(geometry.vertices, dtype=np.float64),
        np.asarray(geometry.faces, dtype=np.int64),
        _of_length(normals, count),
        _of_length(uvs, count),
        _of_length(colors, count),
    )
    return placed(part, matrix[None])


def _unit_colors(values: Any) -> npt.NDArray[np.float64]:
    """Turn vertex colours of any type into 0..1, with an alpha of 1 where there is none."""
    given = np.asarray(values)
    scale = np.iinfo(given.dtype).max if given.dtype.kind == "u" else 1
    colors: npt.NDArray[np.float64] = given.astype(np.float64) / scale
    if colors.shape[1] == 3:
        colors = np.concatenate([colors, np.ones((len(colors), 1))], axis=1)
    return colors


def _of_length(values: Any, count: int) -> npt.NDArray[np.float64] | None:
    if values is None or len(values) != count:
        return None
    return np.asarray(values, dtype=np.float64)
