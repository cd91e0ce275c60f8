"""What a panel consists of: `Control` and `Section`, which hold data and functions and draw nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

__all__ = ["KINDS", "Control", "Section"]

#: What a control may be, and what its value is in JSON.
KINDS = {
    "number": "a finite number",
    "integer": "a whole number",
    "flag": "True or False",
    "choice": "one of the choices",
    "color": '"#rrggbb", a CSS name, or numbers',
    "vector": "finite numbers",
    "text": "text",
    "button": "None",
}


@dataclass(frozen=True)
class Control:
    """One value that a person can read and change.

    Attributes
    ----------
    name : str
        The label: a property's own name, for example "opacity".
    kind : str
        "number", "integer", "flag", "choice", "color", "vector", "text" or "button".
    get : callable
        Gives today's value: a number, a bool, a str, or a list of numbers for a vector. A colour is "#rrggbb", as a
        colour picker shows it: the linear numbers of cubecam, clipped to 0..1 and encoded as sRGB (IEC 61966-2-1).
    set : callable
        Sets a value. It raises ValueError or TypeError as the property does, and then nothing has changed.
    low, high : float or None
        The range of a slider; None: the control has no slider. The property may take numbers outside this range.
    step : float or None
        The step of the slider; None: any number.
    logarithmic : bool
        Whether equal steps of the slider multiply the value; `low` is above 0 then.
    choices : tuple of str
        The words of a "choice".
    unit : str
        For example "degrees"; empty where the number has none.
    help : str
        What the property's docstring says.
    keep : callable or None
        Remembers today's value without rounding, and gives a function that brings it back. None: nothing to bring back.
    """

    name: str
    kind: str
    get: Callable[[], Any]
    set: Callable[[Any], object]
    low: float | None = None
    high: float | None = None
    step: float | None = None
    logarithmic: bool = False
    choices: tuple[str, ...] = ()
    unit: str = ""
    help: str = ""
    keep: Callable[[], Callable[[], object]] | None = None


@dataclass(frozen=True)
class Section:
    """Controls under one title; `open` says whether the section is unfolded at first."""

    title: str
    controls: tuple[Control, ...]
    open: bool = True
