"""Warnings that point at the user's own line."""

from __future__ import annotations

import sys
import warnings
from pathlib import Path

__all__ = [
    "ConventionWarning",
    "RendererWarning",
    "SceneWarning",
    "UsersLine",
    "warn_at",
    "warn_user",
]

_PACKAGE = str(Path(__file__).resolve().parent)


class ConventionWarning(UserWarning):
    """A file that cubecam wrote in one convention is read as if it were in another one."""

    __module__ = "cubecam"


class RendererWarning(UserWarning):
    """A renderer did what a call wanted in another way than usual, such as with a new context after a lost one.

    Examples
    --------
    >>> import warnings
    >>> import cubecam as cc
    >>> with warnings.catch_warnings():
    ...     warnings.simplefilter("error", cc.RendererWarning)  # a call that gives the warning fails instead
    ...     with cc.Renderer(device="software") as renderer:
    ...         cube = renderer.capture(cc.Scene(), size=4)
    >>> cube.faces.shape
    (6, 4, 4, 4)
    """

    __module__ = "cubecam"


class SceneWarning(UserWarning):
    """A part of a scene's file is left out, since cubecam cannot read it and the rest makes sense without it.

    `Scene.to_mitsuba` gives it for what Mitsuba cannot say.
    """

    __module__ = "cubecam"


def warn_user(text: str, category: type[Warning]) -> None:
    """Warn at the first line outside this package that led to the call."""
    level, frame = 1, sys._getframe(0)
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        level, frame = level + 1, frame.f_back
    warnings.warn(text, category, stacklevel=level)


class UsersLine:
    """The first line outside this package that led to a call, for warnings that come later."""

    def __init__(self) -> None:
        frame = sys._getframe(1)
        while frame.f_back is not None and frame.f_code.co_filename.startswith(_PACKAGE):
            frame = frame.f_back
        self.file, self.line = frame.f_code.co_filename, frame.f_lineno
        self.names = frame.f_globals


def warn_at(line: UsersLine, text: str, category: type[Warning]) -> None:
    """Warn at a user's line, from whatever thread."""
    module = line.names.get("__name__") or "<string>"
    registry = line.names.setdefault("__warningregistry__", {})
    warnings.warn_explicit(text, category, line.file, line.line, module, registry)
