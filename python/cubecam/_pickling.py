"""What pickles call. A function of Python is pickled by its name; one of the core would be by an expression."""

from __future__ import annotations

from typing import Any

from . import _core

__all__ = ["remake"]


def remake(version: int, kind: type, arguments: Any) -> Any:
    """Make an object anew of arguments by position (a tuple) or by name (a dict); refuse pickles of other versions."""
    _core._check_pickle(version)
    return kind(**arguments) if isinstance(arguments, dict) else kind(*arguments)
