"""What can be set in a live view, as data."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

__all__ = ["Control", "Section"]


@dataclass(frozen=True)
class Control:
    """One thing that can be set."""

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


@dataclass(frozen=True)
class Section:
    """Controls that belong together."""

    title: str
    controls: tuple[Control, ...]
    open: bool = True
