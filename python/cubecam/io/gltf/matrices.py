"""Matrices of nodes, many at a time: quaternions and T R S."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..._core import MeshError
from ..meshes.placing import Matrices


def rotations(quaternions: Matrices, where: Callable[[int], str]) -> Matrices:
    """Turn (N, 4) quaternions x, y, z, w into (N, 3, 3) matrices; any length but 0 is right."""
    with np.errstate(all="ignore"):
        largest = np.abs(quaternions).max(axis=1, keepdims=True, initial=0)
        scaled = quaternions / largest
        x, y, z, w = (scaled / np.linalg.norm(scaled, axis=1, keepdims=True)).T
    bad = ~(np.isfinite(largest[:, 0]) & (largest[:, 0] > 0))
    if bad.any():
        first = int(bad.argmax())
        got = quaternions[first].tolist()
        raise MeshError(f"{where(first)}: expected a quaternion of length 1, got {got}")
    return np.stack(
        [
            np.stack([1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)], axis=-1),
            np.stack([2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)], axis=-1),
            np.stack([2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)], axis=-1),
        ],
        axis=-2,
    )


def composed(translations: Matrices, turned: Matrices, scales: Matrices) -> Matrices:
    """Make (N, 4, 4) matrices of (N, 3) translations, (N, 3, 3) rotations and (N, 3) scales: T R S."""
    result = np.zeros((len(turned), 4, 4))
    result[:, :3, :3] = turned * scales[:, None, :]
    result[:, :3, 3] = translations
    result[:, 3, 3] = 1
    return result
