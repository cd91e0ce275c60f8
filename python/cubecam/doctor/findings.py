"""What the doctor finds, as data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

__all__ = ["Finding", "Status"]

Status: TypeAlias = Literal["ok", "note", "warning", "problem"]


@dataclass(frozen=True)
class Finding:
    """One thing that was looked at.

    Attributes
    ----------
    name : str
        What was looked at, in a word or two that do not change: "egl-library".
    status : {"ok", "note", "warning", "problem"}
        "problem": it prevents drawing. "warning": something is wrong or is not used, and pictures can be drawn. "note":
        a fact that may explain something.
    text : str
        What was found.
    cure : tuple of str
        What mends it: commands of a shell, each a line, among which a line that begins with "#" explains.
    """

    name: str
    status: Status
    text: str
    cure: tuple[str, ...] = ()
