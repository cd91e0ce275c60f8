"""Wavefront OBJ files, by the specification: appendix B1 of the manual of Wavefront's Advanced Visualizer.

Faces become triangles. Points, lines, curves and surfaces are skipped, and so are `call` and `csh`. No other file is
opened: the names of material libraries are kept for later.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .obj_text import FACE, NORMAL, POSITION, TEXTURE, Lines, readable
from .parts import Part
from .polygons import triangles

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]

# Above it, a colour is one of 0..255; rounding may lift one of 0..1 a little above 1.
_MOST_OF_UNIT = 1.5


@dataclass(slots=True)
class Run:
    """Polygons `first` to before `stop` that have the same names; "" where the file has none.

    `groups` are the names of a `g` line. `smoothing` is the word of an `s` line; normals are computed smooth over all
    faces without looking at it.
    """

    object: str
    groups: tuple[str, ...]
    material: str
    smoothing: str
    first: int
    stop: int


@dataclass
class Obj:
    """What an OBJ file holds.

    `polygons` (T,) has the polygon of each triangle of `part`, counted among those of three corners or more; `runs` are
    in the file's order and have each polygon once. `libraries` has the text of each `mtllib` line.
    """

    part: Part
    polygons: Indices
    runs: list[Run]
    libraries: list[str]


def read(path: Path, data: bytes) -> list[Part]:
    """Read the triangles of a file."""
    return [parsed(data).part]


def parsed(data: bytes) -> Obj:
    """Read a file with its names."""
    text = readable(data)
    lines = Lines(text)
    positions, colors = _vertices(lines, text)
    faces = lines.of(FACE)
    counts = lines.counts[faces]
    columns = _absolute(lines, faces, counts, lines.indices())
    polygons = np.flatnonzero(counts >= 3)
    if not len(polygons):
        raise MeshError(f"expected triangles, got {len(positions)} vertices without any")
    if len(polygons) < len(counts):  # fewer corners make points and lines
        kept = np.repeat(counts >= 3, counts)
        columns = [None if column is None else column[kept] for column in columns]
        faces, counts = faces[polygons], counts[polygons]
    corners = columns[0]
    assert corners is not None
    cut, owners = triangles(positions, corners, counts)
    number, chosen = _split(columns, len(positions))
    part = Part(
        positions[corners[chosen]],
        number[cut],
        _taken(_of_width(lines, NORMAL, 3, 3), columns[2], chosen),
        _taken(_of_width(lines, TEXTURE, 2, 1), columns[1], chosen),
        None if colors is None else colors[corners[chosen]],
    )
    runs, libraries = _names(lines, faces)
    return Obj(part, owners, runs, libraries)


def _vertices(lines: Lines, text: bytes) -> tuple[Floats, Floats | None]:
    """Read positions (V, 3), and colours (V, 4) if a line has one.

    A line has x y z, and maybe a weight of rational curves, which has no meaning for polygons, or a colour: r g b, or
    r g b a. Vertices without a colour are white.
    """
    which = lines.of(POSITION)
    counts = lines.counts[which]
    wrong = np.flatnonzero(~np.isin(counts, (3, 4, 6, 7)))
    if len(wrong):
        message = "expected a position of three numbers, maybe a weight or a colour, got"
        raise lines.error(int(which[wrong[0]]), f"{message} {counts[wrong[0]]} numbers")
    values = lines.floats(POSITION)
    starts = np.cumsum(counts) - counts
    positions = values[starts[:, None] + np.arange(3)]
    colored = np.flatnonzero(counts >= 6)
    if not len(colored):
        return positions, _painted(text, len(positions))
    rows = values[starts[colored, None] + np.arange(3, 6)]
    colors = np.ones((len(positions), 4))
    alpha = np.flatnonzero(counts == 7)
    opacity = values[starts[alpha] + 6]
    scale = 255.0 if max(rows.max(), opacity.max(initial=0)) > _MOST_OF_UNIT else 1.0
    colors[colored, :3] = rows / scale
    colors[alpha, 3] = opacity / scale
    return positions, colors


def _painted(text: bytes, count: int) -> Floats | None:
    """Read the colours that ZBrush writes into comments: #MRGB and 8 digits MMRRGGBB for each vertex."""
    if b"#MRGB" not in text:
        return None
    found = b"".join(re.findall(rb"^ *#MRGB +([0-9A-Fa-f]+) *$", text, flags=re.MULTILINE))
    if not count or len(found) != 8 * count:
        return None
    colors = np.ones((count, 4))
    colors[:, :3] = np.frombuffer(bytes.fromhex(found.decode()), np.uint8).reshape(-1, 4)[:, 1:]
    colors[:, :3] /= 255
    return colors


