"""OFF files of Geomview, text and binary.

Geomview's manual, "OFF Files", describes the format. A word such as OFF, COFF or STCNOFF says what stands after the
three coordinates of a vertex: N a normal, C a colour, ST texture coordinates, in the order N, C, ST. A face is the
number of its corners, their vertices from 0, and perhaps a colour up to the end of the line.
"""

from __future__ import annotations

import re
from array import array
from bisect import bisect_left
from typing import TYPE_CHECKING

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .parts import Part
from .plain_text import narrow, numbers, shown, unified, words_of_lines, wrong_word
from .wedges import Polygons, part

if TYPE_CHECKING:
    from pathlib import Path

_WORD = re.compile(rb"\s*((?:ST|C|N|4|n)*OFF|(?:st|c)*off)(?=\s|$)")
_BINARY = re.compile(rb"[ \t]+BINARY[ \t]*\r?\n")
# Two numbers, and a third one that is on the same line or alone on the next line.
_COUNTS = re.compile(rb"\s*(\S+)\s+(\S+)(?:[ \t]+\S+|[ \t]*\n[ \t]*\S+[ \t]*(?=\n))?")


def read(path: Path, data: bytes) -> list[Part]:
    """Read an OFF file. Colours of faces are read if vertices have none."""
    data = narrow(data).removeprefix(b"\xef\xbb\xbf")
    word = _WORD.match(data[:200])
    start = _BINARY.match(data, word.end()) if word else None
    if word and start:
        marks = _marks(word[1])
        vertices, faces, shades = _binary(data, start.end(), marks)
    else:
        marks, vertices, faces, shades = _text(unified(data))
    normals, colors, uvs = _columns(vertices, marks)
    if colors is None and shades is not None:
        faces.colors = np.repeat(shades, faces.counts, axis=0)
    return [part(vertices[:, :3], faces, normals=normals, uvs=uvs, colors=colors)]


def _marks(word: bytes) -> bytes:
    """Return the capital letters before OFF."""
    if b"4" in word or b"n" in word:
        raise MeshError(
            f"expected vertices of three coordinates, got {word.decode()} (4: four, n: any number of coordinates)"
        )
    return word.upper()[:-3]


def _widths(marks: bytes, color: int) -> int:
    return 3 + 3 * (b"N" in marks) + color * (b"C" in marks) + 2 * (b"ST" in marks)


def _columns(
    vertices: npt.NDArray[np.float64], marks: bytes
) -> tuple[npt.NDArray[np.float64] | None, ...]:
    """Return the normals, colours and texture coordinates of the vertices."""
    rest = vertices[:, 3:]
    if not marks and rest.shape[1] in (3, 4) and (rest >= 0).all():
        return None, _unit(rest), None  # MeshLab and others write colours without the C
    normals = colors = uvs = None
    if b"N" in marks:
        normals, rest = rest[:, :3], rest[:, 3:]
    if b"ST" in marks:
        # The colour before has three or four numbers.
        place = min(rest.shape[1] - 2, 4) if b"C" in marks else 0
        rest, uvs = rest[:, :place], rest[:, place : place + 2]
    if b"C" in marks:
        colors = _unit(rest[:, :4])
    return normals, colors, uvs


