"""Values that no argument expects, and every argument and property of the public interface in which one can stand.

`places()` reads the stubs and the signatures of functions written in Python, so that a new argument cannot be
forgotten.
"""

import ast
import datetime
import decimal
import enum
import fractions
import functools
import inspect
import operator
import pathlib
import sys
import typing
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import Any

import numpy as np

import cubecam as cc
import cubecam.typing
from cubecam import cluster, demo, explore, navigation, plot, truth
from cubecam._checks import union_parts
from cubecam.viewer.cube_view import CubeView
from cubecam.viewer.viewer import Viewer
from tests.fuzz.hostile import deep, own

STUB = pathlib.Path(cc.__file__).with_name("_core.pyi")


class Raises:
    """An object of which one method raises."""


def raising(method: str, error: type[Exception] = ZeroDivisionError) -> Any:
    def fail(self: object, *args: object, **kwargs: object) -> Any:
        raise error("from the object itself")

    return type(f"Bad{method.strip('_')}", (Raises,), {method: fail})()


def returning(method: str, result: object) -> Any:
    return type(f"Odd{method.strip('_')}", (), {method: lambda self, *a, **k: result})()


class Color(enum.IntEnum):
    RED = 3


class Word(str):
    """A subclass of str."""


def numpy_scalars() -> dict[str, Any]:
    names = "int8 int16 int32 int64 uint8 uint16 uint32 uint64 float16 float32 float64 longdouble complex64 complex128"
    made = {f"np.{name}": getattr(np, name)(2) for name in names.split()}
    made |= {
        "np.float32(2.7)": np.float32(2.7),
        "np.float64(nan)": np.float64("nan"),
        "np.True_": np.True_,
        "np.False_": np.False_,
        "np.str_": np.str_("2"),
        "np.bytes_": np.bytes_(b"2"),
        "np.void": np.void(b"2"),
        "np.datetime64": np.datetime64("2020-01-01"),
        "np.timedelta64": np.timedelta64(2, "s"),
        "np.nat": np.timedelta64("NaT", "s"),
    }
    return made


#: Nothing changes it, and making it takes longer than making all other values.
_DEEP = deep(20_000)


def values() -> dict[str, Any]:
    """Give the values by name, new ones at every call."""
    made: dict[str, Any] = {
        "None": None,
        "True": True,
        "False": False,
        "2": 2,
        "0": 0,
        "-1": -1,
        "2**31": 2**31,
        "2**63": 2**63,
        "-2**63-1": -(2**63) - 1,
        "10**400": 10**400,
        "10**5000": 10**5000,
        "0.5": 0.5,
        "2.0": 2.0,
        "nan": float("nan"),
        "inf": float("inf"),
        "-inf": float("-inf"),
        "1e300": 1e300,
        "5e-324": 5e-324,
        "1j": 1j,
        "'False'": "False",
        "''": "",
        "'2'": "2",
        "a long text": "x" * 1_000_000,
        "a long word of two bytes": "\u00e9" * 1000,
        "a surrogate": "\ud800",
        "a NUL": "a\0b",
        "a subclass of str": Word("nearest?"),
        "b'gl'": b"gl",
        "b''": b"",
        "bytearray": bytearray(b"gl"),
        "memoryview": memoryview(b"gl"),
        "IntEnum": Color.RED,
        "Fraction": fractions.Fraction(1, 2),
        "Decimal": decimal.Decimal("0.5"),
        "date": datetime.date(2020, 1, 1),
        "()": (),
        "[]": [],
        "(True, True)": (True, True),
        "(2, 2)": (2, 2),
        "(2.0, 2.0)": (2.0, 2.0),
        "(2, None)": (2, None),
        "['a', 'b']": ["a", "b"],
        "three bools": [True, False, True],
        "three texts": ["1", "2", "3"],
        "three objects": [object(), object(), object()],
        "a great number in a list": [10**400, 0, 0],
        "a ragged list": [[1, 2], [3]],
        "{}": {},
        "{1: 2}": {1: 2},
        "{'a': nan}": {"a": float("nan")},
        "set": {1, 2},
        "range": range(3),
        "a generator": (i for i in range(3)),
        "a class": int,
        "a function": len,
        "Ellipsis": ...,
        "NotImplemented": NotImplemented,
        "object": object(),
        "a deep list": _DEEP,
        "an endless list": own(),
        "a long list": [0.5] * 10_000,
        "masked": np.ma.masked,
        "a masked int": np.ma.masked_array(2, mask=True),
        "a masked float": np.ma.masked_array(0.5, mask=True),
        "a masked pair": np.ma.masked_array([2, 2], mask=[False, True]),
        "array(2)": np.array(2),
        "array(0.5)": np.array(0.5),
        "array(True)": np.array(True),
        "array([2])": np.array([2]),
        "array([2.7])": np.array([2.7]),
        "array([True])": np.array([True]),
        "array of objects": np.array([object(), None]),
        "array of no numbers": np.zeros((0, 3)),
        "array of many axes": np.zeros((1,) * 20),
        "array of dates": np.array(["2020-01-01"], "datetime64[D]"),
        "a record": np.zeros(2, [("a", "f4")]),
        "__index__ gives 2": returning("__index__", 2),
        "__float__ gives 0.5": returning("__float__", 0.5),
        "__index__ gives a float": returning("__index__", 0.5),
        "__float__ gives a str": returning("__float__", "0.5"),
        "__len__ gives -1": returning("__len__", -1),
        "__bool__ gives 2": returning("__bool__", 2),
        "__fspath__ gives 2": returning("__fspath__", 2),
        "__array__ gives None": returning("__array__", None),
        "a scene": cc.Scene(),
        "no __init__": cc.Scene.__new__(cc.Scene),
    }
    methods = "index bool len float int iter getitem array fspath repr eq hash getattr call str complex buffer"
    for method in methods.split():
        made[f"__{method}__ raises"] = raising(f"__{method}__")
    made["__repr__ raises RecursionError"] = raising("__repr__", RecursionError)
    return made | numpy_scalars()


