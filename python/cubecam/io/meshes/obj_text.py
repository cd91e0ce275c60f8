"""The text of a Wavefront OBJ file: its encoding, comments and continuation lines, and the numbers of its lines."""

from __future__ import annotations

import contextlib
import re

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .plain_text import unified, with_nan

Floats = npt.NDArray[np.float64]
Indices = npt.NDArray[np.int64]

# Kinds of lines.
OTHER, POSITION, TEXTURE, NORMAL, FACE = range(5)

_NEWLINE, _BLANK, _SLASH = 10, 32, 47
# Tabs, vertical tabs, zero bytes and the like are blanks.
_BLANKS = bytes(_BLANK if code < _BLANK and code != _NEWLINE else code for code in range(256))
_JOINED = b"\x0b"  # stands for the line end after a backslash, so that lines can be counted
_NUMBER = re.compile(rb"[+-]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|nan|inf)\Z", re.ASCII)
_CORNER = re.compile(rb"[+-]?\d+(?:/(?:[+-]?\d+)?){0,2}\Z", re.ASCII)


def readable(data: bytes) -> bytes:
    """Turn a file into UTF-8 with `\\n` at the end of each line, and blanks for all other white space."""
    text = unified(_utf8(data))
    if not text.isascii():
        # No-break spaces come in with text that was copied from a page, byte order marks with files that were joined.
        text = text.replace(b"\xc2\xa0", b" ").replace(b"\xef\xbb\xbf", b" ")
    return text.translate(_BLANKS)


def _utf8(data: bytes) -> bytes:
    encoding = ""
    if data.startswith((b"\xff\xfe", b"\xfe\xff")):
        encoding = "utf-16"
    elif b"\0" in data[:400]:
        # Without a byte order mark: every second byte of most text is 0.
        head = data[:400]
        low, high = head[1::2].count(0), head[::2].count(0)
        if max(low, high) * 4 > len(head) and min(low, high) * 8 < max(low, high):
            encoding = "utf-16-le" if low > high else "utf-16-be"
    if encoding:
        return data.decode(encoding, "replace").encode("utf-8", "replace")
    if data.isascii():
        return data
    try:
        data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("latin-1").encode("utf-8")  # names and comments of older exporters
    return data


def _without_comments(text: bytes) -> bytes:
    """Put blanks from the first `#` of a line to its end. The text ends with a line end."""
    data: npt.NDArray[np.uint8] = np.frombuffer(text, dtype=np.uint8).copy()
    ends = np.flatnonzero(data == _NEWLINE)
    begins = np.flatnonzero(data == ord("#"))
    if not len(begins):  # each one was part of a number
        return text
    stops = ends[np.searchsorted(ends, begins)]
    marks = np.zeros(len(data), dtype=np.int8)
    marks[begins[np.concatenate([[True], stops[1:] != stops[:-1]])]] = 1
    marks[stops] = -1
    data[np.cumsum(marks, dtype=np.int8).astype(bool)] = _BLANK
    return data.tobytes()


def _joined(match: re.Match[bytes]) -> bytes:
    return b" " * (len(match.group()) - 1) + _JOINED


