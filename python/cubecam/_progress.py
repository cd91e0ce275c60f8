"""A bar in the terminal for work that takes long."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

__all__ = ["bar"]

#: What takes less time than this has no bar: its library alone takes a tenth of a second to load.
_PATIENCE = 0.5  # seconds


@contextmanager
def bar(title: str, steps: int, show: bool | None) -> Iterator[Callable[..., None]]:
    """Give a function that advances a bar by some of `steps`: one, or the number that it is called with.

    Parameters
    ----------
    title : str
        What stands before the bar.
    steps : int
        How many there are.
    show : bool, optional
        True: at once. None: if the error stream is a terminal, and the work takes more than half a second.
    """
    if not (_in_terminal() if show is None else show):
        yield lambda _done=1: None
        return
    shown: Any = None
    task: Any = None
    start = time.monotonic()
    waiting = 0

    def advance(done: int = 1) -> None:
        nonlocal shown, task, waiting
        if shown is None:
            waiting += done
            if time.monotonic() - start < (0 if show else _PATIENCE):
                return
            from rich.console import Console
            from rich.progress import Progress

            shown = Progress(console=Console(stderr=True), transient=True)
            shown.start()
            task = shown.add_task(title, total=steps, completed=waiting)
            return
        shown.advance(task, done)

    try:
        yield advance
    finally:
        if shown is not None:
            shown.stop()


def _in_terminal() -> bool:
    """Find whether the error stream is a terminal; it may be missing, closed, or a notebook's."""
    try:
        return sys.stderr.isatty()
    except (AttributeError, ValueError):
        return False
