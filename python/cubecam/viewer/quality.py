"""How small a picture is while something moves, so that a frame takes little CPU time on any machine."""

from __future__ import annotations

import contextlib
import math
import time
from collections.abc import Iterator

__all__ = ["Quality"]

#: Seconds of CPU time, of all threads, that a moving frame of 512 x 512 pixels may take; twice that at 1024 x 1024.
BUDGET = 0.030
#: The part of the budget that drawing may take; the encoder of JPEG and the connection take the rest.
SHARE = 0.5
#: What both sides of a picture are multiplied by. A few fixed steps keep the number of buffers small.
STEPS = (1.0, 0.75, 0.5, 0.375, 0.25, 0.125)


class Quality:
    """Choose the size of moving pictures from the CPU time that the last ones took."""

    def __init__(self) -> None:
        self._step = STEPS.index(0.5)
        self._seconds: float | None = (
            None  # what a frame of the present step takes: the lowest of the last few
        )

    def reduced(self, size: tuple[int, int]) -> tuple[int, int]:
        """Return the (width, height) in pixels that a moving picture has on a canvas of that size."""
        scale = STEPS[self._step]
        return max(1, round(size[0] * scale)), max(1, round(size[1] * scale))

    @contextlib.contextmanager
    def measured(self, size: tuple[int, int]) -> Iterator[tuple[int, int]]:
        """Give the reduced size, measure the CPU time of the body, and choose the next step from it."""
        start = time.process_time()
        yield self.reduced(size)
        self.learn(size, time.process_time() - start)

    def learn(self, size: tuple[int, int], seconds: float) -> None:
        """Choose the next step: down as soon as a frame is too dear twice, up when a larger one would fit, too."""
        allowed = SHARE * BUDGET * max(1.0, math.sqrt(size[0] * size[1]) / 512)
        # The first frame at a new size makes buffers; the lower of two frames is what drawing takes.
        before, self._seconds = self._seconds, seconds
        if before is None:
            return
        cost = min(before, seconds)
        if cost > allowed and self._step + 1 < len(STEPS):
            self._move(1)
        elif self._step > 0:
            growth = (STEPS[self._step - 1] / STEPS[self._step]) ** 2
            if max(before, seconds) * growth < 0.8 * allowed:
                self._move(-1)

    def _move(self, by: int) -> None:
        self._step += by
        self._seconds = None
