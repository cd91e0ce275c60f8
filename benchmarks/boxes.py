"""Ten thousand boxes in the air, as plain numbers that every implementation draws."""

from __future__ import annotations

import numpy as np

SIZE = 0.25
SPREAD = 7.0
FRAME_SIZE = (512, 512)
FOV, NEAR, FAR = 60.0, 1.0, 100.0
EYE = (0.0, 0.0, 16.0)
LIGHT = (6.0, 8.0, 14.0)
KA, KD, KS, SHININESS = 0.2, 0.7, 1.0, 10.0
CLEAR = (0.4, 0.4, 0.4, 1.0)


class Boxes:
    """The positions, rotations and colours of `count` boxes; they are the same at each call."""

    def __init__(self, count: int, colors: int) -> None:
        random = np.random.default_rng(8)
        self.count = count
        self.start = random.uniform(-SPREAD, SPREAD, (count, 3))
        self.phase = random.uniform(0, 2 * np.pi, (count, 3))
        turns = random.normal(size=(count, 4))
        self.quaternions = turns / np.linalg.norm(turns, axis=1, keepdims=True)  # w, x, y, z
        self.palette = random.uniform(0.2, 1.0, (colors, 3))
        self.material = np.arange(count) % colors

    def positions(self, frame: int) -> np.ndarray:
        """(count, 3) float64 positions; every box swings round its place."""
        return self.start + 0.2 * np.sin(self.phase + 0.3 * frame)

    def rotations(self) -> np.ndarray:
        """(count, 3, 3) float64 rotation matrices of the quaternions."""
        w, x, y, z = self.quaternions.T
        rows = [
            [1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
            [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
            [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)],
        ]
        return np.moveaxis(np.array(rows), -1, 0)


def box_arrays() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(24, 3) positions, (24, 3) normals and (12, 3) triangles of a box of side SIZE with flat faces."""
    positions: list[np.ndarray] = []
    normals: list[np.ndarray] = []
    triangles: list[list[int]] = []
    for axis in range(3):
        for sign in (1, -1):
            normal, u, v = np.zeros(3), np.zeros(3), np.zeros(3)
            normal[axis], u[(axis + 1) % 3], v[(axis + 2) % 3] = sign, sign, 1
            first = len(positions)
            positions += [normal - u - v, normal + u - v, normal + u + v, normal - u + v]
            normals += [normal] * 4
            triangles += [[first, first + 1, first + 2], [first, first + 2, first + 3]]
    half = SIZE / 2 * np.array(positions)
    return half.astype(np.float32), np.array(normals, np.float32), np.array(triangles, np.uint32)
