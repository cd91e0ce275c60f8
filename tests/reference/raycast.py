"""A vectorised ray caster: it finds what each ray hits first, from geometry alone.

A ray is origin + t * direction with t > 0; if directions have length 1 along the view's axis, t is z.
Every shape stands in its own space and is placed by a matrix, so that boxes and planes can be turned and scaled.
"""

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .transforms import normal_matrix


@dataclass
class Hits:
    """What rays, in an array of any shape (...,), hit; id is 0 and t is inf where a ray hit nothing."""

    t: np.ndarray
    id: np.ndarray
    part: np.ndarray  # which face of the shape, so that masks can tell the sides of a box apart
    normal: (
        np.ndarray
    )  # geometric or interpolated, world space, unit, on the side the ray came from
    facing: np.ndarray  # cosine between the normal and the way back to the eye
    position: np.ndarray  # world space, NaN where nothing was hit
    local: np.ndarray  # position in the shape's own space
    uv: np.ndarray
    color: np.ndarray
    distance: np.ndarray

    @property
    def hit(self):
        return self.id > 0


@dataclass
class Shape:
    """A shape with an id, a local-to-world matrix, and the properties pictures need."""

    id: int
    matrix: np.ndarray = field(default_factory=lambda: np.eye(4))
    double_sided: bool = False

    def intersect(self, origins, directions, t_min, t_max):
        """(t, part, local normal, uv, color) for (R, 3) rays in the shape's own space."""
        raise NotImplementedError


@dataclass
class Sphere(Shape):
    radius: float = 1.0

    def intersect(self, origins, directions, t_min, t_max):
        a = (directions * directions).sum(-1)
        b = (origins * directions).sum(-1)
        c = (origins * origins).sum(-1) - self.radius**2
        root = np.sqrt(np.maximum(b * b - a * c, 0))
        near, far = (-b - root) / a, (-b + root) / a
        met = b * b - a * c > 0
        front = met & (near > t_min) & (near < t_max)
        back = met & (far > t_min) & (far < t_max) & self.double_sided
        t = np.where(front, near, np.where(back, far, np.inf))
        local = origins + np.where(np.isfinite(t), t, 0)[:, None] * directions
        return t, np.zeros(len(t), int), local / self.radius, None, None


@dataclass
class Box(Shape):
    size: tuple[float, ...] | float = (1.0, 1.0, 1.0)

    def intersect(self, origins, directions, t_min, t_max):
        half = np.broadcast_to(self.size, 3) / 2
        with np.errstate(divide="ignore", invalid="ignore"):
            a = (-half - origins) / directions
            b = (half - origins) / directions
        low, high = np.fmin(a, b), np.fmax(a, b)
        enter_axis, leave_axis = low.argmax(-1), high.argmin(-1)
        enter, leave = low.max(-1), high.min(-1)
        met = enter <= leave
        front = met & (enter > t_min) & (enter < t_max)
        back = met & (leave > t_min) & (leave < t_max) & self.double_sided
        t = np.where(front, enter, np.where(back, leave, np.inf))
        axis = np.where(front, enter_axis, leave_axis)
        rows = np.arange(len(t))
        forward = directions[rows, axis] > 0
        outward = np.where(front == forward, -1.0, 1.0)
        normal = np.zeros_like(directions)
        normal[rows, axis] = outward
        return t, 2 * axis + (outward < 0), normal, None, None


@dataclass
class Quad(Shape):
    """A width x depth rectangle in the plane y = 0 with normal +Y, as Mesh.plane makes it."""

    width: float = 1.0
    depth: float = 1.0

    def intersect(self, origins, directions, t_min, t_max):
        with np.errstate(divide="ignore", invalid="ignore"):
            t = -origins[:, 1] / directions[:, 1]
        local = origins + np.where(np.isfinite(t), t, 0)[:, None] * directions
        met = (t > t_min) & (t < t_max)
        met &= (np.abs(local[:, 0]) <= self.width / 2) & (np.abs(local[:, 2]) <= self.depth / 2)
        met &= self.double_sided | (origins[:, 1] > 0)
        normal = np.broadcast_to([0.0, 1.0, 0.0], directions.shape)
        return np.where(met, t, np.inf), np.zeros(len(t), int), normal, None, None


