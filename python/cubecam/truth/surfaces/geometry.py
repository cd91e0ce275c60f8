"""What rays meet: Embree finds the triangles in float32, and all else is computed in float64."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

from ..arrays import Array, Bools, Ints
from ..scene.snapshot import Snapshot
from .holes import in_holes, nodes_with_holes, solid_nodes
from .trees import Tree, embree

#: The rounding of a float32, relative.
_ROUNDING = 2.0**-24
#: Added to directions of length 1, for Embree alone: a ray that meets a corner of triangles exactly may pass between
#: all of them (about 1 of 400 such rays did), and scenes and cameras are often so even that rays meet corners.
_ASIDE = 6e-7 * np.array([0.5377, -0.8339, 0.1243])
#: What counts as the plane of a triangle itself, relative to the coordinates: the rounding of float64.
_ON_PLANE = 1e-13
#: Whether hits count, of rays (R,) on triangles (R,) that show their fronts or not (R,).
_Counts: TypeAlias = Callable[[Ints, Ints, Bools], Bools]


@dataclass
class Hits:
    """What rays meet first.

    Attributes
    ----------
    triangle : ndarray (R,) int64
        Its place in the snapshot; -1 where a ray meets nothing.
    distance : ndarray (R,) float64
        In lengths of the ray's direction; inf where it meets nothing.
    weights : ndarray (R, 3) float64
        Of the triangle's corners; their sum is 1.
    """

    triangle: Ints
    distance: Array
    weights: Array


class Geometry:
    """Triangles of a snapshot, for queries of rays.

    Parameters
    ----------
    snapshot : Snapshot
    triangles : ndarray (T,) bool, optional
        Which triangles there are. None: all.

    Raises
    ------
    ImportError
        If the package embreex is missing.

    Notes
    -----
    Origins are rounded to float32, so a ray that leaves a surface could meet this surface again. Therefore the triangle
    that it leaves never counts, and a hit only counts if it lies in front of the exact origin in float64. What does not
    count is searched beyond. So that this is rare, origins are moved a few roundings along the normal (C. Waechter and
    N. Binder, "A Fast and Robust Method for Avoiding Self-Intersection", Ray Tracing Gems, 2019, chapter 6).
    Coordinates count from the middle of the triangles.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> from cubecam.truth.surfaces.geometry import Geometry
    >>> from cubecam.truth.scene.snapshot import read
    >>> scene = cc.Scene()
    >>> wall = scene.add(cc.Mesh.box((4, 4, 1)))
    >>> geometry = Geometry(read(scene))
    >>> hits = geometry.cast(np.array([[0, 0, 3.]]), np.array([[.1, .2, -1]]))
    >>> hits.distance.round(12).tolist(), int(hits.triangle[0]) >= 0
    ([2.5], True)
    """

    def __init__(self, snapshot: Snapshot, triangles: Bools | None = None) -> None:
        self._embree = embree()
        self._snapshot = snapshot
        corners = snapshot.corners
        across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        kept = np.any(across != 0, axis=1)  # no ray meets a triangle without an area
        if triangles is not None:
            kept = kept & triangles
        self._rows = np.flatnonzero(kept)
        self._middle = np.zeros(3)
        if len(self._rows):
            points = corners[self._rows].reshape(-1, 3)
            self._middle = (points.min(axis=0) + points.max(axis=0)) / 2
        with np.errstate(all="ignore"):  # those without an area
            self._area = np.linalg.norm(across, axis=1)
            self._normal = across / self._area[:, None]
        self._size = np.abs(corners).max(axis=(1, 2))
        self._masked = nodes_with_holes(snapshot)
        self._any_masked = bool(np.any(self._masked[snapshot.node[self._rows]]))
        self._double = np.array([node.double_sided for node in snapshot.nodes], bool)
        self._whole = self._tree(self._rows)
        self._halves: list[Tree] | None = None
        self._solid: Tree | None = None

    def cast(
        self,
        origins: Array,
        directions: Array,
        inside: Ints | None = None,
        *,
        start: Ints | None = None,
    ) -> Hits:
        """Find what rays meet first.

        Rays pass through the back faces of single-sided nodes and the holes of alpha masks.

        Parameters
        ----------
        origins, directions : ndarray (R, 3) float64
            World space; distances are in lengths of the directions.
        inside : ndarray (R,) int, optional
            The place in `Snapshot.nodes` of the body in which a ray runs, or -1: it meets the back faces of this node
            and passes through its front faces.
        start : ndarray (R,) int, optional
            The triangle on which a ray begins, which it never meets, or -1.
        """

        def counts(rows: Ints, met: Ints, front: Bools) -> Bools:
            nodes = self._snapshot.node[met]
            good = front | self._double[nodes]
            return good if inside is None else np.where(nodes == inside[rows], ~front, good)

        origins, directions = np.asarray(origins, float), np.asarray(directions, float)
        return self._first(_Rays(self, origins, directions, start), counts)

    def blocked(
        self, origins: Array, directions: Array, reach: Array, *, start: Ints | None = None
    ) -> Bools:
        """Return (R,) whether anything lies on rays before `reach` (R,), in lengths of the directions; inf: no end.

        Surfaces stop these rays from either side, except the triangle `start` (R,) and the holes of alpha masks.
        """

        def counts(rows: Ints, met: Ints, front: Bools) -> Bools:
            return np.ones(len(met), bool)

        origins, directions = np.asarray(origins, float), np.asarray(directions, float)
        rays = _Rays(self, origins, directions, start)
        # Embree's distances are rounded, and what lies just before the end must not be missed.
        ends = np.broadcast_to(reach, len(origins)) * 1.00001
        ends = ends + 64 * _ROUNDING * rays.size / rays.length
        found = self._whole.occluded(rays.moved, rays.aimed, ends)
        rows = np.flatnonzero(found)
        # Embree says that there is something, in float32: only what is there in float64 counts.
        if len(rows):
            hits = self._first(rays.take(rows), counts)
            found[rows] = hits.distance < np.broadcast_to(reach, found.shape)[rows]
        return found

    def touching(self, origins: Array, directions: Array, start: Ints) -> tuple[Ints, Hits]:
        """Find what touches, from behind, the triangles `start` (R,) through which rays go.

        `cast` begins beyond these triangles, so that it may miss a surface in the same plane, or behind it by less than
        the rounding of a float32. Only surfaces of other nodes count, and of these only such that let no light through.
        Returns the rows of the rays that meet one, and these hits.
        """
        if self._solid is None:
            self._solid = self._tree(
                self._rows[solid_nodes(self._snapshot)[self._snapshot.node[self._rows]]]
            )
        rays = _Rays(self, origins, directions, start)
        back = 2 * (rays.moved - (origins - self._middle))
        rows, met = self._solid.nearest(rays.moved - back, rays.aimed)
        normal = self._normal[met]
        away = _dot(self._snapshot.corners[met, 0] - origins[rows], normal)
        towards = _dot(directions[rows], normal)
        near = np.abs(away) <= np.linalg.norm(back[rows], axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            distance = away / towards
        near &= (distance >= 0) | (np.abs(away) <= _ON_PLANE * (self._size[met] + rays.reach[rows]))
        nodes = self._snapshot.node
        near &= (nodes[met] != nodes[start[rows]]) & ((towards < 0) | self._double[nodes[met]])
        rows, met, distance = rows[near], met[near], np.maximum(distance[near], 0)
        weights = self._weights(met, origins[rows] + distance[:, None] * directions[rows])
        if self._any_masked:
            kept = ~in_holes(self._snapshot, met, weights, self._masked)
            rows, met, distance, weights = rows[kept], met[kept], distance[kept], weights[kept]
        return rows, Hits(met, distance, weights)

    def _first(self, rays: _Rays, counts: _Counts) -> Hits:
        """Find the first hits that count."""
        count = len(rays.origins)
        hits = Hits(np.full(count, -1), np.full(count, np.inf), np.zeros((count, 3)))
        rows, met = self._whole.nearest(rays.moved, rays.aimed)
        distance, weights, good = self._examine(rays, rows, met, counts)
        _note(hits, rows[good], met[good], distance[good], weights[good])
        left = rows[~good]
        if not len(left):
            return hits
        # A back face may lie exactly on a front face of the other direction, as the two sides of a leaf do. No triangle
        # can be left out of a query, so the two kinds of triangles are searched one by one.
        for tree in self._both_halves():
            self._search(tree, rays, left, np.maximum(distance[~good], 0), counts, hits)
        return hits

    def _search(
        self, tree: Tree, rays: _Rays, rows: Ints, begin: Array, counts: _Counts, hits: Hits
    ) -> None:
        """Follow rays through a part of the triangles from just before a distance until a hit counts."""
        size = rays.size[rows] / rays.length[rows]
        step = 8 * _ROUNDING * (size + begin)
        passed = begin
        begin = np.maximum(begin - step, 0)
        moved = rays.moved
        while len(rows):
            from_here = moved[rows] + begin[:, None] * rays.directions[rows]
            some, met = tree.nearest(from_here, rays.aimed[rows])
            rows, begin, step, passed = rows[some], begin[some], step[some], passed[some]
            distance, weights, good = self._examine(rays, rows, met, counts)
            nearer = good & (distance < hits.distance[rows])
            _note(hits, rows[nearer], met[nearer], distance[nearer], weights[nearer])
            left = ~good & (begin < hits.distance[rows])
            rows, distance = rows[left], np.nan_to_num(distance[left])
            begin, step, passed = begin[left], step[left], passed[left]
            # Where rounding lets a ray meet again what it passed, it goes on in steps that become greater.
            ahead = distance > passed
            step = np.where(
                ahead, 4 * _ROUNDING * (rays.size[rows] / rays.length[rows] + distance), 2 * step
            )
            passed = np.maximum(passed, distance)
            begin = np.maximum(begin, passed) + step

    def _examine(
        self, rays: _Rays, rows: Ints, met: Ints, counts: _Counts
    ) -> tuple[Array, Array, Bools]:
        """Return the exact distances of triangles along rays, the weights of their corners, and whether they count."""
        normal, directions = self._normal[met], rays.directions[rows]
        away = _dot(self._snapshot.corners[met, 0] - rays.origins[rows], normal)
        towards = _dot(directions, normal)
        with np.errstate(divide="ignore", invalid="ignore"):  # rays in the plane of the triangle
            distance = away / towards
        good = np.isfinite(distance) & (distance > 0)
        good &= np.abs(away) > _ON_PLANE * (self._size[met] + rays.reach[rows])
        if rays.start is not None:
            good &= met != rays.start[rows]
        good &= counts(rays.rows[rows], met, towards < 0)
        some = np.flatnonzero(good)
        weights = np.zeros((len(met), 3))
        position = rays.origins[rows[some]] + distance[some, None] * directions[some]
        weights[some] = self._weights(met[some], position)
        if self._any_masked:
            some = some[self._masked[self._snapshot.node[met[some]]]]
            good[some] = ~in_holes(self._snapshot, met[some], weights[some], self._masked)
        return distance, weights, good

    def _weights(self, triangles: Ints, position: Array) -> Array:
        """Return the weights (R, 3) of corners at positions, from 0 to 1: Embree's own edge may be a rounding away."""
        a, b, c = np.moveaxis(self._snapshot.corners[triangles], 1, 0)
        normal, area = self._normal[triangles], self._area[triangles]
        v = _dot(np.cross(position - a, c - a), normal) / area
        w = _dot(np.cross(b - a, position - a), normal) / area
        weights = np.clip(np.stack([1 - v - w, v, w], axis=1), 0, None)
        summed: Array = weights / weights.sum(axis=1, keepdims=True)
        return summed

    def _both_halves(self) -> list[Tree]:
        """Return the triangles in two parts, so that the two sides of one plane are never in the same part."""
        if self._halves is None:
            side = self._normal[self._rows] @ (0.5377, 0.8339, 0.1243) > 0
            self._halves = [self._tree(self._rows[side]), self._tree(self._rows[~side])]
        return self._halves

    def _tree(self, rows: Ints) -> Tree:
        return Tree(self._embree, self._snapshot.corners[rows] - self._middle, rows)

    @property
    def middle(self) -> Array:
        """The point (3,) from which the coordinates given to Embree count."""
        return self._middle

    def facing(self, triangles: Ints, directions: Array) -> tuple[Array, Array]:
        """Return unit normals (R, 3) on the side to which directions lead, and the triangles' greatest coordinates."""
        normal = self._normal[triangles]
        normal = np.where(_dot(normal, directions) < 0, -1, 1)[:, None] * normal
        size = np.abs(self._snapshot.corners[triangles] - self._middle).max(axis=(1, 2))
        return normal, size


