"""A camera that sees all of a scene as large as possible, in pictures of any shape, from one side or all round."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from .._core import Node, PerspectiveCamera

__all__ = ["Extent", "axes_towards", "fit_camera", "fit_turntable"]

Vectors = npt.NDArray[np.float64]

_CHUNK = 1 << 16  # vertices of one product, so that a mesh of millions takes little memory


class Extent:
    """How far the vertices of nodes reach in any direction; larger after each `add`."""

    def __init__(self, directions: npt.ArrayLike) -> None:
        self.directions: Vectors = np.asarray(directions, np.float64)
        self.reach: Vectors = np.full(len(self.directions), -np.inf)

    def add(self, nodes: Iterable[Node]) -> Extent:
        """Count the nodes as they stand now."""
        for node in nodes:
            self.reach = np.maximum(self.reach, _reach(node, self.directions))
        return self

    @staticmethod
    def box(nodes: Iterable[Node]) -> tuple[Vectors, Vectors]:
        """Give the lowest and the highest corner of nodes."""
        reach = Extent(np.concatenate([np.eye(3), -np.eye(3)])).add(nodes).reach
        return -reach[3:], reach[:3]

    @property
    def empty(self) -> bool:
        """Whether nothing that has a vertex was added."""
        return not bool(np.isfinite(self.reach).all())


def _reach(node: Node, directions: Vectors) -> Vectors:
    mesh = node.mesh
    assert mesh is not None
    if _deforms(node):
        # The vertices of the mesh are not those of the picture; the bounds are.
        low, high = np.asarray(node.world_bounds, np.float64)
        return np.asarray(np.maximum(directions * low, directions * high).sum(axis=1))
    matrix = np.asarray(node.world_matrix, np.float64)
    local = directions @ matrix[:3, :3]
    points = mesh.positions
    found = np.full(len(directions), -np.inf)
    for start in range(0, len(points), _CHUNK):
        chunk = points[start : start + _CHUNK].astype(np.float64)
        found = np.maximum(found, (chunk @ local.T).max(axis=0))
    return np.asarray(found + directions @ matrix[:3, 3])


def _deforms(node: Node) -> bool:
    return node.skin is not None or len(node.weights) > 0


def axes_towards(azimuth: float, elevation: float) -> Vectors:
    """Give right, up and backward of a camera that looks at the model from a side.

    Azimuth and elevation are degrees: (0, 0) looks from +Z, (90, 0) from +X, (0, 90) from above.
    """
    turn, lift = np.radians(azimuth), np.radians(elevation)
    right = np.array([np.cos(turn), 0.0, -np.sin(turn)])
    back = np.array([np.sin(turn) * np.cos(lift), np.sin(lift), np.cos(turn) * np.cos(lift)])
    return np.array([right, np.cross(back, right), back])


@dataclass(frozen=True)
class _Lens:
    """Tangents of half the angles that the model may fill."""

    across: float
    along: float

    @staticmethod
    def of(fov: float, aspect: float, margin: float) -> _Lens:
        # A point at the edge of the picture has the tangent t; of a picture with margins 1 - 2 * margin are left.
        t = np.tan(np.radians(fov) / 2) * (1 - 2 * margin)
        return _Lens(float(t * aspect), float(t))

    def borders(self, axes: Vectors) -> Vectors:
        """Give the directions whose reach decides: right, left, top, bottom, and the nearest point."""
        right, up, back = axes
        across, along = self.across * back, self.along * back
        return np.array([right + across, -right + across, up + along, -up + along, back])


def fit_camera(
    nodes: Sequence[Node],
    *,
    at: tuple[float, float],
    aspect: float,
    fov: float = 28.0,
    margin: float = 0.08,
    moments: Iterable[object] = (None,),
) -> PerspectiveCamera:
    """Make the camera of a direction in whose picture the nodes are as large as the margin allows.

    Every vertex is in the picture and two opposite borders are reached. With `a` the reach in the direction
    ``right + t back``, where t is the tangent of half the angle, a point is inside the right border if
    ``a <= x + t z`` for the camera's own x and z; the left border gives the other half, so both give x and the
    smallest z. Rows give y in the same way, and the larger z counts.

    Parameters
    ----------
    nodes : sequence of Node
    at : (float, float)
        Azimuth and elevation in degrees, as in `axes_towards`.
    aspect : float
        Width over height.
    fov : float
        Degrees of the picture's shorter side.
    margin : float
        The share of the picture that stays free at each border.
    moments : iterable
        The nodes are counted once for each; a generator may move them in between.

    Raises
    ------
    ValueError
        If no node has a vertex, or all vertices lie in one line of sight.
    """
    axes = axes_towards(*at)
    lens = _Lens.of(_vertical(fov, aspect), aspect, margin)
    extent = Extent(np.concatenate([lens.borders(axes), -axes[2:]]))
    for _ in moments:
        extent.add(nodes)
    _check(extent)
    right, left, top, bottom, near, far = extent.reach
    z = max((right + left) / (2 * lens.across), (top + bottom) / (2 * lens.along))
    x, y = (right - left) / 2, (top - bottom) / 2
    camera = _camera(_vertical(fov, aspect), z - near, z + far)
    camera.position = x * axes[0] + y * axes[1] + z * axes[2]
    camera.target = x * axes[0] + y * axes[1] + (near - far) / 2 * axes[2]
    return camera


def fit_turntable(
    nodes: Sequence[Node],
    *,
    at: tuple[float, float],
    aspect: float,
    fov: float = 28.0,
    margin: float = 0.08,
    moments: Iterable[object] = (None,),
) -> PerspectiveCamera:
    """Make the first camera of a turntable: `orbit` by any yaw keeps all vertices in the picture.

    The camera goes round a vertical line through the middle of the bounds, as far away as the widest view needs.
    The parameters are those of `fit_camera`.
    """
    lens = _Lens.of(_vertical(fov, aspect), aspect, margin)
    views = [axes_towards(angle, at[1]) for angle in range(0, 360, 10)]
    box = np.concatenate([np.eye(3), -np.eye(3)])
    extent = Extent(np.concatenate([box, *(lens.borders(axes) for axes in views)]))
    for _ in moments:
        extent.add(nodes)
    _check(extent)
    middle = (extent.reach[:3] - extent.reach[3:6]) / 2
    # The middle of the box is the pivot: reaches are counted from there.
    reach = (extent.reach - extent.directions @ middle)[6:].reshape(len(views), 5)
    right, left, top, bottom, near = reach.T
    # The line of sight goes through one point of the axis in all views, as high as the tightest view needs.
    lift = float(((top - bottom) / 2).mean())
    z = max(
        np.maximum(right, left).max() / lens.across,
        np.maximum(top - lift, bottom + lift).max() / lens.along,
    )
    axes = axes_towards(*at)
    radius = float(np.linalg.norm((extent.reach[:3] + extent.reach[3:6]) / 2))
    camera = _camera(_vertical(fov, aspect), z - near.max(), z + radius)
    target = middle + np.array([0.0, lift / max(axes[1][1], 0.2), 0.0])
    camera.position = target + z * axes[2]
    camera.target = target
    return camera


def _vertical(fov: float, aspect: float) -> float:
    """Give the vertical angle of a picture whose shorter side has the angle `fov`."""
    if aspect >= 1:
        return fov
    return float(np.degrees(2 * np.arctan(np.tan(np.radians(fov) / 2) / aspect)))


def _check(extent: Extent) -> None:
    if extent.empty:
        raise ValueError("expected a model with vertices that are shown, got none")


def _camera(fov: float, near: float, far: float) -> PerspectiveCamera:
    """Make a camera for a model from `near` to `far`: depth is precise, and a ground round the model is seen."""
    if not near > 1e-6 * far:
        raise ValueError(
            "expected a model with an extent, got a point or a line towards the camera"
        )
    return PerspectiveCamera(fov=fov, near=near * 0.5, far=far * 20)
