"""Numbers from mesh files that are text, read at once for the whole file."""

from __future__ import annotations

import re

import numpy as np
import numpy.typing as npt

from ..._core import MeshError

# The end of what `numbers` reads. No exporter writes this number.
_END = -7.4835072e-301


def narrow(data: bytes) -> bytes:
    """Turn UTF-16, which PowerShell writes, into UTF-8; other bytes stay as they are."""
    if data[:2] in (b"\xff\xfe", b"\xfe\xff") and data[2:4].count(0) == 1:
        return data.decode("utf-16", "replace").encode("utf-8", "replace")
    return data


def unified(data: bytes) -> bytes:
    """Drop a byte order mark, and end all lines with a line feed; old exporters write carriage returns."""
    data = data.removeprefix(b"\xef\xbb\xbf")
    if b"\r" in data:
        data = data.replace(b"\r\n", b"\n").replace(b"\r", b"\n")
    return data


def with_nan(text: bytes) -> bytes:
    """Write nan for what older programs on Windows print, such as -1.#IND; all places stay as they are."""
    if b".#" not in text:
        return text
    return re.sub(rb"1\.#(?:IND|INF|QNAN|SNAN)\w*", lambda m: b"nan".ljust(len(m.group())), text)


def numbers(text: bytes) -> npt.NDArray[np.float64] | None:
    """Read numbers between white space; None if the text holds anything else."""
    try:
        # Until numpy 2.3 text that is no number ends the array, with a DeprecationWarning; hence the mark at the end.
        values = np.fromstring(text + b" %r" % _END, sep=" ")
    except (ValueError, DeprecationWarning):
        return None
    return values[:-1] if len(values) and values[-1] == _END else None


def wrong_word(text: bytes, first_line: int) -> MeshError:
    """Name the first word of a text that is no number; `first_line` is the number of the text's first line."""
    for number, line in enumerate(text.split(b"\n"), first_line):
        for word in line.split():
            if numbers(word) is None:
                return MeshError(f"line {number}: expected numbers, got {shown(word)}")
    return MeshError(f"expected numbers from line {first_line} on, got something else")


def shown(text: bytes) -> str:
    """Quote some text of a file for an error."""
    quoted = repr(text[:40].decode("utf-8", "replace"))
    return quoted if len(text) <= 40 else f"{quoted}..."


def words_of_lines(text: bytes) -> npt.NDArray[np.int64]:
    """Count the words of each line that has any."""
    letters = np.frombuffer(text, np.uint8)
    filled = letters > ord(" ")
    starts = filled.copy()
    starts[1:] &= ~filled[:-1]
    before = np.flatnonzero(starts)
    ends = np.flatnonzero(letters == ord("\n"))
    counts = np.diff(np.searchsorted(before, ends), prepend=0, append=len(before))
    return counts[counts > 0]
