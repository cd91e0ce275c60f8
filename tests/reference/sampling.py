"""Seamless lookups in a cube (GL 4.6 section 8.14, ARB_seamless_cube_map).

A bilinear footprint that leaves its face takes the edge texels of the neighbour; where three faces meet the
missing fourth texel is the average of the other three.
"""

import numpy as np

from cubecam.truth.shading.images import to_float

from .cube_faces import direction_to_face_uv, face_uv_to_direction


def pad_faces(faces):
    """(6, N, N, C) with one more texel on each side, taken from the neighbours."""
    faces = to_float(faces)
    n = faces.shape[1]
    padded = np.zeros((6, n + 2, n + 2, faces.shape[3]))
    padded[:, 1:-1, 1:-1] = faces
    along = (np.arange(n) + 0.5) / n
    outside = 1e-3 / n  # just over the edge: the point has left the face but not the row
    for face in range(6):
        padded[face, 1:-1, 0] = _nearest(faces, face, -outside, along)
        padded[face, 1:-1, -1] = _nearest(faces, face, 1 + outside, along)
        padded[face, 0, 1:-1] = _nearest(faces, face, along, -outside)
        padded[face, -1, 1:-1] = _nearest(faces, face, along, 1 + outside)
        for row, inner_row in ((0, 1), (-1, -2)):
            for column, inner_column in ((0, 1), (-1, -2)):
                three = (
                    padded[face, inner_row, inner_column]
                    + padded[face, row, inner_column]
                    + padded[face, inner_row, column]
                )
                padded[face, row, column] = three / 3
    return padded


def _nearest(faces, face, s, t):
    s, t = np.broadcast_arrays(s, t)
    other, s, t = direction_to_face_uv(face_uv_to_direction(face, s, t))
    n = faces.shape[1]
    row = np.clip(np.floor(t * n).astype(int), 0, n - 1)
    column = np.clip(np.floor(s * n).astype(int), 0, n - 1)
    return faces[other, row, column]


def sample_faces(faces, directions):
    """Seamless bilinear lookup at level 0: (..., 3) -> (..., C)."""
    return sample_padded(pad_faces(faces), *direction_to_face_uv(directions))


def sample_padded(padded, face, s, t):
    """Bilinear lookup in faces that `pad_faces` made, at places on the faces."""
    n = padded.shape[1] - 2
    x, y = s * n + 0.5, t * n + 0.5  # in the padded picture texel 0 is the neighbour's
    column = np.clip(np.floor(x).astype(int), 0, n)
    row = np.clip(np.floor(y).astype(int), 0, n)
    fx, fy = (x - column)[..., None], (y - row)[..., None]
    top = padded[face, row, column] * (1 - fx) + padded[face, row, column + 1] * fx
    bottom = padded[face, row + 1, column] * (1 - fx) + padded[face, row + 1, column + 1] * fx
    return top * (1 - fy) + bottom * fy


def mip_levels(faces):
    """Level 0 and the levels made from it by 2 x 2 box averages; the size must be a power of two."""
    levels = [to_float(faces)]
    while levels[-1].shape[1] > 1:
        f = levels[-1]
        levels.append((f[:, ::2, ::2] + f[:, 1::2, ::2] + f[:, ::2, 1::2] + f[:, 1::2, 1::2]) / 4)
    return levels


def sample_trilinear(faces, directions, lod):
    """Interpolate linearly between seamless lookups in the two levels next to lod."""
    levels = mip_levels(faces)
    lod = float(np.clip(lod, 0, len(levels) - 1))
    lower = int(np.floor(lod))
    upper = min(lower + 1, len(levels) - 1)
    a = sample_faces(levels[lower], directions)
    b = sample_faces(levels[upper], directions)
    return a + (b - a) * (lod - lower)
