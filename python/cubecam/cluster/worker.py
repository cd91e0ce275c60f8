"""What a process that draws keeps from chunk to chunk: a renderer, and the scenes that it was sent."""

from __future__ import annotations

import contextlib
import os
import pickle
import threading
from collections import OrderedDict
from collections.abc import Iterator
from typing import Any

import numpy as np

from .._core import ContextError, Device, Renderer, devices
from ..pool.memory import Arrays, Layout
from ..pool.work import Captures

__all__ = ["device_of_worker", "draw", "renderer_of_process", "same_bytes"]

#: How many scenes a process keeps, the last ones used.
_SCENES = 4


class _Desk:
    """One renderer for all threads of the process; it is made when something is drawn."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._renderer: Renderer | None = None
        self._scenes: OrderedDict[str, Any] = OrderedDict()

    @contextlib.contextmanager
    def renderer(self) -> Iterator[Renderer]:
        """Give the renderer to one thread at a time."""
        with self._lock:
            if self._renderer is None:
                self._renderer = Renderer(device=device_of_worker())
            try:
                yield self._renderer
            except ContextError:  # a lost one; the next call gets a new one
                self._renderer = None
                raise

    def draw(self, payload: bytes, scene_hash: str, work: Captures, arrays: Arrays) -> None:
        """Draw into arrays; the payload is read if the scene is new."""
        with self.renderer() as renderer:
            if scene_hash in self._scenes:
                self._scenes.move_to_end(scene_hash)
            else:
                self._scenes[scene_hash] = pickle.loads(payload)
                while len(self._scenes) > _SCENES:
                    self._scenes.popitem(last=False)
            work.draw(renderer, self._scenes[scene_hash], arrays)


_desk = _Desk()


def _after_fork() -> None:
    _desk.__init__()  # type: ignore[misc] # a renderer does not survive a fork


os.register_at_fork(after_in_child=_after_fork)


def renderer_of_process() -> contextlib.AbstractContextManager[Renderer]:
    """Give the renderer of this process, for one thread at a time."""
    return _desk.renderer()


def draw(payload: bytes, scene_hash: str, work: Captures, layout: Layout) -> Arrays:
    """Draw a chunk: the faces, then the outputs.

    Parameters
    ----------
    payload : bytes
        The scene as a pickle, which is read once for each hash.
    scene_hash : str
        The scene's `cubecam.scene_hash`.
    work : Captures
        The places of the chunk.
    layout : list
        Shape and dtype of each array, without its first axis.
    """
    arrays: Arrays = [np.empty((len(work.positions), *shape), dtype) for shape, dtype in layout]
    if len(work.positions):
        _desk.draw(payload, scene_hash, work, arrays)
    return arrays


def same_bytes(payload: bytes) -> bytes:
    """Hold a scene where it is needed: a task that the scheduler can make again, unlike data that were sent."""
    return payload


def device_of_worker() -> str | Device:
    """Say on what a worker draws.

    ``CUBECAM_DEVICE`` comes first. Then the first GPU of ``CUDA_VISIBLE_DEVICES``, by which clusters give each worker
    a GPU of its own: OpenGL knows nothing of that variable. "auto" if neither is set, or no device has that number.
    """
    first = os.environ.get("CUDA_VISIBLE_DEVICES", "").partition(",")[0].strip()
    if os.environ.get("CUBECAM_DEVICE") or not first:
        return "auto"
    for device in devices():
        if first.isdecimal() and device.cuda_index == int(first) and not device.problem:
            return device
        part = first.removeprefix("GPU-")  # of a UUID; CUDA takes its beginning
        if first != part and device.uuid.startswith(part) and not device.problem:
            return device
    return "auto"
