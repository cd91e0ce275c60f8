"""Numbers of materials and lights: those out of their range are clamped, and noted."""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager

from ...._core import MeshError
from ...left_out import LeftOut
from ..entries import Entry

INFINITE = math.inf


class Values:
    """Reads the numbers of one JSON object. The object may be missing; then all numbers are their defaults."""

    def __init__(self, entry: Entry | None, left_out: LeftOut) -> None:
        self.entry = entry
        self._left_out = left_out

    def number(
        self, key: str, default: float, low: float = -INFINITE, high: float = INFINITE
    ) -> float:
        if self.entry is None or key not in self.entry:
            return default
        value = self.entry.raw[key]
        sound = isinstance(value, (int, float)) and not isinstance(value, bool)
        try:
            if not sound or not math.isfinite(value):
                raise self.entry.error(key, "a finite number")
        except OverflowError:  # an integer that is too big for a float
            raise self.entry.error(key, "a finite number") from None
        return self._clamped(key, float(value), low, high)

    def numbers(
        self, key: str, default: tuple[float, ...], low: float = -INFINITE, high: float = INFINITE
    ) -> tuple[float, ...]:
        values = None if self.entry is None else self.entry.numbers(key, len(default))
        if values is None:
            return default
        return tuple(self._clamped(key, value, low, high) for value in values)

    def _clamped(self, key: str, value: float, low: float, high: float) -> float:
        if low <= value <= high:
            return value
        assert self.entry is not None
        told = f"from {low:g} to {high:g}" if high < INFINITE else f"of at least {low:g}"
        self._left_out.add(
            f"expected a number {told}, so that others are clamped", self.entry.path(key)
        )
        return min(max(value, low), high)


@contextmanager
def at(entry: Entry | str) -> Iterator[None]:
    """Name the place in the tree in an error of the core's own checks."""
    try:
        yield
    except MeshError:
        raise
    except (ValueError, IndexError, TypeError) as error:
        where = entry if isinstance(entry, str) else entry.where
        raise MeshError(f"{where}: {error}") from error
