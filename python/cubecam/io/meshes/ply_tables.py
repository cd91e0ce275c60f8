"""The rows of a PLY file's elements, text and binary alike: only what a caller wants is read."""

from __future__ import annotations

from array import array
from collections.abc import Callable
from struct import Struct
from struct import error as struct_error
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .ply_header import Element

Numbers = npt.NDArray[Any]
Indices = npt.NDArray[np.int64]


class Source(Protocol):
    """Numbers at places: a place is a byte of a binary file, and a number of a text."""

    length: int

    def size(self, type_: str) -> int:
        """Return how many places a number takes."""

    def grid(self, type_: str, place: int, shape: tuple[int, int], stride: int) -> Numbers:
        """Return rows of numbers; the rows are `stride` places apart, the numbers of a row side by side."""

    def at(self, type_: str, places: Indices) -> Numbers:
        """Return the numbers at some places."""

    def reader(self, type_: str, rows: int) -> Callable[[int], float]:
        """Return a function that reads one whole number, for a loop over some rows."""


class Text:
    """The numbers of a text file."""

    def __init__(self, values: npt.NDArray[np.float64]) -> None:
        self._values = values
        self._list: list[float] | None = None
        self.length = len(values)

    def size(self, type_: str) -> int:
        return 1

    def grid(self, type_: str, place: int, shape: tuple[int, int], stride: int) -> Numbers:
        step = self._values.itemsize
        strides = (stride * step, step)
        grid: Numbers = np.ndarray(shape, np.float64, self._values, place * step, strides)
        return grid

    def at(self, type_: str, places: Indices) -> Numbers:
        found: Numbers = self._values[places]
        return found

    def reader(self, type_: str, rows: int) -> Callable[[int], float]:
        if rows == 1:
            return self._values.__getitem__
        if self._list is None:
            self._list = self._values.tolist()  # much faster in a loop
        return self._list.__getitem__


class Binary:
    """The bytes of a binary file; `order` is "<" or ">"."""

    def __init__(self, data: bytes, order: str) -> None:
        self._data, self._order = data, order
        self.length = len(data)

    def size(self, type_: str) -> int:
        return int(type_[1:])

    def grid(self, type_: str, place: int, shape: tuple[int, int], stride: int) -> Numbers:
        strides = (stride, self.size(type_))
        grid: Numbers = np.ndarray(shape, self._order + type_, self._data, place, strides)
        return grid

    def at(self, type_: str, places: Indices) -> Numbers:
        # Numbers at all places, which overlap.
        shape = (max(self.length - self.size(type_) + 1, 0),)
        overlapping: Numbers = np.ndarray(shape, self._order + type_, self._data, 0, (1,))
        found: Numbers = overlapping[places]
        return found

    def reader(self, type_: str, rows: int) -> Callable[[int], float]:
        if type_ == "u1":
            return self._data.__getitem__
        code = {"i1": "b", "i2": "h", "u2": "H", "i4": "i", "u4": "I"}[type_]
        unpack, data = Struct(self._order + code).unpack_from, self._data
        return lambda place: unpack(data, place)[0]


