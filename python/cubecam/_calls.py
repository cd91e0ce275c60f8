"""One line for a call with a wrong, a missing or a superfluous argument; `checked_call` for functions of Python.

`_arguments` gives the same answers for the core's functions, and `_checks` says what a bool, an int, a float and a str
are.
"""

from __future__ import annotations

import difflib
import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, ParamSpec, TypeVar

from ._checks import ArgumentChecks, listed

__all__ = ["Parameter", "checked_call", "unknown_name", "wrong_number"]

P = ParamSpec("P")
R = TypeVar("R")


@dataclass(frozen=True)
class Parameter:
    """One parameter of a signature; `kind` is its type in words, empty if nothing checks it."""

    name: str
    kind: str
    required: bool
    by_name_only: bool


def checked_call(function: Callable[P, R]) -> Callable[P, R]:
    """Let a function answer a call that does not fit its signature in one line, as the core's functions do.

    Arguments whose annotation names bool, int, float, str or a list of names must be of that type. Signature, docstring
    and name stay.
    """
    checks: ArgumentChecks | None = (
        None  # made at the first call, since most functions are never called
    )

    @functools.wraps(function)
    def call(*args: P.args, **kwargs: P.kwargs) -> R:
        nonlocal checks
        if checks is None:
            checks = ArgumentChecks(function)
        if checks:
            given, named = checks.checked(f"{_shown_name(call)}()", args, kwargs)
            args, kwargs = given, named  # type: ignore[assignment]
        try:
            return function(*args, **kwargs)
        except TypeError as error:
            # Python raises before the function has a frame; an error from inside the function stays as it is.
            if error.__traceback__ is None or error.__traceback__.tb_next is not None:
                raise
            answer = _explain(call, args, kwargs)  # `call` has the function's signature
            if answer is None:
                raise
        raise TypeError(answer)

    return call


def _shown_name(function: Callable[..., Any]) -> str:
    """Give a function's name as it is called: a class for its `__init__`."""
    name = function.__name__
    return function.__qualname__.split(".")[0] if name == "__init__" else name


def _explain(
    function: Callable[..., Any], given: tuple[Any, ...], named: dict[str, Any]
) -> str | None:
    import inspect

    name = function.__name__
    parameters = [
        Parameter(p.name, "", p.default is p.empty, p.kind is p.KEYWORD_ONLY)
        for p in inspect.signature(function).parameters.values()
    ]
    # A method's first parameter is the object in front of the dot.
    if given and hasattr(type(given[0]), name):
        parameters, given = parameters[1:], given[1:]
    names = [p.name for p in parameters]
    for word in named:
        if word not in names:
            return unknown_name(f"{name}()", word, names)
    return wrong_number(f"{name}()", parameters, given, named)


def unknown_name(call: str, name: str, names: list[str]) -> str:
    """Say that a call has no option of a name, and which one is near, or which there are."""
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.6)
    takes = f"it takes {', '.join(names) or 'none'}"
    return f"{call} has no option {name!r}; " + (f"did you mean {near[0]!r}?" if near else takes)


def wrong_number(
    call: str, parameters: list[Parameter], given: tuple[Any, ...], named: dict[str, Any]
) -> str | None:
    """Say which arguments are missing, given twice, or given by position without right; None if none is."""
    by_position = [p.name for p in parameters if not p.by_name_only]
    if len(given) > len(by_position):
        rest = [p.name for p in parameters if p.by_name_only and p.name not in named]
        if not by_position:
            names = f"; it takes {', '.join(rest)}" if rest else ""
            how = "its arguments by name" if rest or named else "no arguments"
            return f"{call} takes {how}, got {len(given)} by position{names}"
        count = f"{len(by_position)} argument{'s' * (len(by_position) != 1)}"
        names = f"; name the others: {', '.join(rest)}" if rest else ""
        return (
            f"{call} takes at most {count} by position ({', '.join(by_position)}), "
            f"got {len(given)}{names}"
        )
    for name in by_position[: len(given)]:
        if name in named:
            return f"{call} got {name} by position and by name, expected it once"
    have = {*by_position[: len(given)], *named}
    missing = [p.name for p in parameters if p.required and p.name not in have]
    if not missing:
        return None
    return f"{call} needs {listed(missing, 'and')}"