@dataclass
class Triangles(Shape):
    """Any mesh; the intersection is by Moller and Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997."""

    positions: Any = None
    indices: Any = None
    normals: Any = None
    uvs: Any = None
    colors: Any = None
    group: int = 48  # triangles that are tried together, with all rays near their bounding sphere

    def intersect(self, origins, directions, t_min, t_max):
        count = len(origins)
        t = np.full(count, np.inf)
        which = np.zeros(count, int)
        bary = np.zeros((count, 2))
        corners = np.asarray(self.positions, float)[np.asarray(self.indices, int)]
        for rows, some in self._groups(np.arange(count), origins, directions, corners):
            found, nth, at = self._chunk(
                origins[rows], directions[rows], corners[some], t_min[rows], t_max[rows]
            )
            # Of triangles that are met at the same place, the first one of the mesh counts.
            nearer = (found < t[rows]) | ((found == t[rows]) & (some[nth] < which[rows]))
            t[rows[nearer]], which[rows[nearer]] = found[nearer], some[nth[nearer]]
            bary[rows[nearer]] = at[nearer]
        weights = np.stack([1 - bary.sum(-1), bary[:, 0], bary[:, 1]], axis=-1)
        vertices = np.asarray(self.indices, int)[which]
        flat = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        smooth = self.normals is not None
        normal = self._interpolate(self.normals, vertices, weights) if smooth else flat[which]
        uv = None if self.uvs is None else self._interpolate(self.uvs, vertices, weights)
        color = None if self.colors is None else self._interpolate(self.colors, vertices, weights)
        sides = np.unique(
            np.round(flat / np.linalg.norm(flat, axis=-1, keepdims=True), 3),
            axis=0,
            return_inverse=True,
        )
        return t, sides[1].reshape(-1)[which], normal, uv, color

    def _groups(self, rows, origins, directions, corners, some=None):
        """Pairs of rays and triangles, as indices: halves of halves of the triangles, with the rays near each half."""
        if some is None:
            some = np.arange(len(corners))
        points = corners[some].reshape(-1, 3)
        low, high = points.min(axis=0), points.max(axis=0)
        center, radius = (low + high) / 2, np.linalg.norm(high - low) / 2 * 1.001 + 1e-9
        offset = center - origins[rows]
        along = (offset * directions[rows]).sum(-1) / (directions[rows] ** 2).sum(-1)
        miss = offset - along[:, None] * directions[rows]
        rows = rows[(miss * miss).sum(-1) <= radius**2]
        if len(rows) == 0:
            return
        if len(some) <= self.group:
            yield rows, some
            return
        order = np.argsort(corners[some].mean(axis=1)[:, (high - low).argmax()], kind="stable")
        for half in np.array_split(order, 2):
            yield from self._groups(rows, origins, directions, corners, np.sort(some[half]))

    def _chunk(self, origins, directions, corners, t_min, t_max):
        """All rays against all triangles; the paper's triple products, turned so that each is a matrix product."""
        a = corners[:, 0]
        e1, e2 = corners[:, 1] - a, corners[:, 2] - a
        n = np.cross(e1, e2)
        moment = np.cross(origins, directions)
        det = -directions @ n.T
        with np.errstate(divide="ignore", invalid="ignore"):
            u = (moment @ e2.T - directions @ np.cross(e2, a).T) / det
            v = (-moment @ e1.T - directions @ np.cross(a, e1).T) / det
            t = (origins @ n.T - (a * n).sum(-1)) / det
            met = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > t_min[:, None]) & (t < t_max[:, None])
        if not self.double_sided:
            met &= det > 0  # in the mesh's own space, so that a mirroring matrix changes nothing
        t = np.where(met, t, np.inf)
        which = t.argmin(-1)
        rows = np.arange(len(t))
        bary = np.nan_to_num(np.stack([u[rows, which], v[rows, which]], axis=-1))
        return (
            t[rows, which],
            which,
            np.where(np.isfinite(t[rows, which])[:, None], bary, 0),
        )

    @staticmethod
    def _interpolate(values, vertices, weights):
        return (np.asarray(values, float)[vertices] * weights[..., None]).sum(1)


