"""The function that pickles call. It is written in Python since pickle stores such a function by its name."""

from __future__ import annotations

from typing import Any

from . import _core

__all__ = ["remake"]


def remake(version: int, kind: type, arguments: Any) -> Any:
    """Make an object from arguments by position (a tuple) or by name (a dict); raise TypeError for other formats."""
    _core._check_pickle(version)
    return kind(**arguments) if isinstance(arguments, dict) else kind(*arguments)
