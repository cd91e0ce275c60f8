"""The pieces of a call, drawn by an executor of the user: results come back as arrays, from wherever it draws."""

from __future__ import annotations

import pickle
import threading
from collections import deque
from collections.abc import Iterator
from concurrent.futures import Executor, Future
from contextlib import contextmanager
from typing import Any

import numpy as np

from .._core import ContextError
from .calls import Call, Piece
from .crew import CLOSED
from .memory import Arrays, Layout
from .work import Work
from .worker import Desk

__all__ = ["Remote", "draw_piece"]

#: Payloads that a thread of an executor's worker keeps.
_MOST_THINGS = 2


class Remote:
    """Draws by an executor; `at_once` is the number of pieces that are submitted at a time."""

    def __init__(self, executor: Executor, options: dict[str, Any], at_once: int) -> None:
        self._executor, self._at_once = executor, at_once
        self._options = pickle.dumps(options, protocol=5)
        self._closed = False

    @contextmanager
    def pieces(self, call: Call) -> Iterator[Iterator[Piece]]:
        """Draw a call, and give its pieces in order; the caller has read a piece when it takes the next one."""
        self._check_open()
        call.arrays = [np.empty((call.rows, *shape), dtype) for shape, dtype in call.layout]
        waiting: deque[tuple[Piece, Future[Arrays | None]]] = deque()
        try:
            yield self._in_order(call, waiting)
        finally:
            for _, future in waiting:
                future.cancel()

    def _in_order(
        self, call: Call, waiting: deque[tuple[Piece, Future[Arrays | None]]]
    ) -> Iterator[Piece]:
        data = bytes(call.payload.data)
        ahead = min(self._at_once, call.window)
        submitted = 0
        for _ in range(call.pieces):
            while submitted < call.pieces and len(waiting) < ahead:
                # The first ones bring the scene; a worker that lacks it later asks for it.
                given = data if submitted < self._at_once else None
                piece = call.piece(submitted)
                waiting.append((piece, self._submit(call, piece, given)))
                submitted += 1
            self._check_open()
            piece, future = waiting[0]
            arrays = future.result()
            if arrays is None:
                waiting[0] = piece, self._submit(call, piece, data)
                arrays = waiting[0][1].result()
                assert arrays is not None  # the piece brought its scene
            waiting.popleft()
            del future
            for array, values in zip(call.arrays_of(piece), arrays, strict=True):
                array[:] = values
            del arrays
            yield piece

    def _submit(self, call: Call, piece: Piece, data: bytes | None) -> Future[Arrays | None]:
        return self._executor.submit(
            draw_piece,
            self._options,
            call.payload.token,
            data,
            call.work.part(piece.first, piece.count),
            list(call.layout),
            piece.count,
        )

    def _check_open(self) -> None:
        if self._closed:
            raise ContextError(CLOSED)

    def close(self) -> None:
        """Draw no more. The executor is the user's own."""
        self._closed = True


_here = threading.local()


def draw_piece(
    options: bytes, token: str, data: bytes | None, work: Work, layout: Layout, count: int
) -> Arrays | None:
    """Draw a piece in a worker of an executor; None if it lacks the scene, and no `data` brings it.

    Each thread that draws has a renderer of its own.
    """
    desk = _desk(options)
    if token not in desk.things:
        if data is None:
            return None
        desk.load(token, data)
    desk.things.move_to_end(token)
    while len(desk.things) > _MOST_THINGS:
        desk.things.popitem(last=False)
    arrays: Arrays = [np.empty((count, *shape), dtype) for shape, dtype in layout]
    desk.draw(token, work, arrays)
    return arrays


def _desk(options: bytes) -> Desk:
    desk: Desk | None = getattr(_here, "desk", None)
    if desk is None or _here.options != options:
        desk = _here.desk = Desk(pickle.loads(options))
        _here.options = options
    return desk
