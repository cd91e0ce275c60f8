"""Polygons of very many corners cut into triangles by a sweep: ears would need time by the square of the corners.

The steps are those of de Berg et al., "Computational Geometry", 3rd edition, chapter 3: a line goes from the top to the
bottom, diagonals cut the polygon into pieces that are monotone along y, and each piece is cut by a stack.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]

# The line may cross so many edges: a list of edges moves its memory at each insertion.
_MOST_EDGES = 150_000
# Areas may differ by so much from rounding, where the extent is about 1.
_ROUNDING = 1e-9


def swept(flat: Floats) -> Indices | None:
    """Cut a counter-clockwise polygon (N, 2) into N - 2 triangles; None if it crosses or touches itself."""
    count = len(flat)
    order = np.lexsort((flat[:, 0], -flat[:, 1]))
    apart = (flat[order[1:]] != flat[order[:-1]]).any(axis=1)
    if 2 * int(apart.sum()) < count:
        return None  # most corners lie on another one
    rank = np.empty(count, dtype=np.int64)
    rank[order] = np.arange(count)
    diagonals = _diagonals(flat, order, rank)
    if diagonals is None:
        return None
    cut = _monotone_pieces(flat, rank, np.array(diagonals, dtype=np.int64).reshape(-1, 2))
    if cut is None or len(cut) != count - 2:
        return None
    a, b, c = np.moveaxis(flat[cut], 1, 0)
    areas = (b[:, 0] - a[:, 0]) * (c[:, 1] - a[:, 1]) - (b[:, 1] - a[:, 1]) * (c[:, 0] - a[:, 0])
    x, y = flat.T
    whole = float((x * np.roll(y, -1) - np.roll(x, -1) * y).sum())
    good = areas.min() > -_ROUNDING and abs(float(areas.sum()) - whole) < _ROUNDING * count**0.5
    return cut if good else None


def _diagonals(flat: Floats, order: Indices, rank: Indices) -> list[tuple[int, int]] | None:
    """Find the diagonals that leave pieces which are monotone along y."""
    count = len(flat)
    before, after = np.roll(flat, 1, axis=0) - flat, np.roll(flat, -1, axis=0) - flat
    convex = (after[:, 0] * before[:, 1] - after[:, 1] * before[:, 0]) > 0
    previous_above = np.roll(rank, 1) < rank
    following_above = np.roll(rank, -1) < rank
    # 0: left chain, 1: right chain, 2: start, 3: split, 4: end, 5: merge
    kinds = np.where(previous_above, 0, 1)
    kinds[~previous_above & ~following_above] = 3
    kinds[~previous_above & ~following_above & convex] = 2
    kinds[previous_above & following_above] = 5
    kinds[previous_above & following_above & convex] = 4
    kind: list[int] = kinds.tolist()
    xs: list[float] = flat[:, 0].tolist()
    ys: list[float] = flat[:, 1].tolist()
    fall = flat[:, 1] - np.roll(flat[:, 1], -1)
    run = np.roll(flat[:, 0], -1) - flat[:, 0]
    slope: list[float] = np.divide(run, fall, out=np.zeros(count), where=fall != 0).tolist()

    # An edge that the line crosses, with the polygon at its right, is known by its place in `crossed`: a list of its
    # upper corner and its helper, the lowest corner above the line that can be reached from it.
    crossed: list[list[int]] = []
    place_of: dict[int, list[int]] = {}
    found: list[tuple[int, int]] = []

    def left_of(corner: int) -> int:
        """How many crossed edges are left of a corner."""
        x, y = xs[corner], ys[corner]
        low, high = 0, len(crossed)
        while low < high:
            middle = (low + high) // 2
            edge = crossed[middle][0]
            if xs[edge] + (ys[edge] - y) * slope[edge] < x:
                low = middle + 1
            else:
                high = middle
        return low

    def removed(entry: list[int], corner: int) -> bool:
        low = left_of(corner)
        for place in range(max(0, low - 8), min(len(crossed), low + 8)):
            if crossed[place] is entry:
                del crossed[place]
                return True
        return False

    for corner in order.tolist():
        what = kind[corner]
        if what in (0, 4, 5):
            entry = place_of.pop((corner - 1) % count, None)
            if entry is None:
                return None
            if kind[entry[1]] == 5:
                found.append((corner, entry[1]))
            if what == 0:
                entry[0] = entry[1] = corner
                place_of[corner] = entry
            elif not removed(entry, corner):
                return None
        if what in (1, 3, 5):
            low = left_of(corner)
            if not low:
                return None
            entry = crossed[low - 1]
            if what == 3 or kind[entry[1]] == 5:
                found.append((corner, entry[1]))
            entry[1] = corner
        if what in (2, 3):
            if len(crossed) == _MOST_EDGES:
                return None
            entry = [corner, corner]
            crossed.insert(left_of(corner), entry)
            place_of[corner] = entry
    return found


def _monotone_pieces(flat: Floats, rank: Indices, diagonals: Indices) -> Indices | None:
    """Cut a polygon along diagonals, and the pieces into triangles."""
    count = len(flat)
    ring = np.arange(count)
    tails = np.concatenate([ring, np.roll(ring, -1), diagonals[:, 0], diagonals[:, 1]])
    heads = np.concatenate([np.roll(ring, -1), ring, diagonals[:, 1], diagonals[:, 0]])
    ways = len(diagonals)
    twins = np.concatenate(
        [ring + count, ring, 2 * count + ways + np.arange(ways), 2 * count + np.arange(ways)]
    )
    step = flat[heads] - flat[tails]
    sorted_ = np.lexsort((np.arctan2(step[:, 1], step[:, 0]), tails))
    place = np.empty_like(sorted_)
    place[sorted_] = np.arange(len(sorted_))
    starts = np.searchsorted(tails[sorted_], ring)
    ends = np.searchsorted(tails[sorted_], ring, side="right")
    # At the end of an edge, a piece goes on along the edge that is next clockwise from the way back.
    clockwise = place[twins] - 1
    wrapped = clockwise < starts[heads]
    clockwise[wrapped] = ends[heads[wrapped]] - 1
    onward: list[int] = sorted_[clockwise].tolist()
    tail: list[int] = tails.tolist()
    level: list[int] = rank.tolist()
    xs: list[float] = flat[:, 0].tolist()
    ys: list[float] = flat[:, 1].tolist()
    seen = bytearray(len(onward))
    seen[count : 2 * count] = b"\1" * count  # the outside
    faces: list[int] = []
    for first in range(len(onward)):
        if seen[first]:
            continue
        piece = []
        edge = first
        while not seen[edge]:
            seen[edge] = 1
            piece.append(tail[edge])
            edge = onward[edge]
        if edge != first or len(piece) < 3:
            return None
        _cut_monotone(piece, level, xs, ys, faces)
    return np.array(faces, dtype=np.int64).reshape(-1, 3)


def _cut_monotone(
    piece: list[int], level: list[int], xs: list[float], ys: list[float], faces: list[int]
) -> None:
    """Cut one piece that is monotone along y, counter-clockwise, and append three corners for each triangle."""
    if len(piece) == 3:
        faces.extend(piece)
        return
    top = min(range(len(piece)), key=lambda place: level[piece[place]])
    piece = piece[top:] + piece[:top]
    bottom = max(range(len(piece)), key=lambda place: level[piece[place]])
    on_left = dict.fromkeys(
        piece[:bottom], True
    )  # counter-clockwise: from the top down the left side
    on_left.update(dict.fromkeys(piece[bottom:], False))
    ordered = sorted(piece, key=level.__getitem__)
    stack = ordered[:2]
    for corner in ordered[2:-1]:
        left = on_left[corner]
        if left != on_left[stack[-1]]:
            for one, two in pairwise(stack):
                faces.extend((one, corner, two) if left else (corner, one, two))
            stack = [stack[-1], corner]
            continue
        last = stack.pop()
        while stack:
            one = stack[-1]
            area = (xs[last] - xs[one]) * (ys[corner] - ys[one]) - (ys[last] - ys[one]) * (
                xs[corner] - xs[one]
            )
            if (area if left else -area) <= 0:
                break
            faces.extend((one, last, corner) if left else (last, one, corner))
            last = stack.pop()
        stack.append(last)
        stack.append(corner)
    corner = ordered[-1]
    left = not on_left[stack[-1]]
    for one, two in pairwise(stack):
        faces.extend((one, corner, two) if left else (corner, one, two))
