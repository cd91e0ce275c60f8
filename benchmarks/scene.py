"""The numbers of program P14 (dynamic reflection), as plain arrays that every implementation draws.

Two actors circle a mirror ball over a ground; the ball reflects a cubemap that is captured anew for
each frame. Matrices act on column vectors and are written in reading order; GL needs them transposed.
"""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

FACE_SIZE = 256
FRAME_SIZE = (512, 512)
CLEAR = (0.4, 0.4, 0.4, 1.0)
NEAR, FAR = 1.0, 100.0

EYE = (0.0, 1.0, 5.0)
FOV = 70.0
LIGHT = (5.0, 5.0, 5.0)
KA, KD, KS, SHININESS = 0.2, 0.7, 1.0, 10.0

GROUND_POSITION, GROUND_SIZE, GROUND_COLOR = (0.0, -2.0, 0.0), 10.0, (0.4, 0.4, 1.0)
ACTOR_COLORS = ((0.4, 1.0, 0.4), (1.0, 0.4, 0.4))
ORBIT_RADIUS, ORBIT_HEIGHT, ORBIT_STEP = 2.5, -0.5, 0.1
BALL_RADIUS, BALL_COLOR, ENV_WEIGHT, COLOR_WEIGHT = 0.5, (0.95, 0.85, 0.4), 0.78, 0.3

# The capture cameras of the OpenGL cube map table, in the order +X -X +Y -Y +Z -Z.
FACE_FORWARD = ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
FACE_UP = ((0, -1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1), (0, -1, 0), (0, -1, 0))


@dataclass(frozen=True)
class MeshArrays:
    """The arrays of a mesh for every implementation: (V, 3), (V, 3) float32 and (F, 3) uint32."""

    positions: np.ndarray
    normals: np.ndarray
    indices: np.ndarray

    @property
    def interleaved(self) -> np.ndarray:
        """(V, 6) float32: position and normal of a vertex side by side."""
        return np.ascontiguousarray(np.hstack([self.positions, self.normals]), dtype=np.float32)


def _mesh(
    positions: np.ndarray, indices: np.ndarray, normals: np.ndarray | None = None
) -> MeshArrays:
    positions = np.ascontiguousarray(positions, dtype=np.float32)
    indices = np.ascontiguousarray(indices, dtype=np.uint32)
    if normals is None:
        corners = positions[indices].astype(np.float64)
        area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        normals = np.zeros(positions.shape)
        for corner in range(3):
            np.add.at(normals, indices[:, corner], area)
        length = np.linalg.norm(normals, axis=1, keepdims=True)
        normals = np.divide(
            normals, length, out=np.tile([0.0, 1.0, 0.0], (len(normals), 1)), where=length > 0
        )
    return MeshArrays(positions, np.ascontiguousarray(normals, dtype=np.float32), indices)


def _grid_triangles(rows: int, columns: int, wrap: bool) -> np.ndarray:
    """(F, 3) triangles of a grid of quads, counter-clockwise in the (column, row) plane."""
    width, height = (columns, rows) if wrap else (columns + 1, rows + 1)
    row, column = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    right, up = (column + 1) % width, (row + 1) % height
    a, b = row * width + column, row * width + right
    c, d = up * width + right, up * width + column
    return np.stack([a, b, c, a, c, d], axis=-1).reshape(-1, 3)


def ground_mesh() -> MeshArrays:
    """A square in the XZ plane whose normal points up."""
    h = GROUND_SIZE / 2
    positions = np.array([(-h, 0, -h), (-h, 0, h), (h, 0, h), (h, 0, -h)])
    return _mesh(positions, np.array([(0, 1, 2), (0, 2, 3)]), np.tile([0.0, 1.0, 0.0], (4, 1)))


def sphere_mesh(radius: float, slices: int = 64, stacks: int = 32) -> MeshArrays:
    """A uv sphere whose normals are exact."""
    theta = np.linspace(0, np.pi, stacks + 1)[:, None]
    phi = np.linspace(0, 2 * np.pi, slices + 1)[None, :]
    normals = np.stack(
        [
            np.sin(theta) * np.cos(phi),
            np.cos(theta) * np.ones_like(phi),
            -np.sin(theta) * np.sin(phi),
        ],
        axis=-1,
    ).reshape(-1, 3)
    triangles = _grid_triangles(stacks, slices, wrap=False)[:, ::-1]
    corners = normals[triangles]
    area = np.linalg.norm(
        np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1
    )
    return _mesh(normals * radius, triangles[area > 1e-9], normals)


