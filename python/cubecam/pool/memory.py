"""Memory that processes share, and that is never left behind: it has no name, and ends with the last who has it."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .._core import _map_shared

__all__ = ["Layout", "Rows", "mapped"]

#: Shape and dtype of what arrays hold for one picture.
Layout = Sequence[tuple[tuple[int, ...], np.dtype[Any]]]

Arrays = list[npt.NDArray[Any]]

#: Arrays begin at multiples of this: a cache line.
_ALIGNED = 64


class Rows:
    """Arrays in shared memory that have a row for each of `count` pictures.

    The memory goes when no process has the descriptor or an array any more.
    """

    def __init__(self, layout: Layout, count: int) -> None:
        self.layout, self.count = layout, count
        self.descriptor = os.memfd_create("cubecam", os.MFD_CLOEXEC)
        try:
            os.ftruncate(self.descriptor, _size(layout, count))
            self.arrays = mapped(self.descriptor, layout, count)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the descriptor; the arrays stay."""
        if self.descriptor >= 0:
            os.close(self.descriptor)
        self.descriptor = -1


def mapped(descriptor: int, layout: Layout, count: int) -> Arrays:
    """Make arrays of shared memory; they do not need the descriptor."""
    memory = _map_shared(descriptor, _size(layout, count))
    arrays: Arrays = []
    begin = 0
    for shape, dtype in layout:
        size = _bytes(shape, dtype, count)
        arrays.append(memory[begin : begin + size].view(dtype).reshape(count, *shape))
        begin += _aligned(size)
    return arrays


def _bytes(shape: tuple[int, ...], dtype: np.dtype[Any], count: int) -> int:
    return count * math.prod(shape) * dtype.itemsize


def _aligned(size: int) -> int:
    return -(-size // _ALIGNED) * _ALIGNED


def _size(layout: Layout, count: int) -> int:
    return max(sum(_aligned(_bytes(shape, dtype, count)) for shape, dtype in layout), 1)
