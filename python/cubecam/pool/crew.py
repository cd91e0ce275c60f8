"""The processes of a pool, and who draws what.

Each process has a seat: a thread of this process that gives it one piece after the other, and starts another one where
it dies. Callers wait for pieces in the order of their numbers.
"""

from __future__ import annotations

import os
import pickle
import threading
import weakref
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from .._core import ContextError, Error
from .._processes import Process, ending_of, leave_signals_to_others
from .._warnings import warn_at
from .calls import Call, Piece
from .memory import MemoryStore
from .payload import Payload
from .worker import Answer

__all__ = ["CLOSED", "Crew"]

CLOSED = "the pool is closed: expected an open Pool"
_FORKED = "this pool belongs to the parent process: expected a Pool made in this one, or a call before the fork"

_WORKER = "cubecam.pool.worker:serve"

#: How often a piece is given to another process after the one that drew it has died.
_TRIES = 3


class _Running:
    """A call that is not done."""

    def __init__(self, call: Call, store: MemoryStore) -> None:
        self.call = call
        self.memory, call.arrays = store.take(call.layout, call.rows)
        self.next = 0  # the piece that is given out next
        self.taken = 0  # pieces that the caller is done with
        self.under_way = 0
        self.done: dict[int, list[tuple[type[Warning], str]]] = {}  # warnings of pieces
        self.errors: dict[int, BaseException] = {}
        self.ended = False

    @property
    def is_whole(self) -> bool:
        """Whether all is drawn, so that no worker will write into the memory any more."""
        return self.next == self.call.pieces and not (self.under_way or self.errors or self.ended)

    def has_piece(self) -> bool:
        most = min(self.call.pieces, self.taken + self.call.window)
        return self.next < most and not self.ended and not self.errors


class Crew:
    """Worker processes; `options` are those of their renderers.

    `kept_bytes` is how much memory of results that are gone serves later ones.
    """

    def __init__(
        self, workers: int, options: dict[str, Any], environment: dict[str, str], kept_bytes: int
    ) -> None:
        self.options, self.environment = options, environment
        self.changed = threading.Condition()
        self.closed: str | None = None  # why
        self._calls: list[_Running] = []
        self._store = MemoryStore(kept_bytes)
        self._kept: str | None = None  # the token of the payload that may be used again
        self._seats: list[_Seat] = []
        _crews.add(self)
        try:
            for _ in range(workers):  # all processes start at the same time
                self._seats.append(_Seat(self))
        except BaseException:
            self.close()
            raise
        for seat in self._seats:
            seat.thread.start()

    @property
    def pids(self) -> list[int]:
        """list of int: the processes that live."""
        return [seat.process.pid for seat in self._seats if seat.process is not None]

    @contextmanager
    def pieces(self, call: Call) -> Iterator[Iterator[Piece]]:
        """Draw a call, and give its pieces in order; the caller has read a piece when it takes the next one.

        At the end of the block the call is done or dropped; after a Ctrl-C the processes that draw it are killed.
        """
        with self.changed:
            self._check_open()
            running = _Running(call, self._store)
        at_once = False
        try:
            with self.changed:
                self._calls.append(running)
                self.changed.notify_all()
            yield self._in_order(running)
        except (Exception, GeneratorExit):
            raise
        except BaseException:  # Ctrl-C
            at_once = True
            raise
        finally:
            self._end(running, at_once)

    def _in_order(self, running: _Running) -> Iterator[Piece]:
        for number in range(running.call.pieces):
            with self.changed:
                while number not in running.done:
                    if number in running.errors:  # those before it are done
                        running.ended = True
                        # Its traceback holds this frame, which must not hold it.
                        raise running.errors.pop(number)
                    self._check_open()
                    self.changed.wait()
                caught = running.done.pop(number)
            for category, text in caught:
                warn_at(running.call.line, text, category)
            yield running.call.piece(number)
            with self.changed:
                running.taken += 1
                self.changed.notify_all()

    def _end(self, running: _Running, at_once: bool) -> None:
        with self.changed:
            whole = running.is_whole and not at_once
            running.ended = True
            for seat in self._seats:
                if at_once and seat.draws is running and seat.process is not None:
                    seat.process.kill()
            self._store.done(running.memory, whole)
            if running in self._calls:
                self._calls.remove(running)
            if running.call.payload.reusable:
                self._kept = running.call.payload.token
            self.changed.notify_all()
            # What a caller of Ctrl-C gets back is all of the memory.
            self.changed.wait_for(lambda: not at_once or not running.under_way, 5)

    def _check_open(self) -> None:
        if self.closed is not None:
            raise ContextError(self.closed)

    def close(self) -> None:
        """End all processes, and wait for their ends."""
        with self.changed:
            if self.closed is None:
                self.closed = CLOSED
            self._store.clear()
            self.changed.notify_all()
            for seat in self._seats:
                seat.kill()
        for seat in self._seats:
            if seat.thread is threading.current_thread():
                continue
            if seat.thread.is_alive():
                seat.thread.join(10)
            else:  # never started
                seat.end()

    def abandon(self) -> None:
        """In a forked process: neither the threads nor the processes are its own."""
        self.changed = threading.Condition()
        self.closed = _FORKED
        for seat in self._seats:
            if seat.process is not None:
                seat.process.abandon()
        self._seats = []
        self._store.clear()

    # For seats, which hold the condition.

    def needs(self, token: str) -> bool:
        """Say whether a payload may be used again."""
        return token == self._kept or any(token == each.call.payload.token for each in self._calls)

    def uses(self, number: int) -> bool:
        """Say whether memory is that of a call, or may be that of a later one."""
        return self._store.has(number) or any(each.memory.number == number for each in self._calls)

    def next_piece(self) -> tuple[_Running, Piece] | None:
        """Give out a piece."""
        for running in self._calls:
            if running.has_piece():
                piece = running.call.piece(running.next)
                running.next += 1
                running.under_way += 1
                self._calls.remove(running)  # calls of several threads take turns
                self._calls.append(running)
                return running, piece
        return None


