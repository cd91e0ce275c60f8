"""Matrices by numpy, many at a time: quaternions, T R S, and what turns normals."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import numpy.typing as npt

from ..._core import MeshError

Matrices = npt.NDArray[np.float64]


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


def products(points: Matrices, linear: Matrices) -> Matrices:
    """Multiply (V, 3) points by (N, 3, 3) matrices: (N, V, 3)."""
    # `@` would start threads of BLAS, which take ten times the CPU time for such small matrices.
    result: Matrices = np.einsum("vj,nij->nvi", points, linear)
    return result


def cofactors(linear: Matrices) -> Matrices:
    """Return the cofactors of (N, 3, 3) matrices: the inverse transpose up to a factor, also of a singular matrix."""
    a, b, c = linear[:, 0], linear[:, 1], linear[:, 2]
    return np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=1)
