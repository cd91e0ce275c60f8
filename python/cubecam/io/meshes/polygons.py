"""Polygons of mesh files cut into triangles, without triangles outside them and without cracks."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt

from .sweep import swept

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]

# Corners that are looked at together: arrays of one polygon size stay below some ten MiB.
_CHUNK = 1 << 17
# A fan from one corner is tried from this many corners before a polygon goes to the general way. A pentagon without
# crossings is always a fan from one of its corners, and so is every quadrilateral.
_STARTS = 8
# Polygons of more corners are swept: ears need time by the square of the corners where those lie badly.
_MOST_EARS = 1000
# Areas below it, where a polygon is scaled to an extent of about 1, come from rounding.
_NO_AREA = 1e-15


def triangles(positions: Floats, corners: Indices, counts: Indices) -> tuple[Indices, Indices]:
    """Cut polygons into triangles.

    Parameters
    ----------
    positions : (V, 3) float64
    corners : (M,) int64
        The polygons one after another, as indices of `positions`, all of them in range.
    counts : (F,) int64
        How many corners each polygon has; together they are M.

    Returns
    -------
    (T, 3) int64
        Three indices of `corners` (not of `positions`) for each triangle, so that a caller can take along what each
        corner has. The order of a polygon's corners is kept. A polygon of n corners that does not cross itself gives
        n - 2 triangles, which use all its corners; one of fewer than 3 gives none.
    (T,) int64
        The polygon of each triangle, in ascending order.
    """
    counts = np.asarray(counts, dtype=np.int64)
    starts = np.cumsum(counts) - counts
    sizes = np.maximum(counts - 2, 0)
    owners = np.repeat(np.arange(len(counts)), sizes)
    result = np.empty((len(owners), 3), dtype=np.int64)
    slots = np.cumsum(sizes) - sizes
    order = np.argsort(counts, kind="stable")
    ordered = counts[order]
    groups = [0, *(np.flatnonzero(np.diff(ordered)) + 1).tolist(), len(ordered)]
    for begin, end in pairwise(groups):
        count = int(ordered[begin]) if end else 0
        if count < 3:
            continue
        step = max(1, _CHUNK // count)
        for low in range(begin, end, step):
            which = order[low : min(low + step, end)]
            places = starts[which, None] + np.arange(count)
            cut = _of_one_size(positions, corners, places)
            rows = slots[which, None] + np.arange(count - 2)
            cut += np.where(cut[..., :1] < 0, 0, starts[which, None, None])
            result[rows] = cut
    kept = result[:, 0] >= 0
    return (result, owners) if kept.all() else (result[kept], owners[kept])


def _of_one_size(positions: Floats, corners: Indices, places: Indices) -> Indices:
    """Cut K polygons of N corners each: (K, N - 2, 3) with numbers of corners, or -1 where a polygon gave fewer."""
    polygons, count = places.shape
    steps = np.arange(1, count - 1)
    fan = np.stack([np.zeros_like(steps), steps, steps + 1], axis=1)
    if count == 3:
        return np.tile(fan, (polygons, 1, 1))
    flat, sound = _flattened(positions[corners[places]])
    best = np.full(polygons, -np.inf)
    start = np.zeros(polygons, dtype=np.int64)
    open_ = np.flatnonzero(sound)
    for first in range(min(count, _STARTS)):
        least = _fan_areas(flat[open_], first).min(axis=1)
        better = least > best[open_]
        best[open_[better]] = least[better]
        start[open_[better]] = first
        open_ = open_[least <= _NO_AREA]
        if not len(open_):
            break
    result: Indices = fan + start[:, None, None]
    result %= count
    if count > 4:
        for index in open_.tolist():
            result[index] = _any_polygon(flat[index], result[index])
    return result


def _flattened(points: Floats) -> tuple[Floats, npt.NDArray[np.bool_]]:
    """Lay (K, N, 3) polygons into their planes: (K, N, 2), counter-clockwise, with an extent of about 1.

    The plane is Newell's: its normal is the sum of the cross products of consecutive corners, which also fits polygons
    that are not flat. The second array says which polygons have an area. `points` is overwritten.
    """
    sound: npt.NDArray[np.bool_] = np.asarray(np.isfinite(points).all(axis=(1, 2)))
    points[~sound] = 0
    # Powers of two scale without rounding: numbers near the largest float, and near the smallest, have products, too.
    for _ in range(2):
        largest = np.maximum(points.max(axis=(1, 2)), -points.min(axis=(1, 2)))
        _, exponent = np.frexp(largest)
        np.ldexp(points, -exponent[:, None, None], out=points)
        points -= points[:, :1].copy()
    # The last product, from the last corner to the first, is 0: the first corner is the origin.
    here, following = points[:, :-1], points[:, 1:]
    normal = np.stack(
        [
            np.einsum("kn,kn->k", here[..., one], following[..., two])
            - np.einsum("kn,kn->k", here[..., two], following[..., one])
            for one, two in ((1, 2), (2, 0), (0, 1))
        ],
        axis=1,
    )
    length = np.linalg.norm(normal, axis=1)
    sound &= length > _NO_AREA
    x, y, z = np.divide(normal.T, length, out=np.zeros_like(normal.T), where=sound)
    # A basis of the plane without a case where it fails, and without rounding in the planes of the axes: Duff et al.,
    # "Building an Orthonormal Basis, Revisited", Journal of Computer Graphics Techniques 6 (1), 2017.
    sign = np.copysign(1.0, z)
    a = -1 / (sign + z)
    b = x * y * a
    right = np.stack([1 + sign * x * x * a, sign * b, -sign * x], axis=1)
    up = np.stack([b, sign + y * y * a, -y], axis=1)
    flat = np.stack(
        [np.einsum("knc,kc->kn", points, right), np.einsum("knc,kc->kn", points, up)], axis=2
    )
    return flat, sound


def _fan_areas(flat: Floats, first: int) -> Floats:
    """Twice the signed areas of the triangles of a fan from one corner: (K, N - 2)."""
    turned = np.roll(flat, -first, axis=1) if first else flat
    spokes = turned[:, 1:] - turned[:, :1]
    return np.asarray(spokes[:, :-1, 0] * spokes[:, 1:, 1] - spokes[:, :-1, 1] * spokes[:, 1:, 0])


def _any_polygon(flat: Floats, fan: Indices) -> Indices:
    """Cut one polygon of N corners, (N, 2): (N - 2, 3), the last rows -1 where it crosses itself."""
    count = len(flat)
    if count > _MOST_EARS:
        cut = swept(flat)
        return fan if cut is None else cut
    from mapbox_earcut import triangulate_float64

    ring = np.array([count], dtype=np.uint32)
    cut = triangulate_float64(np.ascontiguousarray(flat), ring).reshape(-1, 3).astype(np.int64)
    cut.sort(axis=1)  # ascending corners go round as the polygon does
    if 0 < len(cut) < count - 2:
        cut = _with_dropped_corners(cut, flat)
    # A polygon that crosses itself may give a corner twice.
    a, b, c = cut.T
    cut = cut[(a != b) & (b != c) & (c != a)][: count - 2]
    if not len(cut):
        return fan
    result = np.full((count - 2, 3), -1, dtype=np.int64)
    result[: len(cut)] = cut
    return result


def _with_dropped_corners(cut: Indices, flat: Floats) -> Indices:
    """Put corners back that ears left out since they are on a straight line between others.

    Without them the edge of a triangle would pass a corner that its neighbours have: a crack. The edges that have no
    partner form loops: one long edge, and the way back through the corners that were left out. The triangle at the long
    edge is divided.
    """
    count = len(flat)
    faces = cut.tolist()
    at: dict[tuple[int, int], int] = {}
    for number, (a, b, c) in enumerate(faces):
        at[a, b] = at[b, c] = at[c, a] = number
    onward: dict[int, list[int]] = {}
    for a, b in at:
        if (b, a) not in at and b != (a + 1) % count:
            onward.setdefault(a, []).append(b)
    for a in range(count):
        b = (a + 1) % count
        if (a, b) not in at:
            onward.setdefault(b, []).append(a)
    for loop in _loops(onward):
        edges = [edge for edge in zip(loop, [*loop[1:], loop[0]], strict=True) if edge in at]
        if len(loop) < 3 or not edges:
            continue
        a, b = max(edges, key=lambda edge: float(np.hypot(*(flat[edge[1]] - flat[edge[0]]))))
        number = at.pop((a, b))
        c = next(corner for corner in faces[number] if corner not in (a, b))
        turned = loop.index(b)
        way = (loop[turned:] + loop[:turned])[::-1]  # from a to b
        for place, (one, two) in enumerate(pairwise(way)):
            if place:
                faces.append([])
                number = len(faces) - 1
            faces[number] = [one, two, c]
            at[one, two] = at[two, c] = at[c, one] = number
    return np.array(faces, dtype=np.int64)


def _loops(onward: dict[int, list[int]]) -> list[list[int]]:
    """Take directed edges apart into loops that pass each corner once. `onward` is used up."""
    found = []
    for origin in list(onward):
        while onward[origin]:
            path, places = [origin], {origin: 0}
            while onward.get(path[-1]):
                step = onward[path[-1]].pop()
                if step in places:
                    cut = places[step]
                    found.append(path[cut:])
                    for corner in path[cut + 1 :]:
                        del places[corner]
                    del path[cut + 1 :]
                else:
                    places[step] = len(path)
                    path.append(step)
    return found
