"""A call of a pool: what is drawn, in which pieces, and how far it is."""

from __future__ import annotations

from .._warnings import UsersLine
from .memory import Arrays, Layout
from .payload import Payload
from .work import Work

__all__ = ["Call", "Piece"]


class Piece:
    """Some pictures of a call, one after the other."""

    def __init__(self, number: int, first: int, count: int) -> None:
        self.number, self.first, self.count = number, first, count

    def __repr__(self) -> str:
        last = self.first + self.count - 1
        return f"{self.first}" if self.count == 1 else f"{self.first} to {last}"


class Call:
    """What is drawn, and its pieces.

    Parameters
    ----------
    work : Work
        All of it.
    payload : Payload
        What workers load once.
    layout : Layout
        The arrays.
    count, step : int
        The number of pictures, and how many make a piece.
    window : int, optional
        The number of pieces for which the arrays have room; the caller is done with one before another takes its place.
        None: all.
    title : str
        What the pictures are called: "captures", "frames", "scenes".
    """

    def __init__(
        self,
        work: Work,
        payload: Payload,
        layout: Layout,
        count: int,
        step: int,
        *,
        title: str,
        window: int | None = None,
    ) -> None:
        self.work, self.payload, self.layout = work, payload, layout
        self.count, self.step, self.title = count, step, title
        self.pieces = -(-count // step)
        self.window = self.pieces if window is None else min(window, self.pieces)
        self.arrays: Arrays = []
        self.line = UsersLine()

    @property
    def rows(self) -> int:
        """int: the pictures for which the arrays have room."""
        return min(self.window * self.step, self.count)

    def piece(self, number: int) -> Piece:
        """Give a piece."""
        first = number * self.step
        return Piece(number, first, min(self.step, self.count - first))

    def row(self, piece: Piece) -> int:
        """Give the first row of a piece in the arrays."""
        return piece.number % self.window * self.step

    def arrays_of(self, piece: Piece) -> Arrays:
        """Give the part of the arrays that a piece fills."""
        row = self.row(piece)
        return [array[row : row + piece.count] for array in self.arrays]
