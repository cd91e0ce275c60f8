"""One line for a call that fits no signature of the core.

pybind11's own error lists every signature with every default, so that the wrong argument is hard to find. The core
calls `explain` after such an error (cpp/bindings/arguments.cpp); a call that succeeds does not run any of this code.
"""

from __future__ import annotations

import re
from typing import Any

from . import _core
from ._calls import Parameter, unknown_name, wrong_number
from ._checks import listed, text_of
from ._old_names import PICKLED_ARGUMENTS, renamed_argument

__all__ = ["explain"]

_OLD_PICKLE = (
    "; if a pickle was being read: this pickle was made by cubecam 0.1, expected one of 0.2 or later: "
    "rebuild the scene, or read it with cubecam 0.1"
)


def explain(
    function: str, message: str, given: tuple[Any, ...], named: dict[str, Any]
) -> Exception:
    """Say what is wrong with a call, by the exception that it raises.

    Parameters
    ----------
    function : str
        The function's name in messages: "Scene.add", or "Mesh" for the constructor.
    message : str
        The message of pybind11.
    given, named : tuple and dict
        The arguments of the call.

    Returns
    -------
    Exception
        With one line: a ValueError for a number of the right kind that the core cannot hold, else a TypeError.
    """
    try:
        return TypeError(_explanation(function, message, given, named))
    except _BeyondError as beyond:
        return ValueError(str(beyond))


class _BeyondError(Exception):
    """The text about a number that the core cannot hold."""


def _explanation(function: str, message: str, given: tuple[Any, ...], named: dict[str, Any]) -> str:
    overloads = [_parameters(text) for text in _signatures(message)]
    owner, _, member = function.rpartition(".")
    if any(parameters and parameters[0].name == "self" for parameters in overloads):
        overloads = [parameters[1:] for parameters in overloads]
        given = given[1:]
        call = f"{member}()"
    else:
        if "constructor" in message:
            given = given[1:]
        call = (
            f"{function}()"  # a class, a function, or a static method, which is called by its class
        )
    if any(overloads) and isinstance(getattr(getattr(_core, owner, None), member, None), property):
        return f"{function}: {_wrong_value(overloads, given)}"
    names = list(dict.fromkeys(p.name for parameters in overloads for p in parameters))
    for name in named:
        if name not in names:
            return renamed_argument(function, call, name) or unknown_name(call, name, names)
    if not overloads:
        return f"{call}: expected other arguments, got {_values(given, named)}"
    # Of several signatures, the best has the most of the given names, and among these the most parameters.
    parameters = max(overloads, key=lambda p: (len({q.name for q in p} & set(named)), len(p)))
    number = wrong_number(call, parameters, given, named)
    if number is not None:
        old = (
            PICKLED_ARGUMENTS.get(function)
            == len(given)
            > sum(not p.by_name_only for p in parameters)
        )
        return number + _OLD_PICKLE * old
    return _wrong_type(call, parameters, given, named) or (
        f"{call}: expected ({', '.join(_described(p) for p in parameters)}), "
        f"got {_values(given, named)}"
    )


def _signatures(message: str) -> list[str]:
    """Cut out what stands between the brackets of each signature."""
    texts = []
    listed = message.split("\nInvoked with:", 1)[0]
    for line in re.findall(r"^ +\d+\. (.*)$", listed, flags=re.MULTILINE):
        depth, begin = 0, line.index("(") + 1
        for at, (letter, quoted) in enumerate(_letters(line)):
            if quoted:
                continue
            depth += (letter in "([{") - (letter in ")]}")
            if letter == ")" and depth == 0:
                texts.append(line[begin:at])
                break
    return texts


def _letters(text: str) -> list[tuple[str, bool]]:
    """Pair each letter with whether it stands within quotes."""
    letters = []
    quote = ""
    for letter in text:
        inside = bool(quote)
        if quote:
            quote = "" if letter == quote else quote
        elif letter in "'\"":
            quote = letter
        letters.append((letter, inside or bool(quote)))
    return letters


def _parameters(text: str) -> list[Parameter]:
    """Parse "scene: cubecam.Scene, *, size: object = (1, 2)"."""
    parts, depth = [""], 0
    for letter, quoted in _letters(text):
        depth += 0 if quoted else (letter in "([{") - (letter in ")]}")
        if letter == "," and depth == 0 and not quoted:
            parts.append("")
        else:
            parts[-1] += letter
    parameters = []
    by_name_only = False
    for part in (part.strip() for part in parts):
        if part == "*":
            by_name_only = True
        elif part and part != "/" and not part.startswith("*"):
            declared, _, default = part.partition(" = ")
            name, _, kind = declared.partition(": ")
            parameters.append(Parameter(name, kind, not default, by_name_only))
    return parameters


