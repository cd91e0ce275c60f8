"""What a call captures: the scene as bytes, the places, the arrays, and the numbers by which a store knows it again."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from .._checks import text_of, whole_number
from .._core import Node, Scene, _CaptureBatch
from .._scene_hash import scene_hash
from ..batches.captures import check_batch_room, floats_of, listed
from ..batches.cubemaps import CubeMapBatch
from ..batches.labelled import Labels, labels_of
from ..pool.memory import Layout
from ..pool.work import Captures, cube_layout
from .worker import renderer_of_process

__all__ = ["Plan", "plan_of"]


@dataclass(frozen=True)
class Plan:
    """A call, checked; nothing was drawn."""

    work: Captures
    chunk: int
    payload: bytes  # the scene
    hash: str  # of the scene
    names: list[str]  # of the outputs
    layout: Layout  # of the faces, then of the outputs
    encoding: Any
    request: dict[str, Any]

    def __len__(self) -> int:
        return len(self.work.positions)

    @property
    def chunks(self) -> int:
        """int: how many chunks there are."""
        return -(-len(self) // self.chunk)

    def span(self, number: int) -> tuple[int, int]:
        """Give the first place of a chunk, and how many it has."""
        first = number * self.chunk
        return first, min(self.chunk, len(self) - first)

    def part(self, number: int) -> Captures:
        """Give the work of one chunk."""
        return self.work.part(*self.span(number))

    def labels(self) -> Labels:
        """Name the arrays; their values are not there."""
        empty = [
            np.broadcast_to(np.zeros((), dtype), (len(self), *shape))
            for shape, dtype in self.layout
        ]
        batch = CubeMapBatch(
            empty[0],
            outputs=dict(zip(self.names, empty[1:], strict=True)),
            positions=self.work.positions,
            rotations=self.work.rotations,
            encoding=self.encoding,
        )
        return labels_of(batch, self.hash)


def plan_of(
    scene: Scene,
    positions: npt.ArrayLike,
    rotations: npt.ArrayLike | None,
    exclude: Iterable[Node],
    chunk: int,
    options: dict[str, Any],
) -> Plan:
    """Check all arguments of a call as `Renderer.capture_many` does, by a renderer of this process.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer.capture_many` raises.
    """
    if not isinstance(scene, Scene):
        raise TypeError(f"scene: expected a Scene, got {text_of(scene)}")
    places_of_chunk = whole_number(chunk, "chunk", 1)
    left_out = listed(exclude)
    options = {**options, "outputs": listed(options["outputs"])}
    with renderer_of_process() as renderer:
        batch = _CaptureBatch(renderer, scene, positions, rotations, exclude=left_out, **options)
        check_batch_room(batch, min(places_of_chunk, len(batch)))
        names = [name for name, _, _ in batch.outputs]
        layout, encoding = cube_layout(batch), batch.encoding
    places, turns = floats_of(positions), floats_of(rotations)
    assert places is not None  # the batch has refused it
    known = scene_hash(scene)
    ids = sorted({node.id for node in left_out})
    eye = options["eye"]
    options = {**options, "eye": None if eye is None else np.array(eye, np.float64).tolist()}
    request: dict[str, Any] = {
        **{name: _plain(value) for name, value in options.items()},
        "outputs": names,
        "exclude": ids,
        "chunk": places_of_chunk,
        "places": _digest(places, turns),
    }
    return Plan(
        Captures(places, turns, frozenset(ids), options),
        places_of_chunk,
        pickle.dumps(scene, protocol=5),
        known,
        names,
        layout,
        encoding,
        request,
    )


def _plain(value: Any) -> Any:
    """Give a number or a text as JSON knows it."""
    if isinstance(value, np.generic):
        return value.item()
    return value


def _digest(*arrays: npt.NDArray[np.float64] | None) -> str:
    digest = hashlib.sha256()
    for array in arrays:
        if array is not None:
            digest.update(f"{array.shape};".encode() + np.ascontiguousarray(array, "<f8").tobytes())
    return digest.hexdigest()
