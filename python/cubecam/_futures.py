"""Calls of a renderer that a thread draws later: the futures, and the thread.

Each renderer with such calls has a thread of its own, which is made for the first of them and ends when it has had
nothing to do for a second. It is a daemon: at the interpreter's end it sleeps wherever it is. docs/adr/0034 has the
reasons.
"""

from __future__ import annotations

import atexit
import os
import sys
import threading
import weakref
from collections import deque
from concurrent.futures import Future
from typing import TYPE_CHECKING, Any, TypeVar

from . import _core
from ._core import ContextError, Error
from ._processes import leave_signals_to_others
from ._warnings import RendererWarning, UsersLine, warn_at

if TYPE_CHECKING:
    from collections.abc import Generator

__all__ = ["PictureFuture", "end", "submit"]

T = TypeVar("T")

#: How many calls of a renderer can wait to be drawn. Each holds a snapshot of its scene.
_MOST_WAITING = 64

#: After so many seconds without a call the thread of a renderer ends.
_IDLE = 1.0


class PictureFuture(Future[T]):
    """A picture that a renderer will have drawn: the future that `render_async` and `capture_async` return.

    It is a `concurrent.futures.Future`, so that ``result(timeout)``, ``exception(timeout)``, ``done()``, ``cancel()``,
    ``add_done_callback()``, `concurrent.futures.wait` and `concurrent.futures.as_completed` work, and it can be awaited
    in any running loop of asyncio. Programs do not make one.

    ``cancel()`` succeeds as long as the call waits; a picture that is being drawn is finished. A Ctrl-C ends the wait
    in ``result()``, and the call goes on. Callbacks are called by the thread that draws: what takes long there delays
    the next picture. A call of the same renderer in a callback is drawn at once, before those that wait.

    Examples
    --------
    >>> import cubecam as cc
    >>> with cc.Renderer() as renderer:
    ...     future = renderer.capture_async(cc.Scene(), size=4)
    ...     cube = future.result(timeout=60)
    >>> cube.faces.shape, future.done()
    ((6, 4, 4, 4), True)
    """

    __module__ = "cubecam"

    def __init__(self) -> None:
        super().__init__()
        self._process = os.getpid()
        self._delivered = False

    def result(self, timeout: float | None = None) -> T:
        """Wait for the picture, and return it.

        Parameters
        ----------
        timeout : float or None
            Seconds. None: as long as it takes.

        Returns
        -------
        Frame or CubeMap

        Raises
        ------
        TimeoutError
            If the picture is not there in time; `concurrent.futures.TimeoutError` before Python 3.11.
        CancelledError
            If the call was cancelled; of `concurrent.futures`.
        ContextError
            In a process that was forked before the picture was there. All that drawing raises is raised here, too.
        """
        self._check_process()
        return super().result(timeout)

    def exception(self, timeout: float | None = None) -> BaseException | None:
        """Wait for the end of the call, and return what it raised.

        Parameters
        ----------
        timeout : float or None
            Seconds. None: as long as it takes.

        Returns
        -------
        BaseException or None
            None if there is a picture.

        Raises
        ------
        TimeoutError, CancelledError, ContextError
            As `result` raises.
        """
        self._check_process()
        return super().exception(timeout)

    def __await__(self) -> Generator[Any, None, T]:
        """Wait in the running loop of asyncio. Cancelling what waits cancels a call that has not begun."""
        import asyncio

        self._check_process()
        return asyncio.wrap_future(self, loop=asyncio.get_running_loop()).__await__()

    def _check_process(self) -> None:
        if self._process != os.getpid() and not self._delivered:
            raise ContextError(
                "this picture is drawn in the parent process: expected a wait for it before the fork, or there"
            )


class _Call:
    """A call that is not done."""

    def __init__(self, call: _core._LaterCall, size: int) -> None:
        self.call: _core._LaterCall | None = call
        self.size = size  # bytes of the result
        self.future: PictureFuture[Any] = PictureFuture()
        self.line = UsersLine()
        self.error: BaseException | None = None
        self.travels = False

    def cancel(self) -> None:
        """Drop a call that has not begun."""
        self.call = None
        if self.future.cancel():
            self.future.set_running_or_notify_cancel()
        self.future._delivered = True

    def draw(self) -> bool:
        """Draw, and note an error; False if the call was cancelled."""
        if not self.future.set_running_or_notify_cancel():
            self.call = None
            self.future._delivered = True
            return False
        assert self.call is not None
        try:
            self.travels = not self.call.draw()
        except BaseException as error:
            self._fail(error)
        self._warn()
        return True

    def deliver(self) -> None:
        """Set what the future gives."""
        result = None
        self.travels = False
        if self.error is None:
            assert self.call is not None
            try:
                result = self.call.result()
            except BaseException as error:
                self._fail(error)
            self._warn()
        self.call = None  # a renderer that nobody has any more ends here
        try:
            if self.error is not None:
                self.future.set_exception(self.error)
            else:
                self.future.set_result(result)
        except BaseException:  # of a callback; concurrent.futures itself reports an Exception
            sys.excepthook(*sys.exc_info())
        self.future._delivered = True
        self.error = None

    def _fail(self, error: BaseException) -> None:
        # A traceback would close a circle: it holds a frame, which holds the future, which holds the error.
        self.error = self.error or error.with_traceback(None)

    def _warn(self) -> None:
        assert self.call is not None
        for text in self.call.notices:
            try:
                warn_at(self.line, text, RendererWarning)
            except BaseException as error:  # a filter wants an error; that of the call comes first
                self._fail(error)


