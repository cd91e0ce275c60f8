"""Objects that answer every question wrongly, and values that no argument expects; programs of api.py name them."""

from __future__ import annotations

import math
from typing import Any

import numpy as np


class HostileError(Exception):
    """What hostile objects raise: a call may let it through."""


class Raises:
    """Raises from every special method that a conversion may call."""

    def _fail(self, *arguments: Any, **options: Any) -> Any:
        raise HostileError("hostile")

    __array__ = __index__ = __int__ = __float__ = __bool__ = __len__ = __getitem__ = __iter__ = _fail
    __fspath__ = __eq__ = __hash__ = __str__ = __repr__ = __dlpack__ = __contains__ = _fail  # type: ignore[assignment]


class Lies:
    """Returns what it must not return."""

    def __array__(self, *arguments: Any, **options: Any) -> Any:
        return "no array"

    def __index__(self) -> Any:
        return 1.5

    def __float__(self) -> Any:
        return "1"

    def __len__(self) -> int:
        return 2**62

    def __getitem__(self, place: Any) -> Any:
        if place > 5:
            raise IndexError
        return self

    def __fspath__(self) -> Any:
        return 3

    def __repr__(self) -> Any:
        return None


class Number:
    """A number by its special methods alone."""

    def __init__(self, value: float) -> None:
        self.value = value

    def __index__(self) -> int:
        return int(self.value)

    def __float__(self) -> float:
        return float(self.value)


class Shrinking(list):
    """A list that loses its items while it is read."""

    def __getitem__(self, place: Any) -> Any:
        item = super().__getitem__(place)
        self.clear()
        return item

    def __iter__(self) -> Any:
        items = list(super().__iter__())
        self.clear()
        return iter(items)


class Meddling:
    """An array that changes the scene while it is converted."""

    def __init__(self, world: Any, shape: tuple[int, ...] = (3,)) -> None:
        self.world, self.shape = world, shape

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        for node in list(self.world.scene.nodes)[-1:]:
            self.world.scene.remove(node)
        self.world.mesh.update(positions=self.world.mesh.positions * 1.5)
        return np.ones(self.shape, dtype)

    def __iter__(self) -> Any:
        return iter(self.__array__())


def deep(depth: int = 100_000) -> list[Any]:
    """Return a list in a list in a list."""
    made: list[Any] = []
    for _ in range(depth):
        made = [made]
    return made


def own() -> list[Any]:
    """Return a list that holds itself."""
    made: list[Any] = [1.0]
    made.append(made)
    return made


def wide(*shape: int, dtype: Any = np.float32) -> Any:
    """Return an array of any shape that needs no memory: all of its numbers are one."""
    return np.broadcast_to(np.zeros((), dtype), shape)


#: Values that few arguments accept, as Python.
VALUES = [
    "None", "True", "False", "0", "1", "-1", "2", "3", "7", "255", "256", "2**15", "2**31 - 1", "2**31", "-2**31",
    "2**32", "2**63", "-2**63 - 1", "2**64", "10**30", "10**400", "-10**400", "0.0", "-0.0", "0.5", "-1.5", "1e-30",
    "1e-320", "1e30", "1e38", "1e39", "1e308", "inf", "-inf", "nan", "1j", "''", "'x'", "'\\ud800'", "'\\0'",
    "'x' * 70_000", "'rgba8'", "b''", "b'x'", "()", "[]", "{}", "set()", "[None]", "[1]", "(1, 2)", "(1, 2, 3)",
    "(0, 0, 0)", "(nan, 0, 0)", "(inf, -inf, 0)", "(1e30, 1e30, 1e30)", "(1e-30, 0, 0)", "(1, 2, 3, 4)", "(1, 'x', 2)",
    "[[1, 2], [3]]", "[1, [2]]", "range(3)", "iter([1, 2, 3])", "(x for x in (1, 2, 3))", "{'a': 1}", "{1: 2}",
    "{'tone': nan}", "object()", "object", "int", "len", "...", "NotImplemented", "slice(None)", "memoryview(b'abc')",
    "bytearray(12)", "np.float64(0.5)", "np.float32(nan)", "np.int8(-3)", "np.uint64(2**64 - 1)", "np.bool_(True)",
    "np.array(3)", "np.array(2.5)", "np.zeros(0)", "np.zeros(3)", "np.ones(4)", "np.zeros((0, 3))", "np.ones((3, 3))",
    "np.eye(4)", "np.eye(4) * 1e30", "np.zeros((4, 4))", "np.full((4, 4), nan)", "np.ones((4, 4, 3))",
    "np.ones((4, 4, 3), np.uint8)", "np.ones((6, 4, 4, 3), np.float32)", "np.ones((6, 4, 4, 0))", "np.ones((2, 2, 2, 2, 2))",
    "np.full((6, 4, 4, 3), nan, np.float32)", "np.full((4, 8, 3), 1e30)", "np.arange(12.0)[::-2]",
    "np.ones((4, 4, 3))[::2, ::-1]", "np.asfortranarray(np.ones((4, 5, 3)))", "np.ones((4, 4, 3), '>f4')",
    "np.array([1, None, 2])", "np.array(['a', 'b'])", "np.array([1 + 2j, 0, 0])", "np.ones(3, 'M8[s]')",
    "np.ones(3, [('a', int)])", "np.ma.array([1.0, 2, 3], mask=[0, 1, 0])", "np.ma.ones((4, 4, 3))",
    "np.float16([1, 2, 6e4])", "np.int64([2**40, -1, 0])", "np.uint64([2**64 - 1, 0, 1])",
    "hostile.wide(2**40, 3)", "hostile.wide(2**20, 2**20, 3)", "hostile.wide(6, 2**16, 2**16, 4)",
    "hostile.wide(2**31, dtype=np.uint32)", "hostile.Raises()", "hostile.Lies()", "hostile.Number(2)",
    "hostile.Number(nan)", "hostile.Number(10**400)", "hostile.Shrinking([1, 2, 3])", "hostile.Shrinking([[1, 2, 3]] * 3)",
    "hostile.Meddling(w)", "hostile.Meddling(w, (4, 4))", "hostile.Meddling(w, (24, 3))", "hostile.deep()", "hostile.own()",
    "Path('a.png')", "Path()", "np.dtype('f4')", "'f8'", "np.void(b'abc')",
]  # fmt: skip

NAN, INF = math.nan, math.inf
