"""Draws the pieces of a picture in this process or in several others.

The others are plain Python processes that read pickles from a pipe, not those of `multiprocessing`: these would run the
user's script again in each of them, unless it is written for that.
"""

from __future__ import annotations

import os
import pickle
import queue
import struct
import subprocess
import sys
import threading
from collections.abc import Iterator, Sequence
from contextlib import suppress
from types import TracebackType
from typing import IO, TYPE_CHECKING, Any

if TYPE_CHECKING:
    from typing_extensions import Self

    from .arrays import Array
    from .paths.tracer import Tracer
    from .work import Job, Piece

_SIZE = struct.Struct("<Q")
_START = "import sys; sys.path[:] = {path!r}; from cubecam.truth.workers import serve; serve()"


def interpreter() -> str | None:
    """Find the program that runs Python: None in a frozen program or where `sys.executable` is empty."""
    return None if getattr(sys, "frozen", False) else sys.executable or None


class Workers:
    """A number of processes that draw pieces of one picture; 1: this process, by the job's `tracer` if it was made.

    Use it in ``with``: at its end, also at that by an exception, the processes are ended.
    """

    def __init__(self, job: Job, processes: int, tracer: Tracer | None = None) -> None:
        self._job, self._count = job, processes
        self._own = (tracer or job.tracer()) if processes == 1 else None
        self._processes: list[subprocess.Popen[bytes]] = []

    def __enter__(self) -> Self:
        if self._own is None:
            try:
                self._start()
            except BaseException:  # `with` does not end what could not begin
                self._end()
                raise
        return self

    def _start(self) -> None:
        program = interpreter()
        if program is None:
            raise RuntimeError(
                f"truth: expected sys.executable to name the Python of {self._count} processes, got "
                f"{sys.executable!r} in {'a frozen' if hasattr(sys, 'frozen') else 'this'} program; "
                "processes=1 draws without others"
            )
        path = [each for each in sys.path if isinstance(each, str)]  # Python ignores all else
        job = pickle.dumps(self._job, protocol=5)
        for _ in range(self._count):
            process = subprocess.Popen(
                [program, "-c", _START.format(path=path)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                start_new_session=True,  # Ctrl-C is for this process alone
                env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"},
            )
            self._processes.append(process)
        for process in self._processes:  # only now, so that all of them start at the same time
            _send(process, job)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._end()

    def _end(self) -> None:
        for process in self._processes:
            process.kill()
        for process in self._processes:
            process.wait()
            for pipe in (process.stdin, process.stdout):
                if pipe is not None:
                    with suppress(OSError):
                        pipe.close()

    def draw(self, pieces: Sequence[Piece]) -> Iterator[tuple[Piece, tuple[Array, Array]]]:
        """Give each piece with its sums, in the order in which they are finished."""
        if self._own is not None:
            from .work import drawn

            for piece in pieces:
                yield piece, drawn(self._job, self._own, piece)
            return
        waiting: queue.SimpleQueue[Piece] = queue.SimpleQueue()
        finished: queue.SimpleQueue[Any] = queue.SimpleQueue()
        for piece in pieces:
            waiting.put(piece)
        for process in self._processes:
            threading.Thread(target=_feed, args=(process, waiting, finished), daemon=True).start()
        for _ in pieces:
            result = finished.get()
            if isinstance(result, BaseException):
                raise result
            yield result


def _feed(
    process: subprocess.Popen[bytes],
    waiting: queue.SimpleQueue[Piece],
    finished: queue.SimpleQueue[Any],
) -> None:
    """Hand one piece after the other to a process, and its answers to the caller."""
    try:
        while True:
            try:
                piece = waiting.get_nowait()
            except queue.Empty:
                return
            _send(process, pickle.dumps(piece, protocol=5))
            assert process.stdout is not None
            answer = _read(process.stdout)
            if answer is None:
                raise RuntimeError(
                    f"truth: a worker process ended with the status {process.wait()}; "
                    "expected it to draw its part of the picture"
                )
            result = pickle.loads(answer)
            if isinstance(result, BaseException):
                raise result
            finished.put((piece, result))
    except BaseException as error:
        finished.put(error)


def serve() -> None:
    """Be a worker process: read a job, then pieces, and write what was drawn, until the pipe ends."""
    source, target = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # what a library prints must not get between the answers
    first = _read(source)
    if first is None:
        return
    from .work import drawn

    job = pickle.loads(first)
    tracer = job.tracer()
    while (message := _read(source)) is not None:
        try:
            answer: object = drawn(job, tracer, pickle.loads(message))
        except Exception as error:
            answer = error
        data = pickle.dumps(answer, protocol=5)
        try:
            target.write(_SIZE.pack(len(data)) + data)
            target.flush()
        except BrokenPipeError:  # the caller was killed: nobody wants the picture
            os._exit(1)


def _send(process: subprocess.Popen[bytes], data: bytes) -> None:
    assert process.stdin is not None
    with suppress(BrokenPipeError):  # its end is noticed when its answer is read
        process.stdin.write(_SIZE.pack(len(data)) + data)
        process.stdin.flush()


def _read(source: IO[bytes]) -> bytes | None:
    """Read one message; None at the end of the pipe."""
    size = source.read(_SIZE.size)
    if len(size) < _SIZE.size:
        return None
    data = source.read(_SIZE.unpack(size)[0])
    return data if len(data) == _SIZE.unpack(size)[0] else None
