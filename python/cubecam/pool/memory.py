"""Memory that processes share, and that is never left behind: it has no name, and ends with the last who has it."""

from __future__ import annotations

import itertools
import math
import os
import weakref
from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from typing import Any

import numpy as np
import numpy.typing as npt

from .._core import _map_shared

__all__ = ["Arrays", "Bytes", "Layout", "Memory", "MemoryStore", "arranged", "mapped", "size_of"]

#: Shape and dtype of what arrays hold for one picture.
Layout = Sequence[tuple[tuple[int, ...], np.dtype[Any]]]

Arrays = list[npt.NDArray[Any]]
Bytes = npt.NDArray[np.uint8]

#: Arrays begin at multiples of this: a cache line.
_ALIGNED = 64

#: Memory that so many calls did not use is freed, as `Renderer` does.
_PATIENCE = 8

#: The most pieces of memory that are kept for later calls; each has a descriptor.
_MOST_KEPT = 8

_numbers = itertools.count()


class Memory:
    """Shared memory, which goes when no process has the descriptor, a mapping or an array of it any more."""

    def __init__(self, size: int) -> None:
        self.size, self.number = size, next(_numbers)
        self.free = False  # nobody has an array of it
        self.used = 0  # the last call that did
        self.descriptor = os.memfd_create("cubecam", os.MFD_CLOEXEC)
        try:
            os.ftruncate(self.descriptor, size)
            self.whole = mapped(self.descriptor, size)
        except BaseException:
            self.close()
            raise

    def close(self) -> None:
        """Close the descriptor; arrays stay."""
        if self.descriptor >= 0:
            os.close(self.descriptor)
        self.descriptor = -1


class _Lease:
    """What the arrays of a call keep alive; its end says that they are gone."""

    def __init__(self, whole: Bytes) -> None:
        self._whole = whole
        self.__array_interface__ = whole.__array_interface__


class MemoryStore:
    """Memory of results that are gone serves the next result of the same size: new memory costs a fault for each page.

    It holds at most `limit` bytes, in use or not. The caller holds a lock.
    """

    def __init__(self, limit: int) -> None:
        self._limit = limit
        self._kept: list[Memory] = []
        self._returned: deque[Memory] = deque()  # by whatever thread
        self._calls = 0

    def take(self, layout: Layout, count: int) -> tuple[Memory, Arrays]:
        """Give memory for so many pictures, and its arrays, whose numbers are undefined."""
        size = size_of(layout, count)
        self._look()
        memory = next((each for each in self._kept if each.free and each.size == size), None)
        if memory is None:
            memory = self._made(size)
        memory.free, memory.used = False, self._calls
        lease = _Lease(memory.whole)
        if memory in self._kept:
            weakref.finalize(lease, _give_back, memory, self._returned).atexit = False
        return memory, arranged(np.asarray(lease), layout, count)

    def _look(self) -> None:
        """Find what has come back, and let go of what nobody has used for long."""
        self._calls += 1
        while self._returned:
            memory = self._returned.popleft()
            memory.free, memory.used = True, self._calls
        for memory in list(self._kept):
            if memory.free and self._calls - memory.used > _PATIENCE:
                self.drop(memory)

    def _made(self, size: int) -> Memory:
        for memory in sorted(self._kept, key=lambda each: each.used):
            if memory.free and not self._has_room(size):
                self.drop(memory)
        memory = Memory(size)
        if self._has_room(size):
            self._kept.append(memory)
        return memory

    def _has_room(self, size: int) -> bool:
        total = size + sum(each.size for each in self._kept)
        return total <= self._limit and len(self._kept) < _MOST_KEPT

    def done(self, memory: Memory, whole: bool) -> None:
        """Note the end of a call; `whole`: all is drawn, and no worker will write there any more."""
        if not whole or memory not in self._kept:
            self.drop(memory)

    def drop(self, memory: Memory) -> None:
        """Let memory go with its arrays."""
        memory.close()
        if memory in self._kept:
            self._kept.remove(memory)
        with suppress(ValueError):
            self._returned.remove(memory)

    def has(self, number: int) -> bool:
        """Say whether memory is kept."""
        return any(each.number == number for each in self._kept)

    def clear(self) -> None:
        """Let all go."""
        for memory in list(self._kept):
            self.drop(memory)


def _give_back(memory: Memory, returned: deque[Memory]) -> None:
    if memory.descriptor >= 0:  # else it was dropped
        returned.append(memory)


def mapped(descriptor: int, size: int) -> Bytes:
    """Map shared memory; the array does not need the descriptor."""
    memory: Bytes = _map_shared(descriptor, size)
    return memory


def arranged(memory: Bytes, layout: Layout, count: int) -> Arrays:
    """Give arrays that have a row for each of `count` pictures."""
    arrays: Arrays = []
    begin = 0
    for shape, dtype in layout:
        size = _bytes(shape, dtype, count)
        arrays.append(memory[begin : begin + size].view(dtype).reshape(count, *shape))
        begin += _aligned(size)
    return arrays


def size_of(layout: Layout, count: int) -> int:
    """Give the bytes of all arrays, at least one."""
    return max(sum(_aligned(_bytes(shape, dtype, count)) for shape, dtype in layout), 1)


def _bytes(shape: tuple[int, ...], dtype: np.dtype[Any], count: int) -> int:
    return count * math.prod(shape) * dtype.itemsize


def _aligned(size: int) -> int:
    return -(-size // _ALIGNED) * _ALIGNED