ABSURD = list(values())


def is_whole(value: object) -> bool:
    if isinstance(value, (bool, np.bool_)) or type(value).__name__ == "Oddindex":
        return type(value).__name__ == "Oddindex" and bool(
            vars(type(value))["__index__"](value) == 2
        )
    if isinstance(value, np.ndarray):
        hidden = isinstance(value, np.ma.MaskedArray)
        return value.ndim == 0 and value.dtype.kind in "iu" and not hidden
    return isinstance(value, (int, np.integer)) and not isinstance(value, np.timedelta64)


def is_real(value: object) -> bool:
    if is_whole(value):
        return abs(operator.index(value)) < 2**1024  # type: ignore[arg-type]
    if isinstance(value, np.ndarray):
        hidden = isinstance(value, np.ma.MaskedArray)
        return value.ndim == 0 and value.dtype.kind == "f" and not hidden
    if type(value).__name__ == "Oddfloat":
        return bool(vars(type(value))["__float__"](value) == 0.5)
    return isinstance(value, (float, np.floating, fractions.Fraction, decimal.Decimal))


def is_pair(value: object) -> bool:
    if isinstance(value, np.ndarray):
        hidden = isinstance(value, np.ma.MaskedArray)
        return value.shape == (2,) and value.dtype.kind in "iu" and not hidden
    return isinstance(value, (tuple, list)) and len(value) == 2 and all(map(is_whole, value))


class Kinds:
    """What an annotation allows: `plain` says whether `allows` can judge every value."""

    def __init__(self, annotation: str) -> None:
        self.names: set[str] = set()
        self.words: set[str] = set()
        self.plain = True
        for part in union_parts(annotation):
            self._add(part.removeprefix("typing.").removeprefix("cubecam.typing."))

    def _add(self, part: str) -> None:
        simple = {
            "bool": "bool",
            "int": "int",
            "SupportsIndex": "int",
            "float": "float",
            "SupportsFloat": "float",
            "str": "str",
            "None": "None",
            "tuple[int, int]": "pair",
        }
        alias = vars(cubecam.typing).get(part)
        if part in simple:
            self.words.add(simple[part])
        elif typing.get_origin(alias) is typing.Literal:
            self.names |= set(typing.get_args(alias))
        elif part.startswith("Literal["):
            self.names |= set(ast.literal_eval(f"({part[8:-1]},)"))
        else:
            self.plain = False

    def allows(self, value: object) -> bool:
        """Say whether a value is of one of the kinds; the call may refuse it all the same, as a wrong number."""
        judges: dict[str, Callable[[object], bool]] = {
            "bool": lambda v: isinstance(v, (bool, np.bool_)),
            "int": is_whole,
            "float": is_real,
            "str": lambda v: isinstance(v, str),
            "None": lambda v: v is None,
            "pair": is_pair,
        }
        return any(judges[word](value) for word in self.words) or (
            isinstance(value, str) and value in self.names
        )


