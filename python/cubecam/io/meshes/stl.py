"""STL files, binary and text.

The binary form is 80 bytes of any text, a 32-bit number of triangles, and 50 bytes for each triangle: normal and three
corners as 32-bit floats, and 16 bits which some programs use for colours; all little-endian. Normals are not read:
corners at one place are merged, and the mesh computes smooth normals.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .parts import Part, unique_positions
from .plain_text import narrow, numbers, shown, unified
from .wedges import split

if TYPE_CHECKING:
    from pathlib import Path

_RECORD = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attribute", "<u2")])
_HEADER = 84
_VERTEX = re.compile(rb"\bvertex\s+(?=[-+.\d])", re.IGNORECASE)
_LOOP = re.compile(
    rb"\bouter\s+loop((?:\s+vertex\s+\S+\s+\S+\s+\S+){3})\s+endloop\b", re.IGNORECASE
)
_FIRST_FACET = re.compile(rb"\n\s*facet\b[^\n]*\s+outer\s+loop\s+vertex\s", re.IGNORECASE)


def read(path: Path, data: bytes) -> list[Part]:
    """Read an STL file; equal positions are merged, except between triangles of different colours."""
    colors = None
    data = narrow(data)
    if _is_text(data):
        positions = _text_corners(unified(data).rstrip(b"\0\x1a"))
    else:
        records = _records(data)
        positions = records["corners"].astype(np.float64)
        colors = _colors(data[:80], records["attribute"])
    if not len(positions):
        raise MeshError("expected triangles, got none")
    places = positions.reshape(-1, 3)
    unique, index = unique_positions(places)
    if colors is None:
        return [Part(unique, index.reshape(-1, 3), None, None, None)]
    sources, index, colors = split(len(unique), index, np.repeat(colors, 3, axis=0))
    return [Part(unique[sources], index.reshape(-1, 3), None, None, colors)]


def _is_text(data: bytes) -> bool:
    """Tell the two forms apart by what is there: many programs begin binary files with "solid"."""
    if len(data) >= _HEADER and len(data) == _HEADER + _RECORD.itemsize * _count(data):
        return False
    # Text has no control characters except white space; a binary file has some in its first triangle or in the number
    # of triangles, whose highest byte is 0 below 16 million. Names may hold some, and old programs fill the last block.
    head = data[:512].rstrip(b"\0\x1a")
    if re.match(rb"\s*solid", head, re.IGNORECASE):
        head = head.partition(b"\n")[2] if _FIRST_FACET.search(data[:4096]) else head
    if any(byte < 9 or 13 < byte < 32 for byte in head):
        return False
    start = data[:512].lower().removeprefix(b"\xef\xbb\xbf").lstrip()
    return start.startswith(b"solid") or b"facet" in start


def _count(data: bytes) -> int:
    return int.from_bytes(data[80:_HEADER], "little")


def _records(data: bytes) -> npt.NDArray[np.void]:
    if len(data) < _HEADER:
        raise MeshError(
            f"expected an STL file: text that begins with solid, or {_HEADER} bytes and more; got {len(data)} bytes"
        )
    count, (there, rest) = _count(data), divmod(len(data) - _HEADER, _RECORD.itemsize)
    # A program that writes while it computes does not know the number at the start, and leaves 0 or the largest one.
    # Whole records to the end of the file show that nothing is missing.
    if count in (0, 0xFFFFFFFF) and not rest:
        count = there
    if count > there:
        raise MeshError(
            f"expected {count} triangles of {_RECORD.itemsize} bytes, as the header says; got bytes for {there}"
        )
    return np.frombuffer(data, _RECORD, count, _HEADER)


def _colors(header: bytes, attribute: npt.NDArray[np.uint16]) -> npt.NDArray[np.float64] | None:
    """Return the colours (T, 4) of the triangles in one of two usual forms, or None.

    Magics writes "COLOR=" and RGBA in the header, and a triangle's own colour where bit 15 is 0, with red in the lowest
    bits. VisCAM and SolidView set bit 15 where a triangle has a colour, with blue in the lowest bits.
    """
    bits = np.stack([attribute, attribute >> 5, attribute >> 10], axis=1) & 31
    marked = attribute >= 0x8000
    colors = np.ones((len(attribute), 4))
    place = header.find(b"COLOR=")
    if 0 <= place <= 80 - 10:
        colors[:] = np.frombuffer(header, np.uint8, 4, place + 6) / 255
        if attribute.any():  # all 0 is what programs leave that know no colours of triangles
            colors[~marked, :3] = bits[~marked] / 31
        return colors
    # Other numbers than these two mean something else.
    if not marked.any() or (attribute[~marked] != 0).any():
        return None
    colors[marked, :3] = bits[marked, ::-1] / 31
    return colors


def _text_corners(text: bytes) -> npt.NDArray[np.float64]:
    """Return the corners (T, 3, 3) of the triangles of all solids."""
    corners = _usual_corners(_without_names(text.lower() + b"\n"))
    if corners is not None:
        return corners
    try:
        corners = _corners_by_line(text)
    except MeshError:
        if (corners := _corners_by_word(text)) is None:
            raise
    return corners if len(corners) or (other := _corners_by_word(text)) is None else other


def _usual_corners(text: bytes) -> npt.NDArray[np.float64] | None:
    """Read lower-case text of "outer loop", three times "vertex x y z" and "endloop" without a loop over the lines.

    Whatever else a facet has is skipped. None if the text differs from that.
    """
    letters = np.frombuffer(text, np.uint8)
    # The only words with a "v" and with a "p" are "vertex", "loop" and "endloop".
    vertices = np.flatnonzero(letters == ord("v"))
    loops = np.flatnonzero(letters == ord("p"))
    if not len(vertices) or len(vertices) % 3 or 3 * len(loops) != 2 * len(vertices):
        return None
    if (loops[::2] > vertices[::3]).any() or (vertices[2::3] > loops[1::2]).any():
        return None
    if vertices[-1] + 6 >= len(letters):
        return None
    if any((letters[vertices + i] != letter).any() for i, letter in enumerate(b"vertex")):
        return None
    # Keep the lines of vertices, with a number in place of the word, so that each vertex is seen to have three numbers.
    ends = np.flatnonzero(letters == ord("\n"))
    ends = ends[np.searchsorted(ends, vertices)] + 1
    if (ends[1:] == ends[:-1]).any():
        return None
    changes = np.zeros(len(letters) + 1, np.int8)
    changes[vertices] = 1
    changes[ends] -= 1
    letters = letters.copy()
    for i, letter in enumerate(b" -inf "):
        letters[vertices + i] = letter
    values = numbers(letters[np.cumsum(changes[:-1], dtype=np.int8).view(bool)].tobytes())
    if values is None or len(values) != 4 * len(vertices):
        return None
    rows = values.reshape(-1, 4)
    return rows[:, 1:].reshape(-1, 3, 3) if np.isneginf(rows[:, 0]).all() else None


def _without_names(text: bytes) -> bytes:
    """Blank the lines that begin and end a solid: names may hold any word."""
    kept, done, place = [], 0, 0
    while (place := text.find(b"solid", place)) >= 0:
        start = text.rfind(b"\n", done, place) + 1 or done
        end = text.find(b"\n", place)
        end = len(text) if end < 0 else end
        if text[start:place].strip() in (b"", b"end"):
            kept.append(text[done:start])
            done = end
        place = end
    kept.append(text[done:])
    return b"".join(kept)


def _corners_by_line(text: bytes) -> npt.NDArray[np.float64]:
    """Read a text that differs from the usual one, for example by broken normals or by more words."""
    corners: list[list[float]] = []
    inside = 0
    for number, line in enumerate(text.split(b"\n"), 1):
        words = line.split()
        word = words[0].lower() if words else b""
        if word == b"vertex":
            inside += 1
            try:
                x, y, z = map(float, words[1:])
            except ValueError:
                raise MeshError(
                    f"line {number}: expected vertex and three numbers, got {shown(line.strip())}"
                ) from None
            corners.append([x, y, z])
        elif word in (b"facet", b"endfacet", b"endloop", b"endsolid"):
            _check_facet(number, inside)
            inside = 0
    _check_facet(text.count(b"\n") + 1, inside)
    return np.array(corners, dtype=np.float64).reshape(-1, 3, 3)


def _corners_by_word(text: bytes) -> npt.NDArray[np.float64] | None:
    """Read a text whose lines end anywhere; None if it has anything but three vertices in a loop."""
    loops = _LOOP.findall(text)
    if not loops or len(_VERTEX.findall(text)) != 3 * len(loops):
        return None
    values = numbers(_VERTEX.sub(b" ", b" ".join(loops)))
    return (
        values.reshape(-1, 3, 3) if values is not None and len(values) == 9 * len(loops) else None
    )


def _check_facet(line: int, vertices: int) -> None:
    if vertices not in (0, 3):
        raise MeshError(f"line {line}: expected three vertices in a facet, got {vertices}")
