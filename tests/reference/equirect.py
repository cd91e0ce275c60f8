"""Equirectangular pictures: unmirrored, with +Y in row 0; `center` names the direction of the centre column.

Looking along the centre with +Y up, the picture's right is the world's right: right = centre x up.
"""

import numpy as np

from cubecam.truth.shading.images import to_float

from .cube_faces import texel_directions
from .sampling import sample_faces

UP = np.array([0.0, 1.0, 0.0])
CENTERS = {
    "-z": np.array([0.0, 0.0, -1.0]),
    "+z": np.array([0.0, 0.0, 1.0]),
    "+x": np.array([1.0, 0.0, 0.0]),
    "-x": np.array([-1.0, 0.0, 0.0]),
}


def direction_to_equirect_uv(directions, center="-z"):
    """(u, v) of directions, in 0..1; u grows to the right and v downwards."""
    d = np.asarray(directions, float)
    d = d / np.linalg.norm(d, axis=-1, keepdims=True)
    forward = CENTERS[center]
    right = np.cross(forward, UP)
    u = np.arctan2(d @ right, d @ forward) / (2 * np.pi) + 0.5
    v = np.arccos(np.clip(d[..., 1], -1, 1)) / np.pi
    return u, v


def equirect_uv_to_direction(u, v, center="-z"):
    """The unit direction of (u, v)."""
    longitude = (np.asarray(u, float)[..., None] - 0.5) * 2 * np.pi
    polar = np.asarray(v, float)[..., None] * np.pi
    forward = CENTERS[center]
    right = np.cross(forward, UP)
    level = np.cos(longitude) * forward + np.sin(longitude) * right
    return np.sin(polar) * level + np.cos(polar) * UP


def pixel_directions(width, height, center="-z"):
    """(height, width, 3) unit directions of the pixel centres."""
    v, u = np.meshgrid(
        (np.arange(height) + 0.5) / height, (np.arange(width) + 0.5) / width, indexing="ij"
    )
    return equirect_uv_to_direction(u, v, center)


def sample_equirect(image, directions, center="-z"):
    """Bilinear lookup that wraps round in u and stays within the first and last row in v."""
    image = to_float(image)
    height, width = image.shape[:2]
    u, v = direction_to_equirect_uv(directions, center)
    x, y = u * width - 0.5, v * height - 0.5
    column, row = np.floor(x).astype(int), np.floor(y).astype(int)
    fx, fy = (x - column)[..., None], (y - row)[..., None]

    def texel(r, c):
        return image[np.clip(r, 0, height - 1), c % width]

    top = texel(row, column) * (1 - fx) + texel(row, column + 1) * fx
    bottom = texel(row + 1, column) * (1 - fx) + texel(row + 1, column + 1) * fx
    return top * (1 - fy) + bottom * fy


def equirect_to_faces(image, size, center="-z"):
    """One lookup per texel, which is right only where a face texel is no larger than a pixel of the picture."""
    return sample_equirect(image, texel_directions(size), center)


def faces_to_equirect(faces, width, center="-z"):
    """One lookup per pixel, which is right only where a pixel is no larger than a texel of the faces."""
    return sample_faces(faces, pixel_directions(width, width // 2, center))


def box_weights(begin, end, texels):
    """(..., 3 n) shares of the texels -n to 2 n in boxes from `begin` to `end`; texel i lies from i to i + 1."""
    low = np.arange(-texels, 2 * texels)
    overlap = np.minimum(end[..., None], low + 1) - np.maximum(begin[..., None], low)
    return np.clip(overlap, 0, None) / (end - begin)[..., None]


def equirect_boxes(image, size, center="-z"):
    """Average the picture over a box for each texel of the faces, in float64.

    The box lies along rows and columns, and is as high and as wide as the texel is at its middle, but at least one
    pixel. The columns are a ring; beyond a pole, the rows continue on the other side.
    """
    image = to_float(image)
    height, width = image.shape[:2]
    d = texel_directions(size)
    u, v = direction_to_equirect_uv(d, center)
    level = np.hypot(d[..., 0], d[..., 2])
    up = np.abs(d[..., 1])
    a = np.sqrt(np.clip(level**2 - 1, 0, None))  # on a side face
    pole = np.zeros(d.shape[:-1], bool)
    pole[2:4] = True
    texel = 2 / size
    high = np.where(pole, texel / (1 + level**2), texel * level / (level**2 + up**2))
    with np.errstate(divide="ignore"):
        wide = np.where(pole, np.minimum(texel / level, 2 * np.pi), texel / (1 + a**2))
    high = np.maximum(high * height / np.pi, 1)
    wide = np.maximum(wide * width / (2 * np.pi), 1)
    columns = box_weights(u * width - wide / 2, u * width + wide / 2, width)
    columns = columns.reshape(*u.shape, 3, width).sum(-2)
    rows = box_weights(v * height - high / 2, v * height + high / 2, height)
    north, inside, south = np.moveaxis(rows.reshape(*u.shape, 3, height), -2, 0)
    beyond = (north + south)[..., ::-1]
    over = np.roll(image, width // 2, axis=1)
    return np.einsum("fijh,fijw,hwc->fijc", inside, columns, image) + np.einsum(
        "fijh,fijw,hwc->fijc", beyond, columns, over
    )