def cast(shapes, origins, directions, near=0.0, far=np.inf):
    """The nearest hit of each ray among the shapes, with near < t < far (numbers or one per ray)."""
    directions = np.asarray(directions, float)
    lead = directions.shape[:-1]
    directions = directions.reshape(-1, 3)
    origins = np.broadcast_to(np.asarray(origins, float), (*lead, 3)).reshape(-1, 3)
    count = len(directions)
    near = np.broadcast_to(near, lead).reshape(-1)
    limit = np.broadcast_to(far, lead).reshape(-1).astype(float)
    length = np.linalg.norm(directions, axis=-1)
    best = Hits(
        t=np.full(count, np.inf),
        id=np.zeros(count, np.int32),
        part=np.zeros(count, int),
        normal=np.zeros((count, 3)),
        facing=np.zeros(count),
        position=np.full((count, 3), np.nan),
        local=np.full((count, 3), np.nan),
        uv=np.full((count, 2), np.nan),
        color=np.full((count, 4), np.nan),
        distance=np.full(count, np.inf),
    )
    for shape in shapes:
        inverse = np.linalg.inv(shape.matrix)
        local_origins = origins @ inverse[:3, :3].T + inverse[:3, 3]
        local_directions = directions @ inverse[:3, :3].T
        t, part, normal, uv, color = shape.intersect(
            local_origins, local_directions, near, np.minimum(best.t, limit)
        )
        rows = np.flatnonzero(np.isfinite(t))
        best.t[rows], best.id[rows], best.part[rows] = t[rows], shape.id, part[rows]
        best.local[rows] = local_origins[rows] + t[rows, None] * local_directions[rows]
        best.position[rows] = origins[rows] + t[rows, None] * directions[rows]
        best.distance[rows] = t[rows] * length[rows]
        n = normal[rows] @ normal_matrix(shape.matrix).T
        n /= np.linalg.norm(n, axis=-1, keepdims=True)
        back = -directions[rows] / length[rows, None]
        away = (n * back).sum(-1) < 0
        n[away & shape.double_sided] *= -1
        best.normal[rows] = n
        best.facing[rows] = (n * back).sum(-1)
        best.uv[rows] = np.nan if uv is None else uv[rows]
        best.color[rows] = np.nan
        if color is not None:
            best.color[rows] = 1.0
            best.color[rows, : color.shape[-1]] = color[rows]
    for name, value in vars(best).items():
        setattr(best, name, value.reshape(*lead, *value.shape[1:]))
    return best


def cast_farthest(shapes, origins, directions, near=0.0, far=np.inf):
    """The last hit of each ray: the ray continues behind each hit until it hits nothing."""
    last = cast(shapes, origins, directions, near, far)
    passed = last
    while passed.hit.any():
        beyond = np.where(passed.hit, passed.t * (1 + 1e-9) + 1e-9, np.inf)
        passed = cast(shapes, origins, directions, beyond, far)
        for name, values in vars(passed).items():
            kept = getattr(last, name)
            more = passed.hit.reshape(passed.hit.shape + (1,) * (kept.ndim - passed.hit.ndim))
            setattr(last, name, np.where(more, values, kept))
    return last


def cast_cube(shapes, position, size, near=0.05, far=1000.0, farthest=False):
    """Hits of (6, size, size) rays through the texel centres of a capture."""
    from .cube_faces import texel_directions

    caster = cast_farthest if farthest else cast
    return caster(shapes, np.asarray(position, float), texel_directions(size), near, far)


def cast_frame(shapes, view, projection, size, near, far):
    """Hits of (height, width) rays through the pixel centres of a camera's frame."""
    from .transforms import pixel_rays

    origins, directions = pixel_rays(view, projection, size)
    return cast(shapes, origins, directions, near, far)


def visible(shapes, points, to_light, reach=np.inf, start=1e-4):
    """1.0 where no shape lies between start and reach (world units) on the way to a light; else 0.0.

    to_light: (..., 3) of any length. Surfaces stop light from either side. NaN points give 1.
    """
    solid = [replace(shape, double_sided=True) for shape in shapes]
    lost = ~np.isfinite(points).all(-1)
    origins = np.where(lost[..., None], 0.0, points)
    directions = np.where(lost[..., None], [0.0, 0.0, 1.0], to_light)
    directions = directions / np.linalg.norm(directions, axis=-1, keepdims=True)
    hits = cast(solid, origins, directions, start, reach)
    return np.where(lost | ~hits.hit, 1.0, 0.0)


def interior(*label_maps, radius=1):
    """True where every pixel within the radius carries the same labels: away from silhouettes and creases.

    Label maps are (..., H, W); the neighbourhood stays within a face.
    """
    same = np.ones(label_maps[0].shape, bool)
    for labels in label_maps:
        pad = [(0, 0)] * (labels.ndim - 2) + [(radius, radius)] * 2
        padded = np.pad(labels, pad, mode="edge")
        height, width = labels.shape[-2:]
        for row in range(2 * radius + 1):
            for column in range(2 * radius + 1):
                same &= padded[..., row : row + height, column : column + width] == labels
    return same
