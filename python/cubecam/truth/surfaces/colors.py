"""What materials show at points: the numbers of `BasicMaterial`, `PhongMaterial` and `StandardMaterial`."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Array
from ..scene.records import BasicRecord, PhongRecord
from ..scene.snapshot import Snapshot
from .points import Points, surface_points
from .standard import standard_point

__all__ = [
    "PhongParameters",
    "Points",
    "basic_color",
    "phong_parameters",
    "standard_point",
    "surface_points",
]


def basic_color(snapshot: Snapshot, material: int, points: Points) -> tuple[Array, Array]:
    """Return the colour (P, 3) of a `BasicMaterial` and the alpha (P, 1) of map and vertices.

    `material` is the place in `Snapshot.materials`. The alpha of the surface is this alpha times `NodeRecord.opacity`.
    """
    record = snapshot.materials[material]
    assert isinstance(record, BasicRecord)
    tint = points.color
    if record.map is not None:
        tint = tint * record.map.at(points.uv, points.uv1)
    color = record.color[:3] * tint[:, :3]
    if record.cubemap is not None and len(points):
        # The middle of the mesh has no direction; OpenGL gives some texel there.
        nowhere = ~np.any(points.place, axis=1, keepdims=True)
        color = color * record.cubemap.sample(np.where(nowhere, (1.0, 0.0, 0.0), points.place))[
            :, :3
        ].astype(np.float64)
    return color, tint[:, 3:]


@dataclass
class PhongParameters:
    """Numbers of a `PhongMaterial`: `color` (P, 3) times map and vertex colours, and the `alpha` (P, 1) of these."""

    color: Array
    alpha: Array
    ka: float
    kd: float
    ks: float
    shininess: float


def phong_parameters(snapshot: Snapshot, material: int, points: Points) -> PhongParameters:
    """Return the numbers of a `PhongMaterial` at points. Alpha: as in `basic_color`."""
    record = snapshot.materials[material]
    assert isinstance(record, PhongRecord)
    tint = points.color
    if record.map is not None:
        tint = tint * record.map.at(points.uv, points.uv1)
    return PhongParameters(
        record.color[:3] * tint[:, :3],
        tint[:, 3:],
        record.ka,
        record.kd,
        record.ks,
        record.shininess,
    )
