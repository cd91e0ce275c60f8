"""The thread that sees what changed elsewhere in the process, for all live views that are shown."""

from __future__ import annotations

import os
import threading
import time
import weakref
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .live import LiveView

__all__ = ["watch"]

#: Seconds between two looks of the watching thread.
WATCH = 0.025


class _Watcher:
    """One thread for all views that are shown; it ends when there are none."""

    def __init__(self) -> None:
        self._views: weakref.WeakSet[LiveView] = weakref.WeakSet()
        self._lock = threading.Lock()
        self._thread: threading.Thread | None = None

    def watch(self, view: LiveView) -> None:
        with self._lock:
            self._views.add(view)
            if self._thread is None or not self._thread.is_alive():
                self._thread = threading.Thread(target=self._run, name="cubecam views", daemon=True)
                self._thread.start()

    def _run(self) -> None:
        while True:
            time.sleep(WATCH)
            with self._lock:
                views = [view for view in self._views if not view.closed and view._canvases]
                if not views:
                    self._thread = None
                    return
            for view in views:
                try:
                    view._watch()
                except Exception as error:  # the other views go on
                    view._report(error)
            del view, views

    def after_fork(self) -> None:
        """Begin anew in a child process, which has no thread, and a lock that nobody opens."""
        self.__init__()  # type: ignore[misc]


_watcher = _Watcher()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_watcher.after_fork)


def watch(view: LiveView) -> None:
    """Watch a view until it is closed, is shown nowhere, or is gone."""
    _watcher.watch(view)
