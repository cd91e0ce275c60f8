"""Draws the pieces of a picture in this process or in several others (`_processes`)."""

from __future__ import annotations

import pickle
import queue
import threading
from collections.abc import Iterator, Sequence
from types import TracebackType
from typing import TYPE_CHECKING, Any

from .._processes import Channel, Process, ending_of

if TYPE_CHECKING:
    from typing_extensions import Self

    from .arrays import Array
    from .paths.tracer import Tracer
    from .work import Job, Piece

#: Each process has one thread.
_ENVIRONMENT = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"}


class Workers:
    """A number of processes that draw pieces of one picture; 1: this process, by the job's `tracer` if it was made.

    Use it in ``with``: at its end, also at that by an exception, the processes are ended.
    """

    def __init__(self, job: Job, processes: int, tracer: Tracer | None = None) -> None:
        self._job, self._count = job, processes
        self._own = (tracer or job.tracer()) if processes == 1 else None
        self._processes: list[Process] = []

    def __enter__(self) -> Self:
        if self._own is None:
            try:
                self._start()
            except BaseException:  # `with` does not end what could not begin
                self._end()
                raise
        return self

    def _start(self) -> None:
        job = pickle.dumps(self._job, protocol=5)
        for _ in range(self._count):
            process = Process(
                "cubecam.truth.workers:serve",
                _ENVIRONMENT,
                owner="truth",
                instead="processes=1 draws without others",
            )
            self._processes.append(process)
        for process in self._processes:  # only now, so that all of them start at the same time
            process.channel.send(job)

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
            process.end()

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
    process: Process,
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
            process.channel.send(pickle.dumps(piece, protocol=5))
            answer = process.channel.receive()
            if answer is None:
                raise RuntimeError(
                    f"truth: a worker process ended with {ending_of(process.status())}; "
                    "expected it to draw its part of the picture"
                )
            result = pickle.loads(answer[0])
            if isinstance(result, BaseException):
                raise result
            finished.put((piece, result))
    except BaseException as error:
        finished.put(error)


def serve(channel: Channel) -> None:
    """Be a worker process: get a job, then pieces, and give what was drawn, until the channel ends."""
    first = channel.receive()
    if first is None:
        return
    from .work import drawn

    job = pickle.loads(first[0])
    tracer = job.tracer()
    while (message := channel.receive()) is not None:
        try:
            answer: object = drawn(job, tracer, pickle.loads(message[0]))
        except Exception as error:
            answer = error
        channel.send(pickle.dumps(answer, protocol=5))
