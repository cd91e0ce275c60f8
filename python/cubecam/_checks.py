"""The one check for whole numbers, real numbers, bools and texts that arguments of functions written in Python pass.

The core decides what is one (cpp/bindings/numbers.hpp), so that its own arguments and those of Python agree: an int of
numpy is an int, a float and a bool are not; a bool of numpy is a bool, while 1, "False" and nan are not; a hidden value
of a masked array is nothing. `ArgumentChecks` reads the annotations of a function: `checked_call` uses it for every
public function, so that a new argument is checked at once.
"""

from __future__ import annotations

import ast
import math
import operator
import typing
from collections.abc import Callable, Iterable, Sequence
from typing import Any

from . import _core
from . import typing as names_of_types

__all__ = [
    "ArgumentChecks",
    "check_room",
    "finite_number",
    "listed",
    "one_of",
    "pair",
    "real_number",
    "text_of",
    "truth",
    "union_parts",
    "whole_number",
]

#: A short text for a value in a message: numbers, texts and short lists as Python writes them, all else by its type.
text_of: Callable[[object], str] = _core._text_of


def listed(words: Sequence[str], last: str = "or") -> str:
    """Join words for a sentence.

    Examples
    --------
    >>> from cubecam._checks import listed
    >>> listed(["int", "float", "None"])
    'int, float or None'
    >>> listed(["K", "size"], "and")
    'K and size'
    """
    return f" {last} ".join([", ".join(words[:-1]), words[-1]] if len(words) > 1 else words)


def whole_number(value: Any, name: str, low: int | None = None, high: int | None = None) -> int:
    """Give an int, of Python or numpy, as an int of Python.

    Raises
    ------
    TypeError
        For everything else: floats, bools, texts, None.
    ValueError
        For a number below `low` or above `high`.

    Examples
    --------
    >>> from cubecam._checks import whole_number
    >>> import numpy as np
    >>> whole_number(np.uint8(3), "size")
    3
    >>> whole_number(2.7, "size")
    Traceback (most recent call last):
    TypeError: size: expected an int, got 2.7
    >>> whole_number(-1, "size", 1)
    Traceback (most recent call last):
    ValueError: size: expected an int of at least 1, got -1
    """
    if not _core._is_whole_number(value):
        raise TypeError(f"{name}: expected an int, got {text_of(value)}")
    number = operator.index(value)
    if (low is not None and number < low) or (high is not None and number > high):
        limits = f"of at least {low}" if high is None else f"from {low} to {high}"
        raise ValueError(f"{name}: expected an int {limits}, got {text_of(number)}")
    return number


def real_number(value: Any, name: str) -> float:
    """Give a number, of Python or numpy, as a float of Python; NaN and infinities are numbers, too.

    Raises
    ------
    TypeError
        For everything else: bools, complex numbers, texts, arrays with axes, and ints that no float can hold.

    Examples
    --------
    >>> from cubecam._checks import real_number
    >>> from fractions import Fraction
    >>> real_number(Fraction(1, 4), "exposure")
    0.25
    >>> real_number(True, "exposure")
    Traceback (most recent call last):
    TypeError: exposure: expected a number, got True
    """
    if not _core._is_real_number(value):
        raise TypeError(f"{name}: expected a number, got {text_of(value)}")
    return float(value)


def truth(value: Any, name: str) -> bool:
    """Give a bool, of Python or numpy, as a bool of Python.

    Raises
    ------
    TypeError
        For everything else, such as 1, nan and "False".

    Examples
    --------
    >>> from cubecam._checks import truth
    >>> truth("False", "srgb")
    Traceback (most recent call last):
    TypeError: srgb: expected a bool, got 'False'
    """
    if not _core._is_truth_value(value):
        raise TypeError(f"{name}: expected a bool, got {text_of(value)}")
    return bool(value)


def finite_number(value: Any, name: str) -> float:
    """Give a real number that is finite; another one raises ValueError.

    Examples
    --------
    >>> from cubecam._checks import finite_number
    >>> finite_number(float("nan"), "speed")
    Traceback (most recent call last):
    ValueError: speed: expected a finite number, got nan
    """
    number = real_number(value, name)
    if not math.isfinite(number):
        raise ValueError(f"{name}: expected a finite number, got {number}")
    return number


def one_of(value: Any, name: str, known: Iterable[str | None], also: str = "") -> Any:
    """Give one of some names, among which may be None; another one raises ValueError, what is no str TypeError.

    `also` names in the message what else the caller takes.

    Examples
    --------
    >>> from cubecam._checks import one_of
    >>> one_of(b"srgb", "encode", ["srgb", None])
    Traceback (most recent call last):
    TypeError: encode: expected "srgb" or None, got b'srgb'
    """
    allowed = tuple(known)
    # A list cannot be compared with names that are hashed, and an array gives no bool.
    if value is None and None in allowed:
        return None
    if isinstance(value, str) and str(value) in allowed:
        return str(value)
    words = ["None" if one is None else f'"{one}"' for one in allowed]
    words += [also] if also or not words else []
    error = ValueError if isinstance(value, str) else TypeError
    raise error(f"{name}: expected {listed(words)}, got {text_of(value)}")


