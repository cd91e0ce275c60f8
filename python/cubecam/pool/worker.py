"""The process that draws for a pool: it reads messages, draws pieces into shared memory, and answers."""

from __future__ import annotations

import os
import pickle
import queue
import sys
import threading
import traceback
import warnings
from collections import OrderedDict
from collections.abc import Callable
from contextlib import suppress
from typing import Any

from .._core import Renderer
from .._processes import Channel
from .memory import Arrays, Bytes, arranged, mapped
from .payload import load
from .work import Work

__all__ = ["Answer", "Desk", "Raised", "WorkerTraceback", "answered", "serve"]

Message = tuple[bytearray, list[int]]


class WorkerTraceback(Exception):
    """The traceback of a process that drew, as text: the cause of what the pool raises."""

    def __init__(self, text: str) -> None:
        super().__init__(text)
        self.text = text

    def __str__(self) -> str:
        return f'\n"""\n{self.text}"""'


class Raised:
    """What drawing raised, with its traceback as text."""

    def __init__(self, error: BaseException) -> None:
        self.text = "".join(traceback.format_exception(error))
        try:
            self.error: bytes | None = pickle.dumps(error)
            pickle.loads(self.error)
        except Exception:  # of a class that cannot travel
            self.error = None
        self.last_line = "".join(traceback.format_exception_only(error)).strip()

    def exception(self) -> BaseException:
        """Give the exception for the process that waits, with the traceback as its cause."""
        error: BaseException
        try:
            error = RuntimeError(self.last_line) if self.error is None else pickle.loads(self.error)
        except Exception:  # its class is not known here
            error = RuntimeError(self.last_line)
        error.__cause__ = WorkerTraceback(self.text)
        return error


#: What drawing raised, or None, and the warnings that it gave.
Answer = tuple[Raised | None, list[tuple[type[Warning], str]]]


def answered(draw: Callable[[], None]) -> Answer:
    """Draw, and keep warnings and what is raised."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        raised: Raised | None = None
        try:
            draw()
        except Exception as error:
            raised = Raised(error)
        except BaseException as error:  # SystemExit of the user's script must not end the caller
            raised = Raised(
                RuntimeError(f"expected a picture, got {error!r}").with_traceback(
                    error.__traceback__
                )
            )
    return raised, [(each.category, str(each.message)) for each in caught]


class Desk:
    """A renderer, with what it needs to draw pieces."""

    def __init__(self, options: dict[str, Any]) -> None:
        self._options = options
        self._renderer: Renderer | None = None
        self.things: OrderedDict[str, Any] = OrderedDict()

    @property
    def renderer(self) -> Renderer:
        """Renderer: made when it is first needed."""
        if self._renderer is None:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # the caller's own renderer has said it
                self._renderer = Renderer(**self._options)
        return self._renderer

    def load(self, token: str, data: bytes | bytearray | memoryview) -> None:
        """Load what is drawn; what fails is raised when it is drawn."""
        try:
            self.things[token] = load(data)
        except BaseException as error:
            self.things[token] = _Unloaded(error)

    def draw(self, token: str, work: Work, arrays: Arrays) -> None:
        """Draw a piece."""
        things = self.things[token]
        if isinstance(things, _Unloaded):
            raise things.error
        work.draw(self.renderer, things, arrays)


class _Unloaded:
    def __init__(self, error: BaseException) -> None:
        self.error = error


def serve(channel: Channel) -> None:
    """Be a worker, until the channel ends: then the process ends at once, whatever it draws."""
    messages: queue.SimpleQueue[Message] = queue.SimpleQueue()
    threading.Thread(target=_read, args=(channel, messages), daemon=True).start()
    channel.send(b"ready")
    options, _ = messages.get()
    desk = Desk(pickle.loads(options))
    memory: dict[int, Bytes] = {}
    while True:
        message, descriptors = messages.get()
        kind, *rest = pickle.loads(message)
        del message
        if kind == "load":
            data, _ = messages.get()
            desk.load(rest[0], data)
            del data
        elif kind == "forget":
            desk.things.pop(rest[0], None)
        elif kind == "open":
            memory[rest[0]] = _map(descriptors[0], rest[1])
        elif kind == "close":
            memory.pop(rest[0], None)
        else:
            number, layout, rows, row, count, token, work = rest
            arrays = [array[row : row + count] for array in arranged(memory[number], layout, rows)]
            answer = answered(lambda: desk.draw(token, work, arrays))  # noqa: B023
            del arrays, work
            for stream in (sys.stdout, sys.stderr):  # the process may be killed later
                with suppress(Exception):
                    stream.flush()
            channel.send(pickle.dumps(answer, protocol=5))


def _read(channel: Channel, messages: queue.SimpleQueue[Message]) -> None:
    while (message := channel.receive()) is not None:
        messages.put(message)
    os._exit(0)


def _map(descriptor: int, size: int) -> Bytes:
    try:
        return mapped(descriptor, size)
    finally:
        os.close(descriptor)
