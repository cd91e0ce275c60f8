"""Test patterns for orientation: no face looks like another, nor like itself turned or mirrored."""

import numpy as np

from .cube_faces import unit_texel_directions

# The colours differ clearly in RGB, and none is grey.
COLORS = np.array(
    [[200, 40, 40], [40, 160, 200], [60, 190, 60], [190, 60, 190], [60, 60, 210], [210, 180, 50]]
)


def face_pattern(size, channels=4):
    """(6, size, size, channels) uint8: each face has its own colour, brighter to the right and darker downwards.

    Its top left corner is white and its top right one black, so that a swap, a mirroring and a quarter turn
    each change the picture.
    """
    ramp = np.linspace(-1, 1, size)
    right, down = ramp[None, :, None], ramp[:, None, None]
    faces = np.stack([color + 30 * right - 20 * down for color in COLORS])
    corner = max(size // 4, 1)
    faces[:, :corner, :corner] = 255
    faces[:, :corner, -corner:] = 0
    faces = np.rint(np.clip(faces, 0, 255)).astype(np.uint8)
    if channels == 1:
        return faces[..., :1]
    if channels == 4:
        alpha = np.broadcast_to(np.rint(200 + 40 * down), (6, size, size, 1)).astype(np.uint8)
        return np.concatenate([faces, alpha], axis=-1)
    return faces


def direction_pattern(size):
    """(6, size, size, 3) float32: each texel holds its unit direction, which is smooth over the edges."""
    return unit_texel_directions(size).astype(np.float32)


def random_faces(rng, size, channels=4, dtype=np.float32):
    """Faces of noise in the usual range of the dtype."""
    if dtype == np.uint8:
        return rng.integers(0, 256, (6, size, size, channels), dtype=np.uint8)
    return rng.random((6, size, size, channels)).astype(dtype)


def dihedral(picture):
    """The eight turns and mirrorings of a square picture; the first is the picture itself."""
    turns = [np.rot90(picture, k) for k in range(4)]
    return turns + [turn[:, ::-1] for turn in turns]
