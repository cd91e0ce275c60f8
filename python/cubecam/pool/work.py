"""What is drawn in one piece: a part of a batch. Pieces travel to the processes that draw them."""

from __future__ import annotations

import pickle
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from .._core import Node, Renderer, Scene, _CaptureBatch, _RenderBatch
from ..batches.captures import check_same_kind, scene_of
from .memory import Arrays, Layout

__all__ = ["Captures", "Frames", "Scenes", "Work", "cube_layout", "frame_layout"]

Options = dict[str, Any]


class Work(Protocol):
    """Pictures of a call: all of them, or those of a piece."""

    def part(self, first: int, count: int) -> Work:
        """Give the work of some pictures alone."""

    def draw(self, renderer: Renderer, things: Any, arrays: Arrays) -> None:
        """Draw into arrays with a row for each picture."""


@dataclass(frozen=True)
class Captures:
    """Cubemaps of a scene, which are `things`; nodes with the ids `exclude` are left out."""

    positions: npt.NDArray[np.float64]
    rotations: npt.NDArray[np.float64] | None
    exclude: frozenset[int]
    options: Options

    def part(self, first: int, count: int) -> Captures:
        """Give the work of some places alone."""
        some = slice(first, first + count)
        turned = None if self.rotations is None else self.rotations[some]
        return replace(self, positions=self.positions[some], rotations=turned)

    def left_out(self, scene: Scene) -> list[Node]:
        """Give the nodes of the scene that are left out."""
        return [node for node in scene.nodes if node.id in self.exclude] if self.exclude else []

    def draw(self, renderer: Renderer, things: Any, arrays: Arrays) -> None:
        """Draw the places one part after the other."""
        scene: Scene = things
        batch = _CaptureBatch(
            renderer,
            scene,
            self.positions,
            self.rotations,
            exclude=self.left_out(scene),
            **self.options,
        )
        for first in range(0, len(batch), batch.most_cubes):
            _draw(batch, first, [array[first : first + batch.most_cubes] for array in arrays])


@dataclass(frozen=True)
class Frames:
    """Frames of a scene.

    `cameras` None: `things` are the scene, the cameras of the whole call, and the effects. Else they are the scene.
    """

    first: int
    count: int
    cameras: list[Any] | None
    size: tuple[int, int]
    options: Options

    def part(self, first: int, count: int) -> Frames:
        """Give the work of some cameras alone."""
        some = None if self.cameras is None else self.cameras[first : first + count]
        return replace(self, first=self.first + first, count=count, cameras=some)

    def draw(self, renderer: Renderer, things: Any, arrays: Arrays) -> None:
        """Draw the frames one after the other."""
        if self.cameras is None:
            scene, cameras, effects = things
            cameras = cameras[self.first : self.first + self.count]
        else:
            scene, cameras, effects = things, self.cameras, ()
        batch = _RenderBatch(renderer, scene, cameras, self.size, effects=effects, **self.options)
        for number in range(len(batch)):
            frame = batch.draw(number)
            pictures = [] if frame.color is None else [frame.color]
            for array, values in zip(arrays, [*pictures, *frame.outputs.values()], strict=True):
                array[number] = values


@dataclass(frozen=True)
class Scenes:
    """Cubemaps of scenes that a function makes; `things` are the function.

    `kinds` and `encoding` are those of the first scene; others must have the same.
    """

    first: int
    positions: npt.NDArray[np.float64]
    options: Options
    kinds: list[Any]
    encoding: str

    def part(self, first: int, count: int) -> Scenes:
        """Give the work of some scenes alone."""
        some = self.positions[first : first + count]
        return replace(self, first=self.first + first, positions=some)

    def draw(self, renderer: Renderer, things: Any, arrays: Arrays) -> None:
        """Make and draw the scenes one after the other."""
        for row in range(len(self.positions)):
            number = self.first + row
            scene = scene_of(things, number)
            batch = self.batch(renderer, scene, row)
            check_same_kind(batch, self.kinds, self.encoding, number)
            if batch.keeps_pictures:
                # The function may give a scene again that was drawn before, in whatever process.
                batch = self.batch(renderer, _new(scene), row)
            _draw(batch, 0, [array[row : row + 1] for array in arrays])
            del scene, batch  # before the next scene is made

    def batch(self, renderer: Renderer, scene: Scene, row: int) -> _CaptureBatch:
        """Take a scene's snapshot."""
        at = self.positions[row : row + 1]
        return _CaptureBatch(renderer, scene, at, None, exclude=(), **self.options)


def cube_layout(batch: _CaptureBatch) -> Layout:
    """Give the arrays of a batch: faces, then outputs."""
    shape = (6, batch.size, batch.size)
    outputs = [
        ((*shape, channels) if channels > 1 else shape, dtype)
        for _, channels, dtype in batch.outputs
    ]
    return [((*shape, 4), batch.dtype), *outputs]


def frame_layout(size: tuple[int, int], color: np.dtype[Any] | None, outputs: list[Any]) -> Layout:
    """Give the arrays of frames: the colour, if there is one, then outputs."""
    shape = (size[1], size[0])
    arrays: list[Any] = [] if color is None else [((*shape, 4), color)]
    for _, channels, dtype in outputs:
        arrays.append(((*shape, channels) if channels > 1 else shape, dtype))
    return arrays


def _new(scene: Scene) -> Scene:
    """Give a scene that no renderer has drawn."""
    made: Scene = pickle.loads(pickle.dumps(scene, protocol=5))
    return made


def _draw(batch: _CaptureBatch, first: int, arrays: Arrays) -> None:
    batch.draw(first, arrays[0], arrays[1:])
