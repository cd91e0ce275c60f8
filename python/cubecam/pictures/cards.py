"""What is shown of an object, as data: HTML and terminals are two ways to write the same card."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    import numpy.typing as npt

__all__ = ["Card", "Fact", "Row", "Shot", "count", "number", "shorten", "swatch_of", "vector"]

# A name or a message of any length must not make the output of a notebook large.
_LONGEST = 80


@dataclass(frozen=True)
class Shot:
    """A thumbnail: uint8 (H, W, 4) pixels, sRGB; or None and the reason in words."""

    pixels: npt.NDArray[np.uint8] | None
    problem: str = ""


@dataclass(frozen=True)
class Fact:
    """A line of a card: a name, a value in words, and a colour ("#rrggbb") to show beside the value."""

    name: str
    value: str
    swatch: str = ""


@dataclass(frozen=True)
class Row:
    """A line of a tree: a node, a light or a probe; `depth` is the number of its parents."""

    label: str
    text: str
    depth: int = 0
    swatch: str = ""
    faint: bool = False
    picture: Callable[[], Shot] | None = None


@dataclass
class Card:
    """Everything that is shown of one object.

    `picture` draws the thumbnail when it is called, so that a terminal without colours draws none. `diagram` is an SVG
    of HTML alone.
    """

    title: str
    facts: list[Fact] = field(default_factory=list)
    picture: Callable[[], Shot] | None = None
    diagram: str = ""
    note: str = ""
    tiles: list[Card] = field(default_factory=list)
    tiles_title: str = ""
    lists: list[tuple[str, list[Row]]] = field(default_factory=list)


def shorten(text: object, longest: int = _LONGEST) -> str:
    """Give a text of at most `longest` characters, in one line."""
    line = " ".join(str(text).split())
    return line if len(line) <= longest else line[: longest - 1] + "…"


def number(value: float) -> str:
    """Write a number with four digits: 0.05, 100, 1.5, 1e-07."""
    return f"{float(value):.4g}"


def vector(values: Iterable[float]) -> str:
    """Write a point, a direction or a colour."""
    return f"({', '.join(number(value) for value in values)})"


def count(number_of: int, thing: str) -> str:
    """Write a number with its noun: "1 node", "1,000 nodes"."""
    plural = thing[:-1] + "ies" if thing.endswith("y") else thing + "s"
    plural = "vertices" if thing == "vertex" else plural
    return f"{number_of:,} {thing if number_of == 1 else plural}"


def swatch_of(color: Any) -> str:
    """Give the "#rrggbb" of a linear colour, by the sRGB curve of IEC 61966-2-1; light above 1 is clipped."""
    linear = np.clip(np.asarray(color, np.float64)[:3], 0, 1)
    curve = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
    return "#" + "".join(f"{round(float(value) * 255):02x}" for value in curve)
