"""Neighbouring faces meet: what one face shows at an edge goes on in the next one, along all twelve edges."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..._core import BasicMaterial, Mesh, Scene, axis_angle
from . import reference
from .measurement import Measurement, worst

__all__ = ["prove_seams"]

SIZE = 32
ROOM = (4.0, 3.0, 5.0)
EYE = (0.3, -0.2, 0.5)
#: float32 positions of the size of 3 are interpolated over triangles as wide as a face.
TOLERANCE = 1e-4


def prove_seams(renderer: Any) -> list[Measurement]:
    """Capture the positions in a room that stands askew, and compare the steps across the edges with numpy's."""
    scene = Scene()
    turn = axis_angle((1, 2, 3), 35)
    scene.add(Mesh.box(ROOM), BasicMaterial(double_sided=True), rotation=turn)
    got = renderer.capture(scene, position=EYE, size=SIZE, outputs=("position",)).position
    expected = _walls(_matrix((1, 2, 3), 35))
    here, there = reference.neighbours(SIZE)
    step = got[here] - got[there]
    right = expected[here] - expected[there]
    count = len(step) // 2  # each edge is met from both sides
    # The eye looks at the same walls across an edge: no step is longer than that of the walls.
    return [
        Measurement(
            "seams", f"steps across 12 edges, at {count} places", worst(step, right), TOLERANCE
        ),
        Measurement(
            "seams",
            "places of the walls along the edges",
            worst(got[here], expected[here]),
            TOLERANCE,
        ),
    ]


def _walls(matrix: Any) -> Any:
    """Give the points at which the rays of all texels meet the walls."""
    rays = reference.directions(SIZE)
    # By the transpose: into the room's own axes.
    start, inside = np.array(EYE) @ matrix, rays @ matrix
    with np.errstate(divide="ignore"):
        steps = (np.sign(inside) * np.array(ROOM) / 2 - start) / inside
    return np.array(EYE) + np.where(inside == 0, np.inf, steps).min(-1, keepdims=True) * rays


def _matrix(axis: Any, degrees: float) -> Any:
    """Rodrigues' formula for a turn about an axis."""
    x, y, z = reference.unit(np.array(axis, float))
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = np.radians(degrees)
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