def _unit(values: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    """Turn colours (N, 3) or (N, 4) into RGBA: whole numbers are 0 to 255, others 0 to 1.

    The numbers 0 and 1 may be either. They are taken as the other colours of the file are, if these agree.
    """
    broken = (values != np.floor(values)).any(axis=1)
    whole = np.asarray((values > 1).any(axis=1))
    if not (broken & ~whole).any() and whole.any():
        whole = np.ones_like(whole)
    colors = np.ones((len(values), 4))
    colors[:, : values.shape[1]] = values / np.where(whole, 255, 1)[:, None]
    return colors


def _text(
    text: bytes,
) -> tuple[bytes, npt.NDArray[np.float64], Polygons, npt.NDArray[np.float64] | None]:
    if b"#" in text:
        text = re.sub(rb"#[^\n]*", b"", text)
    word = _WORD.match(text)
    marks = _marks(word[1]) if word else b""
    counts = _COUNTS.match(text, word.end() if word else 0)
    if not counts or not (counts[1].isdigit() and counts[2].isdigit()):
        got = shown(text[word.end() if word else 0 :].strip().split(b"\n", 1)[0])
        raise MeshError(f"expected OFF and the numbers of vertices and faces, got {got}")
    body = text[counts.end() :]
    values = numbers(body)
    if values is None:
        raise wrong_word(body, 1 + text.count(b"\n", 0, counts.end()))
    lines = words_of_lines(body)
    count = _whole(counts[1], len(values), "vertices")
    width = _widths(marks, 4)
    # The numbers of a line show whether colours have three or four numbers, and what is there beyond the word.
    if (
        0 < count <= len(lines)
        and (lines[:count] == lines[0]).all()
        and lines[0] >= _widths(marks, 3)
    ):
        width = int(lines[0])
    if count * width > len(values):
        raise MeshError(f"expected {count} vertices of {width} numbers, got {len(values)} numbers")
    ends = np.cumsum(lines) - count * width
    faces, shades = _faces(
        values[count * width :], ends[ends > 0], _whole(counts[2], len(values), "faces")
    )
    return marks, values[: count * width].reshape(count, width), faces, shades


def _whole(word: bytes, most: int, what: str) -> int:
    if len(word) > 18 or int(word) > most:
        raise MeshError(f"expected {word[:20].decode()} {what}, got {most} numbers for all")
    return int(word)


def _faces(
    values: npt.NDArray[np.float64], ends: npt.NDArray[np.int64], count: int
) -> tuple[Polygons, npt.NDArray[np.float64] | None]:
    """Read faces from their numbers; `ends` (L,) says where the lines of the file end."""
    if len(ends) == count and count:
        starts = np.concatenate([[0], ends[:-1]])
        corners = values[starts]
        rest = ends - starts - 1 - corners
        if (corners >= 0).all() and np.isin(rest, (0, 1, 2, 3, 4)).all():
            return _gathered(values, starts, corners.astype(np.int64), rest.astype(np.int64))
    try:
        return _gathered(values, *_walk(values.tolist(), ends.tolist(), count, colors=True))
    except MeshError:
        # Several faces on a line: the numbers after a face are not a colour, but the next face.
        try:
            return _gathered(values, *_walk(values.tolist(), ends.tolist(), count, colors=False))
        except MeshError:
            pass
        raise


def _walk(
    values: list[float], ends: list[int], count: int, *, colors: bool
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    """Find where faces begin, how many corners and how many numbers of a colour each has."""
    rows = array("q")
    place = 0
    for face in range(count):
        corners = values[place] if place < len(values) else -1
        if not (0 <= corners <= len(values) - place - 1 and corners == int(corners)):
            raise _wrong_face(face, values[place:])
        end = place + 1 + int(corners)
        rest = ends[bisect_left(ends, end)] - end if colors else 0
        if rest > 4:
            rest = 0
        rows.extend((place, int(corners), rest))
        place = end + rest
    if place < len(values):
        raise MeshError(
            f"expected the end of the file after {count} faces, got {len(values) - place} more numbers"
        )
    starts, sizes, rests = np.frombuffer(rows, np.int64).reshape(-1, 3).T
    return starts, sizes, rests


def _wrong_face(face: int, values: list[float]) -> MeshError:
    got = f"{values[0]:g} and {len(values) - 1} numbers" if values else "the end of the file"
    return MeshError(f"face {face}: expected a number of corners and their vertices, got {got}")


def _gathered(
    values: npt.NDArray[np.float64],
    starts: npt.NDArray[np.int64],
    counts: npt.NDArray[np.int64],
    rests: npt.NDArray[np.int64],
) -> tuple[Polygons, npt.NDArray[np.float64] | None]:
    """Take the vertices of faces, and the colours (F, 4) if any face has one."""
    ends = np.cumsum(counts)
    places = np.repeat(starts + 1 - ends + counts, counts) + np.arange(ends[-1] if len(ends) else 0)
    with np.errstate(invalid="ignore"):
        corners = values[places].astype(np.int64)
    if (corners != values[places]).any():
        wrong = values[places][corners != values[places]][0]
        raise MeshError(f"expected whole numbers of vertices in faces, got {wrong:g}")
    if not (rests >= 3).any():
        return Polygons(
            corners, counts
        ), None  # one number is the index of a colour in a table of Geomview
    # Geomview leaves open which colour the other faces have: white leaves them as they are.
    colors = np.ones((len(counts), 4))
    for width in (3, 4):
        rows = np.flatnonzero(rests == width)
        colors[rows, :width] = values[(starts + 1 + counts)[rows, None] + np.arange(width)]
    colored = rests >= 3
    colors[colored] = _unit(colors[colored])
    colors[rests == 3, 3] = 1
    return Polygons(corners, counts), colors


def _binary(
    data: bytes, start: int, marks: bytes
) -> tuple[npt.NDArray[np.float64], Polygons, npt.NDArray[np.float64] | None]:
    """Read a file of big-endian 32-bit integers and floats; a face has the number of its colour's numbers, too."""
    words = np.frombuffer(data, ">i4", (len(data) - start) // 4, start)
    if len(words) < 3:
        raise MeshError(f"expected three numbers after OFF BINARY, got {len(words)}")
    vertices, faces = int(words[0]), int(words[1])
    width = _widths(marks, 4)
    if min(vertices, faces) < 0 or vertices * width + 2 * faces > len(words) - 3:
        raise MeshError(
            f"expected {vertices} vertices of {width} numbers and {faces} faces, got {len(words) - 3} numbers"
        )
    end = 3 + vertices * width
    table = words[3:end].view(">f4").reshape(vertices, width).astype(np.float64)
    words = words[end:]
    starts, counts, rests = _binary_faces(words, faces)
    # Indices as numbers, colours as the floats that they are.
    values = words.astype(np.float64)
    color = np.repeat(starts + 2 + counts - np.cumsum(rests) + rests, rests) + np.arange(
        rests.sum()
    )
    values[color - 1] = words[color].view(">f4")
    return table, *_gathered(values, starts, counts, rests)


def _binary_faces(
    words: npt.NDArray[np.int32], count: int
) -> tuple[npt.NDArray[np.int64], npt.NDArray[np.int64], npt.NDArray[np.int64]]:
    rows = array("q")
    place, values = 0, words.tolist()
    for face in range(count):
        corners = values[place] if place < len(values) else -1
        end = place + 1 + corners
        if corners < 0 or end >= len(values) or not 0 <= values[end] <= len(values) - end - 1:
            raise _wrong_face(face, values[place:])
        if values[end] > 4:
            raise MeshError(f"face {face}: expected a colour of 0 to 4 numbers, got {values[end]}")
        rows.extend((place, corners, values[end]))
        place = end + 1 + values[end]
    starts, counts, rests = np.frombuffer(rows, np.int64).reshape(-1, 3).T
    return starts, counts, rests
