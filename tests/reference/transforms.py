"""Matrices on column vectors, (4, 4) in reading order; space is right-handed, an unmoved camera looks along -Z."""

import numpy as np

from cubecam.truth.shading import normalised


def translation(offset):
    m = np.eye(4)
    m[:3, 3] = offset
    return m


def axis_angle(axis, degrees):
    """The unit quaternion (w, x, y, z) of a rotation about an axis."""
    half = np.radians(degrees) / 2
    return np.concatenate([[np.cos(half)], np.sin(half) * normalised(axis)])


def rotation(quaternion):
    """The (4, 4) rotation matrix of a quaternion (w, x, y, z) of any length."""
    w, x, y, z = normalised(quaternion)
    m = np.eye(4)
    m[:3, :3] = [
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ]
    return m


def trs(position=(0, 0, 0), quaternion=(1, 0, 0, 0), scale=1.0):
    """Translation * rotation * scale."""
    size = np.eye(4)
    size[:3, :3] = np.diag(np.broadcast_to(scale, 3))
    return translation(position) @ rotation(quaternion) @ size


def look_at(eye, target, up=(0, 1, 0)):
    """The view matrix, which takes the world to the camera's space."""
    eye = np.asarray(eye, float)
    forward = normalised(np.asarray(target, float) - eye)
    right = normalised(np.cross(forward, up))
    m = np.eye(4)
    m[:3, :3] = [right, np.cross(right, forward), -forward]
    return m @ translation(-eye)


def perspective(fov, aspect, near, far):
    """The projection to OpenGL's clip space with z in -w..w; `fov` is vertical, in degrees."""
    f = 1 / np.tan(np.radians(fov) / 2)
    return np.array(
        [
            [f / aspect, 0, 0, 0],
            [0, f, 0, 0],
            [0, 0, (far + near) / (near - far), 2 * far * near / (near - far)],
            [0, 0, -1, 0],
        ]
    )


def orthographic(left, right, bottom, top, near, far):
    m = np.diag([2 / (right - left), 2 / (top - bottom), -2 / (far - near), 1.0])
    m[:3, 3] = [
        -(right + left) / (right - left),
        -(top + bottom) / (top - bottom),
        -(far + near) / (far - near),
    ]
    return m


def apply(matrix, points):
    """(..., 3) points through a (4, 4) matrix, divided by w."""
    points = np.asarray(points, float)
    h = points @ matrix[:3, :3].T + matrix[:3, 3]
    w = points @ matrix[3, :3] + matrix[3, 3]
    return h / w[..., None]


def normal_matrix(matrix):
    """The inverse transpose, which transforms normals."""
    return np.linalg.inv(np.asarray(matrix)[:3, :3]).T


def pixel_rays(view, projection, size):
    """Origins and directions of the pixel centres of a (width, height) picture, row 0 on top.

    Directions have length 1 along the camera's axis, so that a ray's parameter is z from the eye (perspective)
    or from the eye's plane (orthographic).
    """
    width, height = size
    x = (np.arange(width) + 0.5) / width * 2 - 1
    y = 1 - (np.arange(height) + 0.5) / height * 2
    y, x = np.meshgrid(y, x, indexing="ij")
    to_eye = np.linalg.inv(projection)
    ends = []
    for depth in (-1.0, 1.0):
        clip = np.stack([x, y, np.full_like(x, depth)], axis=-1)
        ends.append(apply(to_eye, clip))
    step = ends[1] - ends[0]
    step = step / -step[..., 2:]
    start = ends[0] + step * ends[0][..., 2:]  # where the ray crosses the eye's own plane
    to_world = np.linalg.inv(view)
    origins = apply(to_world, start)
    directions = step @ to_world[:3, :3].T
    return origins, directions


def window_depth(z, near, far, parallel=False):
    """OpenGL's window-space z of distances along the axis: 0 at the near plane, 1 at the far one and at infinity."""
    z = np.asarray(z, float)
    with np.errstate(invalid="ignore"):
        depth = (z - near) / (far - near) if parallel else far / (far - near) * (1 - near / z)
    return np.where(np.isinf(z), 1.0, depth)


def quantised(value, bits):
    """The nearest whole number of 0..2^bits - 1 for 0..1."""
    return np.round(np.asarray(value, float) * (2**bits - 1)).astype(np.int64)
