"""A sky whose colour says the direction, and the directions that tests look in."""

import numpy as np

import cubecam as cc
from tests.reference.cube_faces import unit_texel_directions

DIRECTIONS = np.array(
    [
        [1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1],
        [1, 2, 3], [-2, 1, 3], [3, -1, -2], [-1, -2, -1], [2, 3, -1], [-3, 0.5, -1],
    ],
    dtype=np.float64,
)  # fmt: skip


def sky(directions):
    """Light that is another in every direction: no turn and no mirror image of it is the same."""
    d = np.asarray(directions, np.float64)
    x, y, z = np.moveaxis(d / np.linalg.norm(d, axis=-1, keepdims=True), -1, 0)
    light = np.stack([1 + 0.8 * x + 0.1 * y * z, 1 + 0.8 * y - 0.1 * x * z, 1 + 0.8 * z + 0.1 * x * y], -1)  # fmt: skip
    return light.astype(np.float32)


def sky_cube(size=64):
    """The sky as a cubemap."""
    return cc.CubeMap(sky(unit_texel_directions(size)))
