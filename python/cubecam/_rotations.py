"""The matrix of a quaternion."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

__all__ = ["rotation_matrix"]


def rotation_matrix(quaternion: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Give the matrix (3, 3) of a quaternion (w, x, y, z) of length 1."""
    w, x, y, z = quaternion.tolist()
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )
