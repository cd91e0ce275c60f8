"""Embree, which finds triangles along rays in float32."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from ..arrays import Array, Bools, Ints


class Tree:
    """A tree of Embree over triangles, which `places` (N,) names in the snapshot."""

    def __init__(self, embree: tuple[Any, Any], corners: Array, places: Ints) -> None:
        meshes, scenes = embree
        self._places = places
        self._scene: Any = None
        if len(places):
            # Without `robust`, Embree 2 (embreex 2.17) lets rays through between two triangles.
            self._scene = scenes.EmbreeScene(robust=True)
            self._mesh = meshes.TriangleMesh(self._scene, corners.astype(np.float32))

    def nearest(self, origins: Array, directions: Array) -> tuple[Ints, Ints]:
        """Return the rays that meet something, and the triangles, by their places in the snapshot."""
        if self._scene is None or not len(origins):
            return np.zeros(0, np.int64), np.zeros(0, np.int64)
        met = np.asarray(self._scene.run(_float32(origins), _float32(directions)))
        rows = np.flatnonzero(met >= 0)
        return rows, self._places[met[rows]]

    def occluded(self, origins: Array, directions: Array, reach: Array) -> Bools:
        """Return whether rays meet anything before `reach` (R,)."""
        if self._scene is None or not len(origins):
            return np.zeros(len(origins), bool)
        ends = _float32(np.minimum(reach, 1e37))  # Embree's own infinity
        met = self._scene.run(_float32(origins), _float32(directions), dists=ends, query="OCCLUDED")
        found: Bools = np.asarray(met) >= 0
        return found


def _float32(numbers: Array) -> Any:
    return np.ascontiguousarray(numbers, np.float32)


def embree() -> tuple[Any, Any]:
    """Import Embree: how it makes meshes, and scenes."""
    try:
        return (
            importlib.import_module("embreex.mesh_construction"),
            importlib.import_module("embreex.rtcore_scene"),
        )
    except ImportError as error:
        raise ImportError(
            "ray casting: expected the package embreex, found none; install it by "
            'pip install "cubecam[truth]"'
        ) from error
