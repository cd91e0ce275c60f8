"""Projections from their definitions. Axes are those of the viewer: x right, y up, z forward.

`seen(name, width, height, **options)` gives the direction of each pixel's centre, NaN where the picture shows none.
"""

import numpy as np

NAMES = (
    "perspective",
    "equidistant",
    "equisolid",
    "stereographic",
    "orthographic",
    "mirror_ball",
    "angular_map",
    "octahedral",
    "dual_paraboloid",
    "cylindrical",
)


def viewer_axes(direction=(0, 0, -1), up=(0, 1, 0)):
    """Rows: the world directions that a viewer calls right, up and forward."""
    forward = np.asarray(direction, float) / np.linalg.norm(direction)
    right = np.cross(forward, up)
    right = right / np.linalg.norm(right)
    return np.array([right, np.cross(right, forward), forward])


def pixel_positions(width, height):
    """x and y of the centres, from -1 to 1; y grows upwards."""
    x = (np.arange(width) + 0.5) / width * 2 - 1
    y = 1 - (np.arange(height) + 0.5) / height * 2
    return np.meshgrid(x, y)


def reflect(incident, normal):
    """The mirrored direction of a ray that goes towards a surface."""
    normal = normal / np.linalg.norm(normal, axis=-1, keepdims=True)
    return incident - 2 * (normal * incident).sum(-1, keepdims=True) * normal


def from_angles(angle, x, y):
    """Unit vectors at an angle from forward, in the sense of (x, y) round it."""
    turn = np.arctan2(y, x)
    return np.stack([np.sin(angle) * np.cos(turn), np.sin(angle) * np.sin(turn), np.cos(angle)], -1)


#: r of an angle with focal length 1 (Ray, Applied Photographic Optics, 2002), and the angle of an r.
LENSES = {
    "equidistant": (lambda a: a, lambda r: r),
    "equisolid": (lambda a: 2 * np.sin(a / 2), lambda r: 2 * np.arcsin(r / 2)),
    "stereographic": (lambda a: 2 * np.tan(a / 2), lambda r: 2 * np.arctan(r / 2)),
    "orthographic": (lambda a: np.sin(a), lambda r: np.arcsin(r)),
}


def lens(model, x, y, fov):
    radius, angle = LENSES[model]
    r = np.hypot(x, y)
    inside = np.where(r <= 1, r, np.nan)
    return from_angles(angle(inside * radius(np.radians(fov) / 2)), x, y)


def mirror_ball(x, y):
    """The camera looks along +z at a ball of radius 1; the side that it sees has normals with z below 0."""
    square = x**2 + y**2
    z = -np.sqrt(np.where(square <= 1, 1 - square, np.nan))
    return reflect(np.array([0.0, 0.0, 1.0]), np.stack([x, y, z], -1))


def octahedral(x, y):
    """`oct_to_float32x3` of Cigolle et al. 2014, in numpy."""
    v = np.stack([x, y, 1 - np.abs(x) - np.abs(y)], -1)
    behind = v[..., 2] < 0
    sign = np.where(v[..., :2] >= 0, 1.0, -1.0)
    folded = (1 - np.abs(v[..., 1::-1])) * sign
    v[..., :2] = np.where(behind[..., None], folded, v[..., :2])
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def paraboloid(x, y):
    """Rays that come from infinity along -z are reflected at z = (1 - x^2 - y^2) / 2, whose normal is (x, y, 1)."""
    normal = np.stack([x, y, np.where(x**2 + y**2 <= 1, 1.0, np.nan)], -1)
    return reflect(np.array([0.0, 0.0, -1.0]), normal)


def dual_paraboloid(x, y):
    front = paraboloid(2 * x + 1, y)
    back = paraboloid(2 * x - 1, y) * [-1, 1, -1]  # half a turn round up
    return np.where((x < 0)[..., None], front, back)


def cylindrical(x, y, width, height, fov):
    focal = width / np.radians(fov)  # pixels
    longitude, tangent = x * width / 2 / focal, y * height / 2 / focal
    d = np.stack([np.sin(longitude), tangent, np.cos(longitude)], -1)
    return d / np.linalg.norm(d, axis=-1, keepdims=True)


def perspective(x, y, width, height, fov):
    tangent = np.tan(np.radians(fov) / 2)
    d = np.stack([x * tangent * width / height, y * tangent, np.ones_like(x)], -1)
    return d / np.linalg.norm(d, axis=-1, keepdims=True)


def seen_at(name, x, y, width, height, fov=None, direction=(0, 0, -1), up=(0, 1, 0)):
    """World directions of positions on a picture, NaN where it shows none."""
    if name in LENSES:
        d = lens(name, x, y, fov)
    elif name == "angular_map":
        d = lens("equidistant", x, y, 360)
    elif name in ("perspective", "cylindrical"):
        d = globals()[name](x, y, width, height, fov)
    else:
        d = globals()[name](x, y)
    return d @ viewer_axes(direction, up)


def seen(name, width, height, fov=None, **placed):
    """(height, width, 3) world directions of the pixels' centres, NaN where the picture shows none."""
    x, y = pixel_positions(width, height)
    return seen_at(name, x, y, width, height, fov, **placed)