def knot_mesh(size: float, around: int = 300, across: int = 30) -> MeshArrays:
    """A (2, 3) torus knot of 2 * around * across triangles, which is curved, concave and has no mirror symmetry."""
    t = np.linspace(0, 2 * np.pi, around, endpoint=False)

    def curve(t: np.ndarray) -> np.ndarray:
        r = 2 + np.cos(3 * t)
        return np.stack([r * np.cos(2 * t), np.sin(3 * t), r * np.sin(2 * t)], axis=-1)

    step = 1e-4
    tangent = curve(t + step) - curve(t - step)
    tangent /= np.linalg.norm(tangent, axis=-1, keepdims=True)
    side = np.cross(tangent, [0.0, 1.0, 0.0])
    side /= np.linalg.norm(side, axis=-1, keepdims=True)
    over = np.cross(side, tangent)
    a = np.linspace(0, 2 * np.pi, across, endpoint=False)[None, :, None]
    normals = (side[:, None] * np.cos(a) + over[:, None] * np.sin(a)).reshape(-1, 3)
    positions = np.repeat(curve(t), across, axis=0) + 0.45 * normals
    extent = np.ptp(positions, axis=0).max()
    positions = (positions - (positions.max(0) + positions.min(0)) / 2) * (size / extent)
    return _mesh(positions, _grid_triangles(around, across, wrap=True))


def obj_mesh(path: Path, size: float) -> MeshArrays:
    """The mesh of an OBJ file that holds only positions and triangles, centred, with the largest extent `size`."""
    lines = [line.split() for line in path.read_text().splitlines()]
    positions = np.array([line[1:4] for line in lines if line[:1] == ["v"]], dtype=np.float64)
    indices = np.array([line[1:4] for line in lines if line[:1] == ["f"]], dtype=np.int64) - 1
    extent = np.ptp(positions, axis=0).max()
    return _mesh((positions - (positions.max(0) + positions.min(0)) / 2) * (size / extent), indices)


def look_at(eye: ArrayLike, forward: ArrayLike, up: ArrayLike) -> np.ndarray:
    """(4, 4) view matrix of a camera at `eye` that looks along `forward`."""
    f = np.asarray(forward, float)
    f = f / np.linalg.norm(f)
    s = np.cross(f, np.asarray(up, float))
    s /= np.linalg.norm(s)
    matrix = np.eye(4)
    matrix[:3, :3] = s, np.cross(s, f), -f
    matrix[:3, 3] = -matrix[:3, :3] @ np.asarray(eye, float)
    return matrix


def perspective(fov: float, aspect: float, near: float, far: float) -> np.ndarray:
    """(4, 4) OpenGL projection; `fov` is vertical, in degrees."""
    f = 1 / np.tan(np.radians(fov) / 2)
    matrix = np.zeros((4, 4))
    matrix[0, 0], matrix[1, 1] = f / aspect, f
    matrix[2, 2], matrix[2, 3] = (far + near) / (near - far), 2 * far * near / (near - far)
    matrix[3, 2] = -1
    return matrix


def face_view_projections() -> list[np.ndarray]:
    """The six view-projection matrices of the capture at the origin."""
    projection = perspective(90, 1, NEAR, FAR)
    return [
        projection @ look_at((0, 0, 0), f, u) for f, u in zip(FACE_FORWARD, FACE_UP, strict=True)
    ]


def main_view_projection() -> np.ndarray:
    """The view-projection matrix of the picture."""
    view = look_at(EYE, np.negative(EYE), (0, 1, 0))
    both: np.ndarray = perspective(FOV, FRAME_SIZE[0] / FRAME_SIZE[1], NEAR, FAR) @ view
    return both


def translation(position: ArrayLike) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = position
    return matrix


def actor_positions(frame: int) -> list[tuple[float, float, float]]:
    """The positions of the two actors in a frame, which are half a turn apart."""
    angles = (frame * ORBIT_STEP, frame * ORBIT_STEP + np.pi)
    return [
        (ORBIT_RADIUS * float(np.cos(a)), ORBIT_HEIGHT, ORBIT_RADIUS * float(np.sin(a)))
        for a in angles
    ]


def actor_mesh(name: str, teapot: Path | None) -> MeshArrays:
    """The actor of about 1,000 ("teapot") or of 18,000 triangles ("knot")."""
    if name == "knot":
        return knot_mesh(1.0)
    if teapot is None:
        raise ValueError("expected the path of teapot.obj for the actor 'teapot', got None")
    return obj_mesh(teapot, 1.0)