def _of_width(lines: Lines, kind: int, width: int, least: int) -> Floats:
    """Read texture coordinates or normals: `width` numbers of each line, 0 for those that it may leave out."""
    which = lines.of(kind)
    counts = lines.counts[which]
    wrong = np.flatnonzero((counts < least) | (counts > 3))
    if len(wrong):
        what = "a normal of three numbers" if kind == NORMAL else "one to three texture coordinates"
        got = counts[wrong[0]]
        raise lines.error(int(which[wrong[0]]), f"expected {what}, got {got} numbers")
    values = lines.floats(kind)
    starts = np.cumsum(counts) - counts
    result = np.zeros((len(which), width))
    for column in range(width):
        there = counts > column
        result[there, column] = values[starts[there] + column]
    return result


def _absolute(
    lines: Lines, faces: Indices, counts: Indices, columns: list[Indices | None]
) -> list[Indices | None]:
    """Count all indices from 0; -1 for none. Negative ones count back from the line where they stand."""
    result: list[Indices | None] = []
    kinds = (POSITION, TEXTURE, NORMAL)
    names = ("positions", "texture coordinates", "normals")
    for column, kind, name in zip(columns, kinds, names, strict=True):
        if column is None:
            result.append(None)
            continue
        listed = lines.of(kind)
        total = len(listed)
        absolute = column - 1
        back = np.flatnonzero(column < 0)
        if len(back):
            before = np.searchsorted(listed, faces)
            face = np.searchsorted(np.cumsum(counts), back, side="right")
            absolute[back] = column[back] + before[face]
            absolute[back[absolute[back] < 0]] = total  # out of range, and not a missing one
        wrong = np.flatnonzero(absolute >= total)
        if len(wrong):
            line = faces[np.searchsorted(np.cumsum(counts), wrong[0], side="right")]
            before = np.searchsorted(listed, line)
            expected = f"indices of {name} 1 to {total} or -{before} to -1"
            if not total:
                expected = f"no indices of {name}, since the file has none"
            raise lines.error(int(line), f"expected {expected}, got {column[wrong[0]]}")
        result.append(absolute)
    return result


def _split(columns: list[Indices | None], total: int) -> tuple[Indices, Indices]:
    """Give each distinct triple of indices a vertex, in the order of the positions.

    Returns the vertex of each corner, and one corner of each vertex. Positions of no face get no vertex.
    """
    corners = columns[0]
    assert corners is not None
    others = [c for c in columns[1:] if c is not None and not np.array_equal(c, corners)]
    if not others:
        chosen = np.full(total, -1)
        chosen[corners] = np.arange(len(corners))
        used = chosen >= 0
        number = np.cumsum(used) - 1
        return number[corners], chosen[used]
    key = corners
    for column in others:
        size = int(column.max()) + 2
        if (int(key.max()) + 1) * size > np.iinfo(np.int64).max:
            key = np.unique(key, return_inverse=True)[1].reshape(-1)
        key = key * size + (column + 1)
    _, chosen, number = np.unique(key, return_index=True, return_inverse=True)
    return number.reshape(-1), chosen


def _taken(values: Floats, column: Indices | None, chosen: Indices) -> Floats | None:
    """Take a row for each vertex; zeros where the file has none."""
    if column is None:
        return None
    rows = column[chosen]
    result = np.zeros((len(rows), values.shape[1]))
    there = rows >= 0
    result[there] = values[rows[there]]
    return result


def _names(lines: Lines, faces: Indices) -> tuple[list[Run], list[str]]:
    """Read objects, groups, materials and smoothing groups, and the names of material libraries."""
    runs: list[Run] = []
    libraries: list[str] = []
    now = {"o": "", "g": "", "usemtl": "", "s": ""}
    first = 0

    def close(stop: int) -> None:
        nonlocal first
        if stop > first:
            groups = tuple(now["g"].split())
            runs.append(Run(now["o"], groups, now["usemtl"], now["s"], first, stop))
            first = stop

    named = lines.named()
    stops = np.searchsorted(faces, [line for line, _, _ in named]).tolist()
    for (_, word, rest), stop in zip(named, stops, strict=True):
        if word == "mtllib":
            libraries.append(rest)
        elif now[word] != rest:
            close(stop)
            now[word] = rest
    close(len(faces))
    return runs, libraries
