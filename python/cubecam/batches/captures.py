"""Captures from many places: `Renderer.capture_many` and `iter_captures`, and `capture_scenes` for many scenes."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import Any

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import check_room, text_of, whole_number
from .._core import CubeMap, Node, Renderer, Scene, _CaptureBatch, _to_array
from .._progress import bar
from ..typing import DepthFormat, DepthOrder, Format
from .cubemaps import CubeMapBatch

__all__ = [
    "capture_many",
    "capture_scenes",
    "check_batch_room",
    "check_same_kind",
    "floats_of",
    "iter_captures",
    "listed",
    "places_of",
    "scene_of",
]


@checked_call
def capture_many(
    self: Renderer,
    scene: Scene,
    positions: npt.ArrayLike,
    size: int = 256,
    *,
    outputs: Iterable[str] = (),
    rotations: npt.ArrayLike | None = None,
    near: float = 0.05,
    far: float = 1000.0,
    exclude: Iterable[Node] = (),
    format: Format = "rgba32f",  # noqa: A002 - as Renderer.capture
    samples: int = 1,
    eye: npt.ArrayLike | None = None,
    depth_format: DepthFormat = "depth_component32f",
    depth_order: DepthOrder = "nearest",
    max_lod_error: float = 0.0,
    progress: bool = True,
) -> CubeMapBatch:
    """Capture a scene from many places.

    Each cubemap has the same bytes as `Renderer.capture` gives for its place, but the driver is waited for once for
    many of them, faces that show nothing are filled without it, and the results are one array. The scene is that of the
    moment of the call; what is drawn for a batch is not kept for later calls.

    Parameters
    ----------
    scene : Scene
        What is captured.
    positions : array_like (P, 3)
        The places, world.
    size : int
        N, pixels along an edge of a face.
    outputs : iterable of str
        Further numbers for each texel, as in `Renderer.capture`.
    rotations : array_like (P, 4), optional
        Quaternions w, x, y, z that turn the axes of each cube against the world's, of any length but 0. None: no cube
        is turned.
    near, far : float
        Clip distances, world units, 0 < near < far.
    exclude : iterable of Node
        Nodes that are left out with all nodes below them.
    format, samples, eye, depth_format, depth_order, max_lod_error
        As in `Renderer.capture`, for all captures.
    progress : bool
        Whether a bar shows on the error stream how many captures are done, if it is a terminal and the work takes more
        than half a second.

    Returns
    -------
    CubeMapBatch
        ``faces`` (P, 6, N, N, 4) and outputs, with the places. `Renderer.stats` has the numbers of the last part of it.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer.capture` raises; ValueError, too, if the memory does not hold the results. `iter_captures` needs
        less.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(0, 0, 1))
    >>> ball = scene.add(cc.Mesh.sphere(1), cc.BasicMaterial(color="red"))
    >>> places = [(x, 0, 3) for x in range(10)]
    >>> with cc.Renderer() as renderer:
    ...     batch = renderer.capture_many(scene, places, 16, outputs=["distance"])
    >>> batch.faces.shape, batch.distance.shape
    ((10, 6, 16, 16, 4), (10, 6, 16, 16))
    >>> bool(batch.distance[0].min().round(1) == 2)
    True
    """
    batch = _CaptureBatch(
        self,
        scene,
        positions,
        rotations,
        size,
        near=near,
        far=far,
        exclude=exclude,
        outputs=outputs,
        format=format,
        samples=samples,
        eye=eye,
        depth_format=depth_format,
        depth_order=depth_order,
        max_lod_error=max_lod_error,
    )
    made = _room_for(batch, len(batch))
    made.positions, made.rotations = floats_of(positions), floats_of(rotations)
    with bar("captures", len(batch), None if progress else False) as advance:
        for first in range(0, len(batch), batch.most_cubes):
            part = made[first : first + batch.most_cubes]
            batch.draw(first, part.faces, list(part.outputs.values()))
            advance(len(part))
    return made


@checked_call
def iter_captures(
    self: Renderer,
    scene: Scene,
    positions: npt.ArrayLike,
    size: int = 256,
    *,
    outputs: Iterable[str] = (),
    rotations: npt.ArrayLike | None = None,
    near: float = 0.05,
    far: float = 1000.0,
    exclude: Iterable[Node] = (),
    format: Format = "rgba32f",  # noqa: A002 - as Renderer.capture
    samples: int = 1,
    eye: npt.ArrayLike | None = None,
    depth_format: DepthFormat = "depth_component32f",
    depth_order: DepthOrder = "nearest",
    max_lod_error: float = 0.0,
    progress: bool = True,
) -> Iterator[CubeMap]:
    """Capture a scene from many places, and give one cubemap after the other.

    It draws as `capture_many` does, some captures at a time, and never holds more than these: at most 64, or 8 MiB on a
    software driver. The scene is that of the moment of the call, whatever is changed while the loop runs.

    Parameters
    ----------
    scene, positions, size, outputs, rotations, near, far, exclude, format, samples, eye
        As in `capture_many`.
    depth_format, depth_order, max_lod_error
        As in `capture_many`.
    progress : bool
        As in `capture_many`.

    Yields
    ------
    CubeMap
        The captures, in the order of `positions`.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer.capture` raises; wrong arguments at the call and not in the loop.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(0, 0.5, 1))
    >>> with cc.Renderer() as renderer:
    ...     for cube in renderer.iter_captures(scene, [(0, 0, 0), (0, 1, 0)], 16):
    ...         print(cube.sh(0).round(2)[0, :3].tolist())
    [0.0, 1.77, 3.54]
    [0.0, 1.77, 3.54]
    """
    batch = _CaptureBatch(
        self,
        scene,
        positions,
        rotations,
        size,
        near=near,
        far=far,
        exclude=exclude,
        outputs=outputs,
        format=format,
        samples=samples,
        eye=eye,
        depth_format=depth_format,
        depth_order=depth_order,
        max_lod_error=max_lod_error,
    )
    return _one_by_one(batch, _room_for(batch, min(batch.most_cubes, len(batch))), progress)


def _one_by_one(batch: _CaptureBatch, chunk: CubeMapBatch, progress: bool) -> Iterator[CubeMap]:
    with bar("captures", len(batch), None if progress else False) as advance:
        for first in range(0, len(batch), batch.most_cubes):
            part = chunk[: len(batch) - first]
            batch.draw(first, part.faces, list(part.outputs.values()))
            for number in range(len(part)):
                yield part[number]
                advance()


@checked_call
def capture_scenes(
    make_scene: Callable[[int], Scene],
    count: int,
    *,
    position: npt.ArrayLike = (0.0, 0.0, 0.0),
    size: int = 256,
    renderer: Renderer | None = None,
    outputs: Iterable[str] = (),
    near: float = 0.05,
    far: float = 1000.0,
    format: Format = "rgba32f",  # noqa: A002 - as Renderer.capture
    samples: int = 1,
    depth_format: DepthFormat = "depth_component32f",
    depth_order: DepthOrder = "nearest",
    max_lod_error: float = 0.0,
    progress: bool = True,
) -> CubeMapBatch:
    """Capture many scenes, of which each lives only until it is captured.

    Parameters
    ----------
    make_scene : callable (int) -> Scene
        Called with 0, 1, ..., `count` - 1 for the scenes, one after the other. What scenes share, such as meshes,
        should be made outside of it: then it is uploaded once.
    count : int
        How many scenes there are, 0 or more.
    position : array_like (3,) or (count, 3)
        The place of the capture in each scene, world; one for all, or one for each.
    size : int
        N, pixels along an edge of a face.
    renderer : Renderer, optional
        What captures. None: one is made for the call.
    outputs, near, far, format, samples, depth_format, depth_order, max_lod_error
        As in `Renderer.capture`.
    progress : bool
        As in `Renderer.capture_many`.

    Returns
    -------
    CubeMapBatch
        A cubemap of each scene.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer.capture` raises; ValueError, too, if scenes differ in the outputs that materials declare, or in the
        encoding of their pictures. What `make_scene` raises ends the call.

    Examples
    --------
    >>> import cubecam as cc
    >>> ball = cc.Mesh.sphere(1)
    >>> def make_scene(number):
    ...     scene = cc.Scene()
    ...     scene.add(ball, cc.BasicMaterial(), position=(0, 0, -2 - number))
    ...     return scene
    >>> batch = cc.capture_scenes(make_scene, 3, size=16, outputs=["distance"])
    >>> batch.distance.min(axis=(1, 2, 3)).round(1).tolist()
    [1.0, 2.0, 3.0]
    """
    number_of_scenes = whole_number(count, "count", 0)
    if not callable(make_scene):
        raise TypeError(f"make_scene: expected a callable, got {text_of(make_scene)}")
    if renderer is not None and not isinstance(renderer, Renderer):
        raise TypeError(f"renderer: expected a Renderer or None, got {text_of(renderer)}")
    places = np.broadcast_to(places_of(position, number_of_scenes), (number_of_scenes, 3))
    wanted = list(outputs) if not isinstance(outputs, str) else outputs

    def plan(scene: Scene, at: npt.ArrayLike) -> _CaptureBatch:
        return _CaptureBatch(
            used,
            scene,
            at,
            None,
            size,
            near=near,
            far=far,
            exclude=(),
            outputs=wanted,
            format=format,
            samples=samples,
            eye=None,
            depth_format=depth_format,
            depth_order=depth_order,
            max_lod_error=max_lod_error,
        )

    used = Renderer() if renderer is None else renderer
    try:
        made: CubeMapBatch | None = None
        kinds: list[Any] = []
        with bar("scenes", number_of_scenes, None if progress else False) as advance:
            for number in range(number_of_scenes):
                scene = scene_of(make_scene, number)
                batch = plan(scene, places[number : number + 1])
                if made is None:
                    made, kinds = _room_for(batch, number_of_scenes), batch.outputs
                    made.encoding = batch.encoding
                check_same_kind(batch, kinds, made.encoding, number)
                part = made[number : number + 1]
                batch.draw(0, part.faces, list(part.outputs.values()))
                del scene, batch  # before the next scene is made
                advance()
        if made is None:  # no scene: the arguments are checked all the same
            made = _room_for(plan(Scene(), places), 0)
        made.positions = np.array(places)
        return made
    finally:
        if renderer is None:
            used.close()


def scene_of(make_scene: Callable[[int], Scene], number: int) -> Scene:
    """Call a user's function for a scene."""
    scene = make_scene(number)
    if not isinstance(scene, Scene):
        raise TypeError(f"make_scene: expected it to give a Scene, got {text_of(scene)}")
    return scene


def check_same_kind(batch: _CaptureBatch, kinds: list[Any], encoding: str, number: int) -> None:
    """Raise ValueError for a scene whose arrays are not like those of scene number 0."""
    if batch.outputs != kinds or batch.encoding != encoding:
        raise ValueError(
            f"make_scene: expected scenes with the same outputs and encoding, got "
            f"{_described(kinds, encoding)} from number 0 and "
            f"{_described(batch.outputs, batch.encoding)} from number {number}"
        )


def places_of(position: npt.ArrayLike, count: int) -> npt.NDArray[np.float64]:
    """Give one place for all scenes, (3,), or one for each, (count, 3)."""
    given = np.asarray(_to_array(position, "position"))
    if given.dtype.kind not in "iuf":
        raise TypeError(f"position: expected numbers, got {text_of(position)}")
    if given.shape not in ((3,), (count, 3)):
        raise ValueError(f"position: expected shape (3,) or ({count}, 3), got {given.shape}")
    places = given.astype(np.float64)
    if not np.isfinite(places).all():
        raise ValueError("position: expected finite numbers, got nan or inf")
    return places


def _described(kinds: list[Any], encoding: str) -> str:
    return f"outputs {[name for name, _, _ in kinds]} and {encoding!r}"


def listed(values: Any) -> Any:
    """Give a list of what can be read once; what cannot be read is refused by the core."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        return values
    return list(values)


def floats_of(value: npt.ArrayLike | None) -> npt.NDArray[np.float64] | None:
    """Give a copy of places or rotations, as results keep them."""
    return None if value is None else np.array(value, np.float64)


def check_batch_room(batch: _CaptureBatch, count: int) -> None:
    """Raise ValueError if the memory does not hold so many captures."""
    n = batch.size
    bytes_of_one = 6 * n * n * 4 * batch.dtype.itemsize
    for _, channels, dtype in batch.outputs:
        bytes_of_one += 6 * n * n * channels * dtype.itemsize
    check_room(count * bytes_of_one, f"{count} captures of {n} pixels", "positions")


def _room_for(batch: _CaptureBatch, count: int) -> CubeMapBatch:
    """Make a batch of undefined numbers."""
    check_batch_room(batch, count)
    faces, outputs = batch.allocate(count)
    names = [name for name, _, _ in batch.outputs]
    return CubeMapBatch(
        faces, outputs=dict(zip(names, outputs, strict=True)), encoding=batch.encoding
    )
