"""Values of a JSON tree with their place in it: wrong types become a `MeshError` that names the place."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, TypeGuard

from ..._core import MeshError


def shown(value: object) -> str:
    """Write a value of JSON for a message, shortened."""
    text = ascii(value)
    return text if len(text) <= 60 else text[:57] + "..."


def is_integer(value: object) -> TypeGuard[float]:
    """Say whether JSON has an integer here: 3.0 is one, too, as some languages write all numbers."""
    if isinstance(value, float):
        return value.is_integer() and abs(value) < 2**53
    return isinstance(value, int) and not isinstance(value, bool)


@dataclass(frozen=True)
class Entry:
    """One JSON object: `where` is its path in the tree, such as `nodes[3]`, `raw` is the object as the file has it."""

    where: str
    raw: dict[str, Any]

    def __contains__(self, key: str) -> bool:
        return key in self.raw

    def error(self, key: str, expected: str) -> MeshError:
        """Make the error for a value that is not as expected, or is missing."""
        got = shown(self.raw[key]) if key in self.raw else "none"
        return MeshError(f"{self.path(key)}: expected {expected}, got {got}")

    def path(self, key: str) -> str:
        return f"{self.where}.{key}" if self.where else key

    def integer(self, key: str, default: int | None = None, *, low: int = 0) -> int:
        """Read an integer of at least `low`; without a default the entry must have it."""
        value = self.raw.get(key, default)
        if not is_integer(value) or value < low:
            raise self.error(key, f"an integer from {low}")
        return int(value)

    def index(self, key: str, count: int) -> int | None:
        """Read an index below `count`; None if there is no such key."""
        if key not in self.raw:
            return None
        value = self.raw[key]
        if not is_integer(value) or not 0 <= value < count:
            raise self.error(key, f"an index below {count}")
        return int(value)

    def indices(self, key: str, count: int) -> list[int]:
        """Read a list of indices below `count`, an empty one if there is no such key."""
        values = self.raw.get(key, [])
        if not isinstance(values, list):
            raise self.error(key, "a list of indices")
        for place, value in enumerate(values):
            if not is_integer(value) or not 0 <= value < count:
                path = self.path(f"{key}[{place}]")
                raise MeshError(f"{path}: expected an index below {count}, got {shown(value)}")
        return [int(value) for value in values]

    def numbers(self, key: str, count: int | None = None) -> list[float] | None:
        """Read a list of finite numbers, `count` of them if that is given; None if there is no such key."""
        if key not in self.raw:
            return None
        values = self.raw[key]
        if not isinstance(values, list) or (count is not None and len(values) != count):
            raise self.error(key, f"a list of {'' if count is None else f'{count} '}numbers")
        try:
            if all(type(v) in (int, float) and math.isfinite(v) for v in values):
                return [float(v) for v in values]
        except OverflowError:  # an integer that is too big for a float
            pass
        raise self.error(key, "finite numbers")

    def text(self, key: str) -> str | None:
        value = self.raw.get(key)
        if value is not None and not isinstance(value, str):
            raise self.error(key, "a string")
        return value

    def flag(self, key: str, default: bool = False) -> bool:
        value = self.raw.get(key, default)
        if not isinstance(value, bool):
            raise self.error(key, "true or false")
        return value

    def entry(self, key: str) -> Entry | None:
        """Read a JSON object; None if there is no such key."""
        if key not in self.raw:
            return None
        value = self.raw[key]
        if not isinstance(value, dict):
            raise self.error(key, "an object")
        return Entry(self.path(key), value)

    def needed(self, key: str) -> Entry:
        """Read a JSON object that must be there."""
        found = self.entry(key)
        if found is None:
            raise self.error(key, "an object")
        return found

    def entries(self, key: str) -> list[Any]:
        """Read a list, an empty one if there is no such key; `member` reads what is in it."""
        values = self.raw.get(key, [])
        if not isinstance(values, list):
            raise self.error(key, "a list of objects")
        return values

    def member(self, key: str, index: int) -> Entry:
        """Read one object of a list whose length the caller knows."""
        value = self.raw[key][index]
        path = self.path(f"{key}[{index}]")
        if not isinstance(value, dict):
            raise MeshError(f"{path}: expected an object, got {shown(value)}")
        return Entry(path, value)

    def extension(self, name: str) -> Entry | None:
        """Read what an extension says about this entry; None if it says nothing."""
        if "extensions" not in self.raw:
            return None
        return self.needed("extensions").entry(name)
