"""Each face shows what lies in its direction, the right way round: twelve rectangles, texel by texel."""

from __future__ import annotations

from typing import Any, TypeAlias

import numpy as np

from ..._core import BasicMaterial, Mesh, Scene
from . import reference
from .measurement import Measurement, worst

__all__ = ["prove_orientation"]

SIZE = 16
BACKGROUND = (0.0625, 0.125, 0.25)


#: Axis, place along it, ranges along the other two axes, colour.
Rectangle: TypeAlias = tuple[int, float, tuple[tuple[float, float], ...], tuple[float, ...]]


def rectangles() -> list[Rectangle]:
    """Give two rectangles in the direction of each axis: a large one, and before it a mark in a corner.

    Their edges lie between the texels of faces of 16, and neither has a symmetry: a face that is exchanged, mirrored or
    turned shows other texels.
    """
    found: list[Rectangle] = []
    for axis in range(3):
        for sign in (1, -1):
            count = 2 * axis + (sign < 0)
            large = ((-1.25, 1.75), (-1.5, 1.0))
            mark = ((0.25, 0.75), (-0.5, 0.25))
            tone = (count + 1) / 8
            found.append((axis, 2.0 * sign, large, (tone, 1 - tone, (count % 3) / 4)))
            found.append((axis, 1.0 * sign, mark, (1 - tone / 2, tone, 1.0)))
    return found


def prove_orientation(renderer: Any) -> list[Measurement]:
    """Capture the rectangles, and cast a ray through each texel in numpy."""
    scene = Scene(background=BACKGROUND)
    for axis, place, ranges, color in rectangles():
        scene.add(_quad(axis, place, ranges), BasicMaterial(color=color, double_sided=True))
    got = renderer.capture(scene, size=SIZE, format="rgba32f").faces[..., :3]
    expected = reference.hit_rectangles(reference.directions(SIZE), rectangles(), BACKGROUND)
    what = f"{expected[..., 0].size} texels of six faces, captured"
    return [Measurement("orientation", what, worst(got, expected.astype(np.float32)), 0.0)]


def _quad(axis: int, place: float, ranges: Any) -> Any:
    others = [index for index in range(3) if index != axis]
    corners = np.full((4, 3), place)
    for corner, (a, b) in enumerate(((0, 0), (1, 0), (1, 1), (0, 1))):
        corners[corner, others[0]] = ranges[0][a]
        corners[corner, others[1]] = ranges[1][b]
    return Mesh(corners, [[0, 1, 2], [0, 2, 3]])