def _wrong_value(overloads: list[list[Parameter]], given: tuple[Any, ...]) -> str:
    """Say what a property expected; its setter has one parameter, whose name nobody writes."""
    for parameters in overloads:
        if parameters and given:
            _refuse_beyond("", parameters[-1].kind, given[-1])
    kinds = [_readable(parameters[-1].kind) for parameters in overloads if parameters]
    return f"expected {' or '.join(kinds)}, got {_value(given[-1] if given else None)}"


def _wrong_type(
    call: str, parameters: list[Parameter], given: tuple[Any, ...], named: dict[str, Any]
) -> str | None:
    values = dict(zip((p.name for p in parameters), given, strict=False)) | named
    for parameter in parameters:
        if parameter.name in values and not _fits(parameter.kind, values[parameter.name]):
            got = values[parameter.name]
            return (
                f"{call}: {parameter.name}: expected {_readable(parameter.kind)}, got {_value(got)}"
            )
    for parameter in parameters:
        if parameter.name in values:
            _refuse_beyond(f"{call}: {parameter.name}: ", parameter.kind, values[parameter.name])
    return None


def _refuse_beyond(begin: str, kind: str, value: Any) -> None:
    """Raise _BeyondError for an int or a text that an argument of the core cannot hold."""
    kinds = kind.split(" | ")
    if "typing.SupportsFloat" in kinds:
        if _core._is_whole_number(value) and not _core._is_real_number(value):
            raise _BeyondError(
                f"{begin}expected a number within float64's range, got {_value(value)}"
            )
    elif _core._is_whole_number(value) and any(_takes_ints(one) for one in kinds):
        low, high = -(2**31), 2**31 - 1
        if not low <= value <= high:
            raise _BeyondError(f"{begin}expected an int from {low} to {high}, got {_value(value)}")
    if isinstance(value, str) and not _is_unicode(value):
        raise _BeyondError(f"{begin}expected text that is valid Unicode, got {_value(value)}")


def _takes_ints(kind: str) -> bool:
    """Say whether a type is int, or a choice of ints."""
    return kind == "typing.SupportsIndex" or re.match(r"typing\.Literal\[\d", kind) is not None


def _is_unicode(text: str) -> bool:
    try:
        text.encode()
    except UnicodeEncodeError:
        return False
    return True


def _fits(kind: str, value: Any) -> bool:
    """Say whether a value may be of a type; True if that is not certain."""
    return any(_fits_one(one, value) for one in kind.split(" | "))


def _fits_one(kind: str, value: Any) -> bool:
    if kind == "None":
        return value is None
    if value is None:
        return kind in ("object", "typing.Any")
    if kind == "bool":
        return _core._is_truth_value(value)
    if _takes_ints(kind):
        return _core._is_whole_number(value)
    if kind == "str" or kind.startswith("typing.Literal["):
        return isinstance(value, str)
    if kind == "typing.SupportsFloat":
        return _core._is_real_number(value) or _core._is_whole_number(value)
    owner = getattr(_core, kind.removeprefix("cubecam."), None)
    return isinstance(value, owner) if isinstance(owner, type) else True


def _readable(kind: str) -> str:
    names = []
    for one in kind.split(" | "):
        if one.startswith("typing.Literal["):
            names += one.removeprefix("typing.Literal[").removesuffix("]").split(", ")
            continue
        plain = {"typing.SupportsFloat": "float"}.get(one, one)
        plain = plain.removeprefix("cubecam.").removeprefix("numpy.typing.").removeprefix("typing.")
        plain = {"ArrayLike": "array_like", "SupportsIndex": "int"}.get(plain, plain)
        if not (one == "typing.SupportsIndex" and names[-1:] == ["float"]):
            names.append(plain)
    return listed(names)


def _described(parameter: Parameter) -> str:
    kind = re.sub(r"typing\.Literal\[\d[^]]*\]", "int", parameter.kind)
    kind = re.sub(r"typing\.Literal\[[^]]*\]", "str", kind)
    return f"{parameter.name}: {_readable(kind)}"


def _value(value: Any) -> str:
    """Show a number or a str as it is, and any other value by its type."""
    plain = isinstance(value, (str, bytes, bool, int, float)) or value is None
    return text_of(value) if plain else type(value).__name__


def _values(given: tuple[Any, ...], named: dict[str, Any]) -> str:
    parts = [_value(value) for value in given]
    parts += [f"{name}={_value(value)}" for name, value in named.items()]
    return f"({', '.join(parts)})"