class _Rays:
    """Rays with exact origins, and with those that Embree gets, which count from the geometry's middle."""

    def __init__(
        self, geometry: Geometry, origins: Array, directions: Array, start: Ints | None
    ) -> None:
        self.origins, self.directions, self.start = origins, directions, start
        self.rows: Ints = np.arange(len(origins))
        self.moved = origins - geometry.middle
        self.size = np.abs(self.moved).max(axis=1, initial=0)
        self.reach = np.abs(origins).max(axis=1, initial=0)
        self.length = np.linalg.norm(directions, axis=1)
        self.aimed = directions + self.length[:, None] * _ASIDE
        if start is not None:
            some = np.flatnonzero(start >= 0)
            normal, size = geometry.facing(start[some], directions[some])
            offset = 8 * _ROUNDING * np.maximum(self.size[some], size)
            self.moved[some] += offset[:, None] * normal

    def take(self, rows: Ints) -> _Rays:
        """Return some of the rays."""
        taken = object.__new__(_Rays)
        taken.start = None if self.start is None else self.start[rows]
        for name in ("origins", "directions", "rows", "moved", "size", "reach", "length", "aimed"):
            setattr(taken, name, getattr(self, name)[rows])
        return taken


def _note(hits: Hits, rows: Ints, met: Ints, distance: Array, weights: Array) -> None:
    hits.triangle[rows], hits.distance[rows], hits.weights[rows] = met, distance, weights


def _dot(a: Array, b: Array) -> Array:
    product: Array = np.einsum("ri,ri->r", a, b)
    return product