def check_room(size: float, what: str, name: str) -> None:
    """Raise ValueError unless the memory holds `size` bytes more, which `what` takes.

    Examples
    --------
    >>> from cubecam._checks import check_room
    >>> check_room(1e30, "numbers of shape (9,)", "eta")  # doctest: +ELLIPSIS
    Traceback (most recent call last):
    ValueError: eta: expected what fits into ... MiB of memory (...), got numbers of shape (9,), which take ...
    """
    try:
        _core._check_memory(size, what)
    except ValueError as error:
        raise ValueError(f"{name}:{str(error).partition(':')[2]}") from None


def pair(value: Any, name: str) -> tuple[int, int]:
    """Give two ints as (width, height).

    Examples
    --------
    >>> from cubecam._checks import pair
    >>> pair([640, 480.0], "size")
    Traceback (most recent call last):
    TypeError: size: expected (width, height), got [640, 480.0]
    """
    found = _pair(value)
    if found is None:
        raise TypeError(f"{name}: expected (width, height), got {text_of(value)}")
    return found


class ArgumentChecks:
    """Checks for the arguments of one function whose annotations name bool, int, float, str and lists of names.

    An argument of another annotation, such as an array, is left to the function.
    """

    def __init__(self, function: Callable[..., Any]) -> None:
        code = function.__code__
        self._positions = code.co_varnames[: code.co_argcount]
        self._kinds: dict[str, _Kinds] = {}
        for name, annotation in function.__annotations__.items():
            kinds = _kinds_of(str(annotation))
            if kinds is not None and name != "return":
                self._kinds[name] = kinds

    def __bool__(self) -> bool:
        """Say whether any argument is checked."""
        return bool(self._kinds)

    def checked(
        self, call: str, given: tuple[Any, ...], named: dict[str, Any]
    ) -> tuple[tuple[Any, ...], dict[str, Any]]:
        """Give the arguments, numbers and bools of numpy as those of Python; raise TypeError for a wrong one."""
        changed: list[Any] | None = None
        for at, (name, value) in enumerate(zip(self._positions, given, strict=False)):
            if name in self._kinds:
                new = self._kinds[name].read(call, name, value)
                if new is not value:
                    changed = list(given) if changed is None else changed
                    changed[at] = new
        for name in self._kinds.keys() & named.keys():
            named[name] = self._kinds[name].read(call, name, named[name])
        return (given if changed is None else tuple(changed)), named


class _Kinds:
    """What an annotation allows: some of None, bool, int, float, str, and a pair of ints."""

    def __init__(self, parts: Sequence[str], names: Sequence[str]) -> None:
        self._parts, self._names = frozenset(parts), tuple(names)

    def read(self, call: str, name: str, value: Any) -> Any:
        # Most arguments have one of these types, and need no further look.
        plain = type(value).__name__
        if plain in self._parts and type(value) in (bool, int, float, str):
            return value
        if value is None and "None" in self._parts:
            return value
        if "bool" in self._parts and _core._is_truth_value(value):
            return bool(value)
        if self._parts & {"int", "float"} and _core._is_whole_number(value):
            # A float may be given as an int; the function writes it as it came.
            number = operator.index(value)
            if "int" in self._parts or _core._is_real_number(number):
                return number
        if "float" in self._parts and _core._is_real_number(value):
            return float(value)
        if (self._names or "str" in self._parts) and isinstance(value, str):
            return value
        if "pair" in self._parts and (two := _pair(value)) is not None:
            return two
        raise TypeError(f"{call}: {name}: expected {self._text()}, got {text_of(value)}")

    def _text(self) -> str:
        words = [f'"{name}"' for name in self._names]
        words += [word for word in ("bool", "int", "float", "str") if word in self._parts]
        words += ["(width, height)"] * ("pair" in self._parts) + ["None"] * ("None" in self._parts)
        return listed(words)


def _pair(value: Any) -> tuple[int, int] | None:
    """Give two ints as a tuple; None if the value is anything else."""
    if isinstance(value, (str, bytes, bytearray, memoryview, dict, set, frozenset)):
        return None
    try:
        items = [value[0], value[1]] if len(value) == 2 else []
    except Exception:  # the value is no sequence
        return None
    if not items or not all(map(_core._is_whole_number, items)):
        return None
    return operator.index(items[0]), operator.index(items[1])


def _kinds_of(annotation: str) -> _Kinds | None:
    """Read "Tonemap | Literal['auto'] | None"; None if a part of it is no plain value."""
    parts, names = [], []
    for part in union_parts(annotation):
        if part in ("None", "bool", "int", "float", "str"):
            parts.append(part)
        elif part == "tuple[int, int]":
            parts.append("pair")
        elif part.startswith("Literal["):
            names += list(ast.literal_eval(f"({part[8:-1]},)"))
        elif typing.get_origin(alias := vars(names_of_types).get(part, None)) is typing.Literal:
            names += list(typing.get_args(alias))
        else:
            return None
    return _Kinds(parts, names)


def union_parts(annotation: str) -> list[str]:
    """Cut an annotation at the bars that stand in no brackets.

    Examples
    --------
    >>> from cubecam._checks import union_parts
    >>> union_parts("dict[str, int | float] | None")
    ['dict[str, int | float]', 'None']
    """
    parts, depth = [""], 0
    for letter in annotation:
        depth += (letter in "[(") - (letter in "])")
        if letter == "|" and depth == 0:
            parts.append("")
        else:
            parts[-1] += letter
    return [part.strip() for part in parts]