@dataclass(frozen=True)
class Place:
    """An argument of a callable, or a property (`argument` is empty)."""

    callable: str
    argument: str
    annotation: str

    def __str__(self) -> str:
        return f"{self.callable}.{self.argument}" if self.argument else self.callable


def places() -> Iterator[Place]:
    """Yield every argument and every settable property of the public interface."""
    for node in ast.parse(STUB.read_text(encoding="utf-8")).body:
        if isinstance(node, ast.FunctionDef) and not node.name.startswith("_"):
            yield from _arguments_of(node, node.name, 0)
        if isinstance(node, ast.ClassDef) and not node.name.startswith("_"):
            for member in node.body:
                if isinstance(member, ast.FunctionDef):
                    yield from _members(node.name, member)
    for name, function in python_functions().items():
        for parameter in inspect.signature(function).parameters.values():
            some = (parameter.VAR_KEYWORD, parameter.VAR_POSITIONAL)
            if parameter.kind not in some and parameter.name != "self":
                yield Place(name, parameter.name, str(parameter.annotation))
    for kind in VIEWS:
        for name, member in inspect.getmembers(kind):
            if name.startswith("_"):
                continue
            if isinstance(member, property) and member.fset is not None:
                *_, value = inspect.signature(member.fset).parameters.values()
                yield Place(f"{kind.__name__}.{name}", "", str(value.annotation))
            elif hasattr(member, "control"):  # a Setting
                yield Place(f"{kind.__name__}.{name}", "", "object")


def _members(owner: str, member: ast.FunctionDef) -> Iterator[Place]:
    decorators = [ast.unparse(d) for d in member.decorator_list]
    if member.name == "__init__":
        yield from _arguments_of(member, owner, 1)
    elif any(d.endswith(".setter") for d in decorators):
        value = member.args.args[1]
        kind = "" if value.annotation is None else ast.unparse(value.annotation)
        yield Place(f"{owner}.{member.name}", "", kind)
    elif not member.name.startswith("_") or member.name in ("__getitem__", "__contains__"):
        static = "staticmethod" in decorators
        yield from _arguments_of(member, f"{owner}.{member.name}", 0 if static else 1)


def _arguments_of(node: ast.FunctionDef, name: str, first: int) -> Iterator[Place]:
    for argument in (*node.args.posonlyargs, *node.args.args[first:], *node.args.kwonlyargs):
        kind = "" if argument.annotation is None else ast.unparse(argument.annotation)
        yield Place(name, argument.arg, kind)


VIEWS = (Viewer, CubeView, explore.ReflectionView, explore.LayoutView)


def python_functions() -> dict[str, Callable[..., Any]]:
    """Give the public functions that are written in Python; methods that are attached to classes stand in the stubs."""
    found = {name: getattr(cc, name) for name in cc.__all__}
    found = {name: thing for name, thing in found.items() if inspect.isfunction(thing)}
    for module in (plot, navigation, truth, cluster):
        short = module.__name__.rpartition(".")[2]
        found |= {
            f"{short}.{n}": thing
            for n in module.__all__
            if inspect.isfunction(thing := getattr(module, n))
        }
    if sys.version_info < (3, 11):  # without zarr 3
        found = {n: f for n, f in found.items() if n != "open_batch" and n[:8] != "cluster."}
    found["explore.reflection"] = explore.reflection
    found["explore.layout"] = explore.layout
    found["demo.run"] = demo.run
    found["demo.build_scene"] = demo.build_scene
    found["DemoScene.turn"] = demo.DemoScene.turn
    for kind in VIEWS:
        found[kind.__name__] = kind.__init__
        for name, member in inspect.getmembers(kind, inspect.isfunction):
            if not name.startswith("_"):
                found[f"{kind.__name__}.{name}"] = member
    return found | pool_functions()


def pool_functions() -> dict[str, Callable[..., Any]]:
    """Give the functions of `cubecam.Pool`."""
    members = inspect.getmembers(cc.Pool, inspect.isfunction)
    found = {f"Pool.{name}": member for name, member in members if not name.startswith("_")}
    return {"Pool": cc.Pool.__init__, **found}


@functools.cache
def pool() -> cc.Pool:
    """Give a pool that draws in this process."""
    return cc.Pool(executor=ThreadPoolExecutor(1), device="software")