class _Seat:
    """A process, and the thread that tells it what to draw."""

    def __init__(self, crew: Crew) -> None:
        self._crew = crew
        self.process: Process | None = None
        self.draws: _Running | None = None
        self._loaded: set[str] = set()  # tokens of payloads
        self._opened: set[int] = set()  # numbers of memory
        self._ready = False  # whether the process has begun to read
        self.thread = threading.Thread(target=self._work, daemon=True, name="cubecam pool")
        self._start()

    def kill(self) -> None:
        """End the process."""
        if self.process is not None:
            self.process.kill()

    def _start(self) -> None:
        crew = self._crew
        process = Process(
            _WORKER,
            crew.environment,
            owner="Pool",
            instead="give it an executor, or use a Renderer",
        )
        process.channel.send(pickle.dumps(crew.options, protocol=5))
        with crew.changed:
            self.process = process
            self._loaded, self._opened, self._ready = set(), set(), False
            if crew.closed is not None:
                process.kill()

    def _work(self) -> None:
        leave_signals_to_others()
        try:
            while (given := self._next()) is not None:
                running, piece = given
                answer: Answer | None = None
                error: BaseException | None = None
                try:
                    answer = self._drawn(running, piece)
                except BaseException as raised:  # such as a process that cannot start
                    error = raised.with_traceback(None)  # it would hold the arrays
                self._note(running, piece, answer, error)
                del given, running, piece, answer, error
        finally:
            self.end()

    def end(self) -> None:
        """End the process, and wait for it."""
        with self._crew.changed:
            process, self.process = self.process, None
        if process is not None:
            process.end()

    def _next(self) -> tuple[_Running, Piece] | None:
        """Wait for a piece; meanwhile, let the process forget what nobody needs."""
        crew = self._crew
        while True:
            with crew.changed:
                given = None
                while True:
                    if crew.closed is not None:
                        return None
                    old = [each for each in self._loaded if not crew.needs(each)]
                    ended = [each for each in self._opened if not crew.uses(each)]
                    given = crew.next_piece()
                    if given is not None or old or ended:
                        break
                    crew.changed.wait()
                if given is not None:
                    self.draws = given[0]
            self._loaded -= set(old)
            self._opened -= set(ended)
            for token in old:
                self._send("forget", token)
            for number in ended:
                self._send("close", number)
            if given is not None:
                return given

    def _send(self, *message: Any, descriptors: tuple[int, ...] = ()) -> None:
        if self.process is not None:
            self.process.channel.send(pickle.dumps(message, protocol=5), descriptors)

    def _drawn(self, running: _Running, piece: Piece) -> Answer | None:
        """Let the process draw a piece; None if the call has ended meanwhile."""
        endings: tuple[list[str], list[str]] = ([], [])  # before it could draw, and while it drew
        while not running.ended:
            if self.process is not None and not self.process.lives:  # since the last piece
                self.end()
            if self.process is None:
                self._start()
            assert self.process is not None
            if not self._order(running, piece):
                return None
            if not self._ready:
                self._ready = self.process.channel.receive() is not None
            answer = self.process.channel.receive()
            if answer is not None:
                found: Answer = pickle.loads(answer[0])
                return found
            process, self.process = self.process, None
            endings[self._ready].append(ending_of(process.status()))
            process.channel.close()
            if self._crew.closed is not None or running.ended:
                return None
            _check_tries(running.call.title, piece, *endings)
        return None

    def _order(self, running: _Running, piece: Piece) -> bool:
        """Tell the process all that it needs for a piece, and to draw it; False if the call has ended."""
        call = running.call
        if call.payload.token not in self._loaded:
            self._load(call.payload)
        with self._crew.changed:  # so that the descriptor is not closed meanwhile
            if running.ended:
                return False
            memory = running.memory
            if memory.number not in self._opened:
                self._opened.add(memory.number)
                self._send("open", memory.number, memory.size, descriptors=(memory.descriptor,))
        work = call.work.part(piece.first, piece.count)
        place = (memory.number, call.layout, call.rows, call.row(piece), piece.count)
        self._send("draw", *place, call.payload.token, work)
        return True

    def _load(self, payload: Payload) -> None:
        assert self.process is not None
        self._send("load", payload.token)
        self.process.channel.send(payload.data)
        self._loaded.add(payload.token)

    def _note(
        self,
        running: _Running,
        piece: Piece,
        answer: Answer | None,
        error: BaseException | None,
    ) -> None:
        """Tell the caller what came of a piece."""
        if answer is not None and answer[0] is not None:
            error = answer[0].exception()
        with self._crew.changed:
            self.draws = None
            running.under_way -= 1
            if error is not None:
                running.errors[piece.number] = error
            elif answer is not None:
                running.done[piece.number] = answer[1]
            self._crew.changed.notify_all()


def _check_tries(title: str, piece: Piece, began: list[str], drew: list[str]) -> None:
    """Give up a piece that has ended several processes, and processes that end before they draw."""
    if len(drew) == _TRIES:
        raise Error(
            f"{title} {piece!r}: expected a worker process to draw them, got the end of {_TRIES} that "
            f"tried ({', '.join(drew)}); SIGKILL may come from the system where memory is short, "
            "SIGSEGV from the driver"
        )
    if len(began) == _TRIES:
        raise Error(
            f"Pool: expected worker processes to start, got the end of {_TRIES} before they could draw "
            f"({', '.join(began)}); what they wrote to the error stream says why"
        )


_crews: weakref.WeakSet[Crew] = weakref.WeakSet()


def _abandon_all() -> None:
    for crew in list(_crews):
        crew.abandon()


os.register_at_fork(after_in_child=_abandon_all)