class _Calls:
    """The calls of one renderer that are not done, and the thread that draws them."""

    def __init__(self) -> None:
        # Its lock may be taken twice by one thread: a signal handler may make a call inside a call.
        self.changed = threading.Condition()
        self.waiting: deque[_Call] = deque()
        self.unfinished = 0
        self.size = 0  # bytes of their results
        self.thread: threading.Thread | None = None
        self.taken: _Call | None = None  # by the thread, the last one

    def submit(self, call: _core._LaterCall, size: int, may_wait: bool) -> PictureFuture[Any]:
        with self.changed:
            self._make_room(size, may_wait)
            if _ended:
                raise Error("expected a call before the interpreter ends, got one while it ends")
            if self.thread is None:
                thread = threading.Thread(target=self._serve, daemon=True, name="cubecam renderer")
                thread.start()
                self.thread = thread
            made = _Call(call, size)
            call.join_line()
            self.waiting.append(made)
            self.unfinished += 1
            self.size += size
            self.changed.notify_all()
            return made.future

    def _make_room(self, size: int, may_wait: bool) -> None:
        """Wait until few calls wait, and the memory has room for all results that are not there yet."""
        while True:
            if len(self.waiting) < _MOST_WAITING or not may_wait:
                try:
                    what = f"the results of {self.unfinished + 1} calls that are not done"
                    _core._check_memory(self.size + size, what)
                    return
                except ValueError:
                    if not self.unfinished or not may_wait:
                        raise
            self.changed.wait()

    def end(self, drop: bool, wait: bool) -> None:
        """Wait until all calls are done; `drop`: cancel those that have not begun."""
        dropped = []
        with self.changed:
            if drop:
                dropped = list(self.waiting)
                self.waiting.clear()
                self._count_out(dropped)
        for call in dropped:  # their callbacks may make calls
            call.cancel()
        with self.changed:
            while wait and self.unfinished and not _ended:
                self.changed.wait()

    def _count_out(self, calls: list[_Call]) -> None:
        with self.changed:
            self.unfinished -= len(calls)
            self.size -= sum(call.size for call in calls)
            self.changed.notify_all()

    def _serve(self) -> None:
        leave_signals_to_others()
        travelling: _Call | None = None
        while True:
            call = self._next(at_once=travelling is not None)
            if call is None and travelling is None:
                return
            if call is not None and not call.draw():
                self._count_out([call])
                call = None
            if travelling is not None:
                self._deliver(travelling)
                travelling = None
            if call is not None and call.travels:
                travelling = call
            elif call is not None:
                self._deliver(call)
            self.taken = call = None  # it must not live until the next one comes

    def _next(self, at_once: bool) -> _Call | None:
        """Take the next call; None if there is none for long, or now, and then the thread is to end or to deliver."""
        with self.changed:
            if not self.waiting and not at_once:
                self.changed.wait_for(lambda: self.waiting, _IDLE)
            if self.waiting:
                self.changed.notify_all()
                self.taken = self.waiting.popleft()
                return self.taken
            if not at_once:
                self.thread = None
            return None

    def _deliver(self, call: _Call) -> None:
        try:
            call.deliver()
        finally:
            self._count_out([call])


_calls: weakref.WeakKeyDictionary[_core.Renderer, _Calls] = weakref.WeakKeyDictionary()
_ended = False


def submit(
    renderer: _core.Renderer, call: _core._LaterCall, size: int, may_wait: bool
) -> PictureFuture[Any]:
    """Let a call be drawn by the renderer's thread; its result takes `size` bytes."""
    calls = _calls.get(renderer)
    if calls is None:
        calls = _calls.setdefault(renderer, _Calls())
    return calls.submit(call, size, may_wait)


def end(renderer: _core.Renderer, drop: bool, wait: bool) -> None:
    """End the calls of a renderer that is about to close."""
    calls = _calls.get(renderer)
    if calls is not None:
        calls.end(drop, wait)


def _end_all() -> None:
    """At the interpreter's end: nobody draws what waits, and nobody may wait for it."""
    global _ended
    _ended = True
    for calls in list(_calls.values()):
        calls.end(drop=True, wait=False)
        taken = calls.taken
        if taken is not None and taken.call is not None:
            taken.call.leave_line()  # the thread may sleep before it draws


atexit.register(_end_all)
os.register_at_fork(after_in_child=_calls.clear)  # their thread is not there, and may hold a lock
