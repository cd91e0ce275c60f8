"""A sheet of 100,000 vertices that moves in waves, as plain numbers that every implementation draws."""

from __future__ import annotations

import numpy as np

ROWS, COLUMNS = 250, 400
WIDTH, DEPTH = 4.0, 2.5
FRAME_SIZE = (512, 512)
FOV, NEAR, FAR = 60.0, 1.0, 100.0
EYE = (0.0, 2.5, 3.0)
LIGHT = (5.0, 5.0, 5.0)
COLOR = (0.4, 0.7, 1.0)
KA, KD, KS, SHININESS = 0.2, 0.7, 1.0, 10.0
CLEAR = (0.4, 0.4, 0.4, 1.0)


def _grid() -> tuple[np.ndarray, np.ndarray]:
    x = np.linspace(-WIDTH / 2, WIDTH / 2, COLUMNS, dtype=np.float32)
    z = np.linspace(-DEPTH / 2, DEPTH / 2, ROWS, dtype=np.float32)
    return np.meshgrid(x, z)


def arrays(frame: int) -> tuple[np.ndarray, np.ndarray]:
    """(V, 3) float32 positions and unit normals of a frame."""
    x, z = _grid()
    across, along = 3 * x + 0.2 * frame, 4 * z
    y = 0.15 * np.sin(across) * np.cos(along)
    slope_x = 0.45 * np.cos(across) * np.cos(along)
    slope_z = -0.6 * np.sin(across) * np.sin(along)
    positions = np.stack([x, y, z], axis=-1).reshape(-1, 3)
    normals = np.stack([-slope_x, np.ones_like(x), -slope_z], axis=-1).reshape(-1, 3)
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    return np.ascontiguousarray(positions, np.float32), np.ascontiguousarray(normals, np.float32)


def triangles() -> np.ndarray:
    """(F, 3) uint32, counter-clockwise seen from above."""
    row, column = np.meshgrid(np.arange(ROWS - 1), np.arange(COLUMNS - 1), indexing="ij")
    a = row * COLUMNS + column
    b, c, d = a + 1, a + COLUMNS, a + COLUMNS + 1
    return np.stack([a, c, d, a, d, b], axis=-1).reshape(-1, 3).astype(np.uint32)