class Table:
    """The rows of one element, which begin at `start` and end before `end`.

    Rows whose lists have the lengths of those of the first row, and rows without lists, lie in a regular grid. For
    other rows the lengths of all lists are read one after another: only they say where the next list is.
    """

    def __init__(self, source: Source, element: Element, start: int) -> None:
        self.element = element
        self._source, self._start = source, start
        self._places: dict[str, int] = {}
        for place, each in enumerate(element.properties):
            self._places.setdefault(each.name.lower(), place)
        # The columns of `_lengths` for properties that are lists.
        lists = [place for place, each in enumerate(element.properties) if each.count]
        self._lists = {place: column for column, place in enumerate(lists)}
        # What a row takes when all its lists are empty.
        self._fixed = sum(source.size(each.count or each.type) for each in element.properties)
        if element.count * self._fixed > source.length - start:
            raise self._too_short()
        # The lengths (rows, lists) of all lists; one row stands for all in a regular grid.
        self._lengths = self._walked(1) if element.count else np.zeros((1, len(self._lists)), int)
        self._stride = int(self._sizes()[0])
        self._starts: Indices | None = None
        self.end = start + element.count * self._stride
        if self._lists and element.count > 1 and not self._is_regular():
            self._lengths = self._walked(element.count)
            ends = start + np.cumsum(self._sizes())
            self._starts = np.concatenate([[start], ends[:-1]])
            self.end = int(ends[-1])
        if self.end > source.length:
            raise self._too_short()

    def has(self, name: str, *, is_list: bool = False) -> bool:
        place = self._places.get(name)
        return place is not None and (place in self._lists) == is_list

    def type_of(self, name: str) -> str:
        return self.element.properties[self._places[name]].type

    def numbers(self, name: str) -> Numbers:
        """Return a property that is no list, (rows,)."""
        place = self._places[name]
        type_ = self.element.properties[place].type
        if self._starts is None:
            start = self._start + int(self._offsets(place)[0])
            return self._source.grid(type_, start, (self.element.count, 1), self._stride)[:, 0]
        return self._source.at(type_, self._starts + self._offsets(place))

    def items(self, name: str) -> tuple[Numbers, Indices]:
        """Return the items of all lists of a property one after another, and the length of each list (rows,)."""
        place = self._places[name]
        each = self.element.properties[place]
        offsets = self._offsets(place) + self._source.size(each.count or each.type)
        lengths = self._lengths[:, self._lists[place]]
        if self._starts is None:
            shape = (self.element.count, int(lengths[0]))
            grid = self._source.grid(each.type, self._start + int(offsets[0]), shape, self._stride)
            return grid.reshape(-1), np.full(self.element.count, lengths[0])
        size = self._source.size(each.type)
        before = np.cumsum(lengths) - lengths
        starts = np.repeat(self._starts + offsets - before * size, lengths)
        return self._source.at(each.type, starts + size * np.arange(len(starts))), lengths

    def _offsets(self, place: int) -> Indices:
        """Return where a property begins in each row, (rows,), or (1,) in a regular grid."""
        offsets = np.zeros(len(self._lengths), np.int64)
        for before, each in enumerate(self.element.properties[:place]):
            offsets += self._source.size(each.count or each.type)
            if each.count:
                lengths = self._lengths[:, self._lists[before]]
                offsets += lengths * self._source.size(each.type)
        return offsets

    def _sizes(self) -> Indices:
        """Return how many places each row takes."""
        return self._offsets(len(self.element.properties))

    def _is_regular(self) -> bool:
        if self.end > self._source.length:
            return False
        place, column = self._start, 0
        for each in self.element.properties:
            if not each.count:
                place += self._source.size(each.type)
                continue
            length = int(self._lengths[0, column])
            shape = (self.element.count, 1)
            if (self._source.grid(each.count, place, shape, self._stride) != length).any():
                return False
            place += self._source.size(each.count) + length * self._source.size(each.type)
            column += 1
        return True

    def _walked(self, rows: int) -> Indices:
        """Read the lengths (rows, lists) of the lists of the first rows."""
        steps: list[tuple[int, Callable[[int], float], int, int]] = []
        gap = 0
        for each in self.element.properties:
            if each.count:
                size, item = self._source.size(each.count), self._source.size(each.type)
                steps.append((gap, self._source.reader(each.count, rows), size, item))
                gap = 0
            else:
                gap += self._source.size(each.type)
        found = array("q")
        place = self._start
        try:
            for _ in range(rows):
                for before, read, size, item in steps:
                    place += before
                    length = int(read(place))
                    if length < 0 or length != read(place):
                        raise MeshError(
                            f"element {self.element.name}, row {len(found) // len(steps)}: "
                            f"expected the length of a list, got {read(place):g}"
                        )
                    found.append(length)
                    place += size + length * item
                place += gap
        except (IndexError, OverflowError, ValueError, struct_error):
            raise self._too_short() from None
        if place > self._source.length:
            raise self._too_short()
        return np.frombuffer(found, np.int64).reshape(rows, len(steps))

    def _too_short(self) -> MeshError:
        return MeshError(
            f"expected {self.element.count} rows of element {self.element.name}, got the end of the file before"
        )
