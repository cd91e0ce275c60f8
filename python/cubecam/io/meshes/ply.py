"""PLY files: vertices, faces and triangle strips, text and binary.

The format has no standard beyond Greg Turk's description of 1994, "The PLY Polygon File Format": names of properties
are a matter of custom. Those that are read here are the ones that common programs write.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .parts import Part
from .plain_text import narrow, numbers, with_nan, wrong_word
from .ply_header import Header, read_header
from .ply_tables import Binary, Numbers, Source, Table, Text
from .wedges import Polygons, part

if TYPE_CHECKING:
    from pathlib import Path

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]

_UVS = (
    ("s", "t"),
    ("u", "v"),
    ("texture_u", "texture_v"),
    ("texture_s", "texture_t"),
    ("tx", "ty"),
)
_COLORS = (
    ("red", "green", "blue", "alpha"),
    ("diffuse_red", "diffuse_green", "diffuse_blue", "diffuse_alpha"),
    ("r", "g", "b", "a"),
)
_INDICES = ("vertex_indices", "vertex_index")
_ELEMENTS = ("vertex", "face", "tristrips")


def read(path: Path, data: bytes) -> list[Part]:
    """Read a PLY file. Colours of faces or of their corners are read if vertices have none."""
    data = narrow(data)
    tables = _tables(data, read_header(data))
    if "vertex" not in tables:
        raise MeshError("expected an element vertex, got none")
    vertex = tables["vertex"]
    positions = _columns(vertex, ("x", "y", "z"))
    if positions is None:
        names = ", ".join(each.name for each in vertex.element.properties) or "none"
        raise MeshError(f"expected properties x, y and z of element vertex, got {names}")
    uvs = next((uvs for pair in _UVS if (uvs := _columns(vertex, pair)) is not None), None)
    colors = _colors(vertex)
    faces = _faces(tables.get("face"), uvs, wants_colors=colors is None)
    if "tristrips" in tables:
        faces = _joined(faces, _strips(tables["tristrips"]), uvs)
    normals = _columns(vertex, ("nx", "ny", "nz"))
    return [part(positions, faces, normals=normals, uvs=uvs, colors=colors)]


def _tables(data: bytes, header: Header) -> dict[str, Table]:
    """Find the rows of all elements; return the tables of those that are read."""
    source: Source
    if header.order:
        source, place = Binary(data, header.order), header.start
    else:
        body = data[header.start :].rstrip(b"\0\x1a")  # old programs fill the last block with these
        body = with_nan(body)
        values = numbers(body)
        if values is None:
            raise wrong_word(body, header.line)
        source, place = Text(values), 0
    tables: dict[str, Table] = {}
    for element in header.elements:
        if not element.count or not element.properties:
            continue
        table = Table(source, element, place)
        place = table.end
        if element.name in tables:
            raise MeshError(f"expected one element {element.name}, got two")
        if element.name in _ELEMENTS:
            tables[element.name] = table
    if not header.order and place < source.length:
        # In a text this shows that lines have more numbers than the header says. Bytes may fill a block.
        raise MeshError(
            f"expected {place} numbers, as the header says, got {source.length - place} more"
        )
    return tables


def _columns(table: Table, names: tuple[str, ...]) -> Floats | None:
    """Return some properties side by side, (rows, names), or None if one of them is missing."""
    if not all(table.has(name) for name in names):
        return None
    result = np.empty((table.element.count, len(names)))
    for column, name in enumerate(names):
        result[:, column] = table.numbers(name)
    return result


def _colors(table: Table) -> Floats | None:
    """Return colours (rows, 4) from 0 to 1."""
    for names in _COLORS:
        colors = _columns(table, names[:3])
        if colors is not None:
            alpha = next((name for name in (names[3], "alpha") if table.has(name)), None)
            result = np.ones((len(colors), 4))
            result[:, :3] = _unit(colors, table.type_of(names[0]))
            if alpha is not None:
                result[:, 3] = _unit(table.numbers(alpha), table.type_of(alpha))
            return result
    return None


def _unit(values: Numbers, type_: str) -> Numbers:
    """Turn numbers of a type into 0 to 1; floats stay as they are, unless they mean bytes."""
    if type_.startswith("f"):
        # Arrays of bytes that were written as floats: bright colours are not all whole numbers.
        most = values.max(initial=0)
        return values / 255 if 1 < most <= 255 and (values == np.floor(values)).all() else values
    if type_ in ("u1", "u2"):
        return values / np.iinfo(type_).max
    # Types that no colour needs: programs that write them mean bytes, unless a number is too large for that.
    most = values.max(initial=0)
    return values / (255 if most <= 255 else 65535 if most <= 65535 else np.iinfo(type_).max)


def _faces(table: Table | None, uvs: Floats | None, *, wants_colors: bool) -> Polygons:
    if table is None:
        return Polygons(np.zeros(0, np.int64), np.zeros(0, np.int64))
    values, counts = _index_lists(table)
    faces = Polygons(_whole(values), counts)
    if table.has("texcoord", is_list=True):
        faces.uvs = _texcoords(table, faces, uvs)
    if not wants_colors:
        return faces
    if table.has("color", is_list=True):
        values, lengths = table.items("color")
        for width in (3, 4):
            if (lengths == width * counts).all():
                faces.colors = np.ones((len(faces.corners), 4))
                faces.colors[:, :width] = _unit(values, table.type_of("color")).reshape(-1, width)
                return faces
    colors = _colors(table)
    if colors is not None:
        faces.colors = np.repeat(colors, counts, axis=0)
    return faces


def _index_lists(table: Table) -> tuple[Numbers, Indices]:
    for name in _INDICES:
        if table.has(name, is_list=True):
            return table.items(name)
    names = ", ".join(each.name for each in table.element.properties)
    raise MeshError(f"expected a list vertex_indices of element {table.element.name}, got {names}")


def _whole(values: Numbers) -> Indices:
    if values.dtype.kind == "f":
        wrong = values[~((values == np.floor(values)) & (np.abs(values) < 2.0**53))]
        if len(wrong):
            raise MeshError(f"expected whole numbers of vertices in faces, got {wrong[0]:g}")
    return values.astype(np.int64)


def _texcoords(table: Table, faces: Polygons, uvs: Floats | None) -> Floats:
    """Return the texture coordinates of all corners; a face without any has those of its vertices, or 0."""
    values, lengths = table.items("texcoord")
    full = lengths == 2 * faces.counts
    if not (full | (lengths == 0)).all():
        face = int(np.flatnonzero(~full & (lengths != 0))[0])
        raise MeshError(
            f"face {face}: expected a texcoord of {2 * faces.counts[face]} numbers, got {lengths[face]}"
        )
    result = _of_corners(uvs, faces.corners)
    result[np.repeat(full, faces.counts)] = values.reshape(-1, 2)
    return result


def _of_corners(uvs: Floats | None, corners: Indices) -> Floats:
    if uvs is None:
        return np.zeros((len(corners), 2))
    return uvs[np.clip(corners, 0, len(uvs) - 1)]  # `part` reports vertices that are not there


def _strips(table: Table) -> Indices:
    """Return the triangles (T, 3) of strips, which end where a list ends and where a vertex is -1.

    Every second triangle of a strip is turned. Triangles with a vertex twice only lead from one strip to the next.
    """
    values, lengths = _index_lists(table)
    values = _whole(values)
    values[values == 0xFFFFFFFF] = -1  # -1 as an unsigned number
    breaks = values == -1
    # Where the strip of each place begins.
    begins = np.zeros(len(values), np.int64)
    starts = (np.cumsum(lengths) - lengths)[lengths > 0]
    begins[starts] = starts
    after = np.flatnonzero(breaks[:-1]) + 1
    begins[after] = after
    begins = np.maximum.accumulate(begins)
    first = np.flatnonzero((begins[2:] == begins[:-2]) & ~breaks[2:])
    turned = (first - begins[first]) % 2
    triangles: Indices = values[np.stack([first + turned, first + 1 - turned, first + 2], axis=1)]
    a, b, c = triangles.T
    sound: Indices = triangles[(a != b) & (b != c) & (c != a)]
    return sound


def _joined(faces: Polygons, triangles: Indices, uvs: Floats | None) -> Polygons:
    """Add triangles without values of their own to faces."""
    added = triangles.reshape(-1)
    result = Polygons(
        np.concatenate([faces.corners, added]),
        np.concatenate([faces.counts, np.full(len(triangles), 3)]),
    )
    if faces.uvs is not None:
        result.uvs = np.concatenate([faces.uvs, _of_corners(uvs, added)])
    if faces.colors is not None:
        result.colors = np.concatenate([faces.colors, np.ones((len(added), 4))])
    return result