class Lines:
    """The lines of an OBJ file, sorted by kind, with their numbers.

    `kinds` has the kind of each line that is not blank. A line that continues others is one line.
    """

    def __init__(self, text: bytes) -> None:
        self.text = b"\n" + text + b"\n"
        clean = self.text
        # Positions in the text stay what they are: what goes becomes blanks.
        if b"#" in clean:
            if b".#" in clean:  # 1.#IND and 1.#QNAN are no comments: Windows prints NaN so
                clean = with_nan(clean)
            clean = _without_comments(clean)
        if b"\\" in clean:
            clean = re.sub(rb"\\ *\n", _joined, clean)
        self._clean = clean = clean + b"\n\n\n"
        data = np.frombuffer(clean, dtype=np.uint8)
        ends = np.flatnonzero(data == _NEWLINE)
        white = data <= _BLANK
        words = np.flatnonzero(white[:-1] & ~white[1:]) + 1
        bounds = np.searchsorted(words, ends)
        counts = np.diff(bounds)
        filled = np.flatnonzero(counts)
        heads = words[bounds[filled]]
        first, second, third = data[heads], data[heads + 1], data[heads + 2]
        kinds = np.zeros(len(filled), dtype=np.uint8)
        v, f = first == ord("v"), first == ord("f")
        one, two = second <= _BLANK, third <= _BLANK
        kinds[v & one] = POSITION
        kinds[v & two & (second == ord("t"))] = TEXTURE
        kinds[v & two & (second == ord("n"))] = NORMAL
        kinds[f & (one | two & (second == ord("o")))] = FACE  # fo: faces of old files
        self.kinds = kinds
        # How many words follow the first one.
        self.counts: Indices = counts[filled] - 1
        self._starts, self._stops = ends[filled] + 1, ends[filled + 1]
        self._heads = heads
        self._filled = filled

    def of(self, kind: int) -> Indices:
        """Return the lines of a kind, as indices of `kinds`."""
        return np.flatnonzero(self.kinds == kind)

    def number(self, line: int) -> int:
        """Return the number of a line in the file, from 1."""
        before = self._clean[: self._starts[line]]
        return before.count(b"\n") + before.count(_JOINED)

    def error(self, line: int, message: str) -> MeshError:
        return MeshError(f"line {self.number(int(line))}: {message}")

    def words(self, line: int) -> list[bytes]:
        """Return the words of a line after its first one."""
        return self._clean[self._starts[line] : self._stops[line]].split()[1:]

    def named(self) -> list[tuple[int, str, str]]:
        """Return line, first word and the rest, for each line that gives a name.

        A name may hold a `#`: a comment starts at one after a blank.
        """
        found = []
        data = np.frombuffer(self._clean, dtype=np.uint8)
        candidates = (self.kinds == OTHER) & np.isin(
            data[self._heads], np.frombuffer(b"gosum", dtype=np.uint8)
        )
        for line in np.flatnonzero(candidates).tolist():
            text = self.text[self._starts[line] : self._stops[line]].decode("utf-8", "replace")
            text = re.sub(r"\\ *\n", " ", text)
            word, _, rest = text.strip(" \n").partition(" ")
            if word in ("g", "o", "s", "usemtl", "mtllib"):
                found.append((line, word, (" " + rest).partition(" #")[0].strip()))
        return found

    def bytes_of(self, kind: int) -> bytes:
        """Return all lines of a kind, with blanks for their first words."""
        lines = self.of(kind)
        if not len(lines):
            return b""
        data: npt.NDArray[np.uint8] = np.frombuffer(self._clean, dtype=np.uint8).copy()
        heads = self._heads[lines]
        data[heads] = _BLANK
        after = data[heads + 1]
        data[heads + 1] = np.where(after > _BLANK, _BLANK, after)
        low, high = int(self._starts[lines[0]]), int(self._stops[lines[-1]])
        marks = np.zeros(high - low + 1, dtype=np.int8)
        marks[self._starts[lines] - low] = 1
        marks[self._stops[lines] - low] -= 1
        inside = np.cumsum(marks, dtype=np.int8).astype(bool)
        inside[self._stops[lines] - low] = True  # the line ends, so that words stay apart
        chosen: npt.NDArray[np.uint8] = data[low : high + 1][inside]
        return chosen.tobytes()

    def floats(self, kind: int) -> Floats:
        """Return all numbers of the lines of a kind."""
        lines = self.of(kind)
        expected = int(self.counts[lines].sum())
        if not expected:
            return np.zeros(0)
        try:
            values = np.fromstring(self.bytes_of(kind), sep=" ")
        except (ValueError, DeprecationWarning):  # numpy before 2.3 warns
            values = np.zeros(0)
        if len(values) != expected:
            raise self._bad_word(lines, _NUMBER, "a number")
        return values

    def _bad_word(self, lines: Indices, good: re.Pattern[bytes], what: str) -> MeshError:
        for line in lines.tolist():
            for word in self.words(line):
                if not good.match(word):
                    got = word[:40].decode("utf-8", "replace")
                    return self.error(line, f"expected {what}, got {got!r}")
        return self.error(int(lines[0]), f"expected {what} in each place from here")

    def _bad_corner(self, lines: Indices) -> MeshError:
        return self._bad_word(lines, _CORNER, "corners like 1, 1/2, 1//3 or 1/2/3")

    def indices(self) -> list[Indices | None]:
        """Return positions, texture coordinates and normals of all corners of faces, as in the file; 0 for none."""
        lines = self.of(FACE)
        corners = int(self.counts[lines].sum())
        if not corners:
            return [np.zeros(0, dtype=np.int64), None, None]
        text = self.bytes_of(FACE)
        data = np.frombuffer(text, dtype=np.uint8)
        slash = data == _SLASH
        apart = slash | (data <= _BLANK)
        plain = text.replace(b"/", b" ")
        begins = np.flatnonzero(~apart & np.concatenate([[True], apart[:-1]]))
        signed = (data[1:] == ord("-")) | (data[1:] == ord("+"))
        values = np.zeros(0, dtype=np.int64)
        if not (signed & ~apart[:-1]).any():
            with contextlib.suppress(ValueError, DeprecationWarning):
                values = np.fromstring(plain, dtype=np.int64, sep=" ")
        if not len(begins) or len(values) != len(begins):
            raise self._bad_corner(lines)
        if not values.all():
            at = int(np.flatnonzero(values == 0)[0])
            line = lines[int(np.count_nonzero(data[: begins[at]] == _NEWLINE))]
            raise self.error(line, "expected indices from 1, or negative ones, got 0")
        if not slash.any():
            return [values, None, None]
        return self._columns(lines, corners, data, slash, begins, values)

    def _columns(
        self,
        lines: Indices,
        corners: int,
        data: npt.NDArray[np.uint8],
        slash: npt.NDArray[np.bool_],
        begins: Indices,
        values: Indices,
    ) -> list[Indices | None]:
        """Sort indices into the three columns."""
        white = data <= _BLANK
        words = np.flatnonzero(~white & np.concatenate([[True], white[:-1]]))
        word = np.searchsorted(words, begins, side="right") - 1
        slashes = np.flatnonzero(slash)
        places = np.searchsorted(slashes, begins) - np.searchsorted(slashes, words)[word]
        result: list[Indices | None] = [None, None, None]
        for place in range(3):
            chosen = places == place
            if chosen.any():
                column = np.zeros(corners, dtype=np.int64)
                column[word[chosen]] = values[chosen]
                result[place] = column
        first = result[0]
        if first is None or not first.all() or places.max() > 2:
            raise self._bad_corner(lines)
        return result
