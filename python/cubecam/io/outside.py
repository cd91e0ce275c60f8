"""Long calls of compiled libraries: Ctrl-C ends the wait for them, and the interpreter does not end before them.

Such a library gives Python's lock away while it works. Python 3.10 to 3.13 end a daemon thread that wants the lock back
when the interpreter ends by an unwinding that C++ libraries do not survive: the process would abort. So the interpreter
does not end before such calls, and none begins after that in another thread.
"""

from __future__ import annotations

import atexit
import functools
import os
import threading
from typing import TYPE_CHECKING, ParamSpec, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable

__all__ = ["calls_outside", "calls_run", "interruptible"]

P = ParamSpec("P")
T = TypeVar("T")

#: How long the interpreter waits at its end, in seconds.
_LONGEST_WAIT = 60.0


class _Calls:
    """The calls that are inside a library."""

    def __init__(self) -> None:
        self.changed = threading.Condition()
        self.running = 0
        self.ending = False

    def __enter__(self) -> None:
        with self.changed:
            if threading.current_thread() is not threading.main_thread():
                self.changed.wait_for(
                    lambda: not self.ending
                )  # for ever, once the interpreter ends
            self.running += 1

    def __exit__(self, *_: object) -> None:
        with self.changed:
            self.running -= 1
            self.changed.notify_all()

    def end(self) -> None:
        """Let no other thread begin a call, and wait for those that run."""
        with self.changed:
            self.ending = True
            self.changed.wait_for(lambda: self.running == 0, _LONGEST_WAIT)


_calls = _Calls()


def _forget_other_threads() -> None:
    _calls.__init__()  # type: ignore[misc] # in a forked child, no thread is inside a call


atexit.register(lambda: _calls.end())
os.register_at_fork(after_in_child=_forget_other_threads)


def calls_run() -> bool:
    """Whether a call is inside such a library: the end of the interpreter would wait for it."""
    return _calls.running > 0


def calls_outside(function: Callable[P, T]) -> Callable[P, T]:
    """Make the interpreter wait at its end for calls of a function that calls such a library."""

    @functools.wraps(function)
    def guarded(*args: P.args, **kwargs: P.kwargs) -> T:
        with _calls:
            return function(*args, **kwargs)

    return guarded


def interruptible(function: Callable[P, T], *args: P.args, **kwargs: P.kwargs) -> T:
    """Call a function that may take long so that signals, for example Ctrl-C, are handled meanwhile.

    In the main thread, which handles signals, the function runs in a thread of its own. When a signal handler raises,
    the wait ends, and the function works on in vain.
    """
    if threading.current_thread() is not threading.main_thread():
        return function(*args, **kwargs)
    done = threading.Event()
    results: list[T] = []
    errors: list[BaseException] = []

    def work() -> None:
        try:
            results.append(function(*args, **kwargs))
        except BaseException as error:
            errors.append(error)
        finally:
            done.set()

    threading.Thread(target=work, daemon=True, name="cubecam").start()
    while not done.wait(
        0.1
    ):  # a signal that the system gives to another thread does not end a wait
        pass
    if errors:
        raise errors[0]
    return results[0]
