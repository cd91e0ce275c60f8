"""Properties of a live view: each checks its value, has the view drawn after a change, and makes a panel's control."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING, Any, Generic, TypeVar, overload

from .._checks import one_of, real_number, truth
from .panel import Control

if TYPE_CHECKING:
    from .live import LiveView

__all__ = ["Setting", "choice", "flag", "number"]

T = TypeVar("T")


class Setting(Generic[T]):
    """One property of a live view, held in the view's `__dict__`; a control of a panel is made of the same facts."""

    def __init__(self, check: Callable[[str, Any], T], doc: str, **facts: Any) -> None:
        self._check, self._facts = check, facts
        self.__doc__ = doc

    def __set_name__(self, owner: type, name: str) -> None:
        """Remember the name that the property has in its class."""
        self._name = name

    @overload
    def __get__(self, view: None, owner: type) -> Setting[T]: ...
    @overload
    def __get__(self, view: LiveView, owner: type) -> T: ...
    def __get__(self, view: LiveView | None, owner: type) -> Setting[T] | T:
        """Give the value, or for the class the property itself."""
        if view is None:
            return self
        value: T = vars(view)[f"_{self._name}"]
        return value

    def __set__(self, view: LiveView, value: Any) -> None:
        """Check the value, keep it, and have the view drawn if it differs."""
        checked = self._check(self._name, value)
        before = vars(view).get(f"_{self._name}", _NOTHING)
        vars(view)[f"_{self._name}"] = checked
        if before is not _NOTHING and before != checked:
            view.changed()

    def control(self, view: LiveView, **facts: Any) -> Control:
        """Make the control for a panel; `facts` replace those of the property."""
        name = self._name

        def put(value: Any) -> None:
            # A panel has no None: its choice "none" stands for it.
            setattr(view, name, None if value == "none" else value)

        def today() -> Any:
            value = getattr(view, name)
            return "none" if value is None else value

        first = (self.__doc__ or "").split("\n")[0]
        return Control(name, get=today, set=put, **{"help": first, **self._facts, **facts})


_NOTHING = object()


def number(
    doc: str,
    low: float,
    high: float,
    *,
    slider: tuple[float, float] | None = None,
    unit: str = "",
    step: float | None = None,
    wraps: bool = False,
) -> Setting[float]:
    """Make a property of a finite number from `low` to `high`.

    `slider` is the range of the control, if narrower. With `wraps` a number is brought into low..high, high excluded.
    """

    def check(name: str, value: Any) -> float:
        given = real_number(value, name)
        if wraps and math.isfinite(given):
            return low + (given - low) % (high - low)
        if not low <= given <= high:  # NaN, too
            raise ValueError(f"{name}: expected {low:g} to {high:g}, got {given:g}")
        return given

    shown = slider or (low, high)
    return Setting(check, doc, kind="number", low=shown[0], high=shown[1], unit=unit, step=step)


def flag(doc: str) -> Setting[bool]:
    """Make a property that is True or False."""

    def check(name: str, value: Any) -> bool:
        return truth(value, name)

    return Setting(check, doc, kind="flag")


def choice(doc: str, names: Iterable[str | None]) -> Setting[Any]:
    """Make a property that is one of some names; None among them is "none" in a panel."""
    allowed = tuple(names)

    def check(name: str, value: Any) -> str | None:
        return one_of(value, name, allowed)  # type: ignore[no-any-return]

    return Setting(check, doc, kind="choice", choices=tuple(a or "none" for a in allowed))
