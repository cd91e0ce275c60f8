"""A bar in the terminal for work that takes long."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from contextlib import contextmanager


@contextmanager
def bar(steps: int, show: bool | None) -> Iterator[Callable[[], None]]:
    """Give a function that advances a bar by one of `steps`; `show` None: if the error stream is a terminal."""
    if not (_in_terminal() if show is None else show):
        yield lambda: None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as progress:
        task = progress.add_task("exact rays", total=steps)
        yield lambda: progress.advance(task)


def _in_terminal() -> bool:
    """Find whether the error stream is a terminal; it may be missing, closed, or a notebook's."""
    try:
        return sys.stderr.isatty()
    except (AttributeError, ValueError):
        return False
