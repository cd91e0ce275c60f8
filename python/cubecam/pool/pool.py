"""Batches that several processes draw, with the bytes of one renderer."""

from __future__ import annotations

import os
import weakref
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import check_room, text_of, whole_number
from .._core import (
    Camera,
    ContextError,
    CubeMap,
    Device,
    ImageEffect,
    Node,
    Renderer,
    Scene,
    StereoCamera,
    _CaptureBatch,
    _RenderBatch,
)
from .._progress import bar
from ..batches.captures import check_batch_room, floats_of, listed, places_of, scene_of
from ..batches.cubemaps import CubeMapBatch
from ..batches.frames import FrameBatch
from ..batches.renders import cameras_of
from ..typing import DepthFormat, DepthOrder, Encode, Format, Tonemap
from .calls import Call
from .crew import CLOSED, Crew
from .memory import Arrays
from .payload import PayloadKeeper, check_outside_import, packed, packed_function
from .remote import Remote
from .work import Captures, Frames, Scenes, cube_layout, frame_layout

if TYPE_CHECKING:
    from types import TracebackType

    from typing_extensions import Self

__all__ = ["Pool"]

#: Into how many pieces a call is cut for each worker, if it is long enough.
_PIECES = 8

#: A larger number is a mistake: each worker is a process with a renderer.
_MOST_WORKERS = 1024

#: The most scenes or frames of a piece.
_MOST = 64


class Pool:
    """Draws batches by several processes, each with a renderer of its own; the bytes are those of one renderer.

    The processes start with the pool, and get a scene once for each call, or not at all if it has not changed since the
    last one. They write into memory that they share with this process, and that is the result: its numbers are copied
    nowhere. A process that dies is replaced, and draws again what it had not finished. Ctrl-C ends a call at once. Use
    a pool in a ``with`` block, or call `close`. Any thread may use it, and several calls share the processes.

    What a call gives is what a new `Renderer` gives for the scene as it is then, whatever the pool has drawn before:
    probes with ``update="once"``, a number, or few ``faces_per_frame`` show the scene of this call, and those with
    "manual" are never drawn. The bytes depend neither on the number of workers nor on who draws what.

    Parameters
    ----------
    workers : int or None
        The number of processes. None: as many as this process may use cores. With an `executor`: how many pieces are
        submitted at a time is twice this; None is the executor's own number, if it has one.
    executor : concurrent.futures.Executor or None
        Draws in place of the pool's own processes: threads, processes, or machines of a cluster. Each thread that draws
        has a renderer. Results come back as arrays and are copied, since others may not share memory with this process;
        dead workers are the executor's own matter. It stays open when the pool is closed.
    device, layered, cache_bytes, debug, trust_shaders
        As for `Renderer`, for each worker; `cache_bytes` times the workers is also how much memory of results that are
        gone is kept for later ones of the same size, until eight calls did not use it. This process has such a
        renderer, too, which checks arguments and draws nothing; a software one if an `executor` draws and this machine
        lacks the device.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer` raises; for a number of workers that is not an int from 1 to 1024, or something else as executor.
    RuntimeError
        In a program without an interpreter that could be started; in a script that makes a pool outside of
        ``if __name__ == "__main__":`` and whose function `capture_scenes` was given.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(0, 0, 1))
    >>> ball = scene.add(cc.Mesh.sphere(1), cc.BasicMaterial(color="red"))
    >>> places = [(x, 0, 3) for x in range(10)]
    >>> with cc.Pool(workers=1) as pool:
    ...     batch = pool.capture_many(scene, places, 16, outputs=["distance"])
    >>> batch.faces.shape, batch.distance.shape
    ((10, 6, 16, 16, 4), (10, 6, 16, 16))
    """

    __module__ = "cubecam"

    @checked_call
    def __init__(
        self,
        workers: int | None = None,
        *,
        executor: Executor | None = None,
        device: str | int | Device | None = "auto",
        layered: bool | None = None,
        cache_bytes: int = 268435456,
        debug: bool = False,
        trust_shaders: bool = False,
    ) -> None:
        check_outside_import()
        count = None if workers is None else whole_number(workers, "workers", 1, _MOST_WORKERS)
        self._workers = count or _cores()
        if executor is not None and not hasattr(executor, "submit"):
            raise TypeError(
                f"executor: expected an Executor of concurrent.futures or None, got {text_of(executor)}"
            )
        options: dict[str, Any] = {
            "device": device,
            "layered": layered,
            "cache_bytes": cache_bytes,
            "debug": debug,
            "trust_shaders": trust_shaders,
        }
        self._renderer: Renderer | None = None
        self._renderer = _checking(options, executor)
        self._kept = PayloadKeeper()
        self._crew: Crew | Remote
        if executor is None:
            kept = self._workers * cache_bytes
            self._crew = Crew(self._workers, options, _environment(self._workers), kept)
        else:
            self._workers = count or getattr(executor, "_max_workers", None) or self._workers
            self._crew = Remote(executor, options, 2 * self._workers)
        self._finish = weakref.finalize(self, self._crew.close)

    @property
    def workers(self) -> int:
        """int: the number of processes, or what an executor is taken to have."""
        return self._workers

    @checked_call
    def close(self) -> None:
        """End the processes; calls under way raise ContextError. Nothing if the pool is closed."""
        self._finish()
        self._kept.forget()
        renderer, self._renderer = self._renderer, None
        if renderer is not None:
            renderer.close()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.close()

    def __reduce__(self) -> tuple[object, ...]:
        raise TypeError("cannot pickle a cubecam.Pool")

    def __repr__(self) -> str:
        return f"Pool(workers={self._workers}{', closed' * (self._renderer is None)})"

    @checked_call
    def capture_many(
        self,
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
        """Capture a scene from many places; see `Renderer.capture_many`.

        Parameters
        ----------
        scene, positions, size, outputs, rotations, near, far, exclude, format, samples, eye
            As in `Renderer.capture_many`.
        depth_format, depth_order, max_lod_error
            As in `Renderer.capture_many`.
        progress : bool
            As in `Renderer.capture_many`; one bar for all workers.

        Returns
        -------
        CubeMapBatch
            ``faces`` (P, 6, N, N, 4) and outputs, with the places, in memory of its own; the workers have no part in it
            any more.

        Raises
        ------
        TypeError, ValueError, ContextError
            As `Renderer.capture_many` raises. What a worker raises is raised here, with its traceback as the cause.
        Error
            If three processes one after the other died of the same places.
        """
        call, batch = self._captures(
            scene,
            positions,
            rotations,
            exclude,
            {
                "size": size,
                "near": near,
                "far": far,
                "outputs": outputs,
                "format": format,
                "samples": samples,
                "eye": eye,
                "depth_format": depth_format,
                "depth_order": depth_order,
                "max_lod_error": max_lod_error,
            },
            in_memory=True,
        )
        self._draw(call, progress)
        made = _cubes(batch, call.arrays)
        made.positions, made.rotations = floats_of(positions), floats_of(rotations)
        return made

    @checked_call
    def iter_captures(
        self,
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
        """Capture a scene from many places, and give one cubemap after the other; see `Renderer.iter_captures`.

        The workers draw ahead while the loop runs, and never hold more than two parts for each worker and one; a part
        is at most 64 captures, or 8 MiB on a software driver.

        Parameters
        ----------
        scene, positions, size, outputs, rotations, near, far, exclude, format, samples, eye
            As in `Renderer.capture_many`.
        depth_format, depth_order, max_lod_error
            As in `Renderer.capture_many`.
        progress : bool
            As in `Renderer.capture_many`.

        Yields
        ------
        CubeMap
            The captures, in the order of `positions`.

        Raises
        ------
        TypeError, ValueError, ContextError, Error
            As `capture_many` raises; wrong arguments at the call and not in the loop.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene = cc.Scene(background=(0, 0.5, 1))
        >>> with cc.Pool(workers=1) as pool:
        ...     for cube in pool.iter_captures(scene, [(0, 0, 0), (0, 1, 0)], 16):
        ...         print(cube.sh(0).round(2)[0, :3].tolist())
        [0.0, 1.77, 3.54]
        [0.0, 1.77, 3.54]
        """
        call, batch = self._captures(
            scene,
            positions,
            rotations,
            exclude,
            {
                "size": size,
                "near": near,
                "far": far,
                "outputs": outputs,
                "format": format,
                "samples": samples,
                "eye": eye,
                "depth_format": depth_format,
                "depth_order": depth_order,
                "max_lod_error": max_lod_error,
            },
            in_memory=False,
        )
        return self._one_by_one(call, batch, progress)

    @checked_call
    def render_many(
        self,
        scene: Scene,
        cameras: Iterable[Camera | StereoCamera],
        size: tuple[int, int],
        *,
        outputs: Iterable[str] = (),
        format: Format | None = "rgba8",  # noqa: A002 - as Renderer.render
        samples: int = 1,
        exposure: float = 0.0,
        tonemap: Tonemap | None = None,
        encode: Encode | None = None,
        effects: Iterable[ImageEffect] = (),
        depth_format: DepthFormat | None = "depth_component32f",
        screen_reflections: bool = False,
        max_lod_error: float = 0.0,
        progress: bool = True,
    ) -> FrameBatch:
        """Render a scene for many cameras; see `Renderer.render_many`.

        Parameters
        ----------
        scene, cameras, size, outputs, format, samples, exposure, tonemap, encode, effects, depth_format
            As in `Renderer.render_many`.
        screen_reflections, max_lod_error, progress
            As in `Renderer.render_many`.

        Returns
        -------
        FrameBatch
            ``color`` (F, H, W, 4) and outputs.

        Raises
        ------
        TypeError, ValueError, ContextError, Error
            As `Renderer.render_many` and `capture_many` raise.

        Examples
        --------
        >>> import cubecam as cc
        >>> cameras = [cc.PerspectiveCamera(position=(0, 0, z)) for z in (3, 4, 5)]
        >>> with cc.Pool(workers=1) as pool:
        ...     batch = pool.render_many(cc.Scene(background=(1, 0, 0)), cameras, (40, 30))
        >>> batch
        FrameBatch(3, size=(40, 30), format='rgba8', encoding='linear')
        """
        seen_by = cameras_of(cameras)
        options: dict[str, Any] = {
            "outputs": listed(outputs),
            "format": format,
            "samples": samples,
            "exposure": exposure,
            "tonemap": tonemap,
            "encode": encode,
            "depth_format": depth_format,
            "screen_reflections": screen_reflections,
            "max_lod_error": max_lod_error,
        }
        passes = listed(effects)
        batch = _RenderBatch(self._own(), scene, seen_by, size, effects=passes, **options)
        # What may hold parts of the scene travels with it.
        alone = not passes and not any(map(_follows, seen_by))
        whole, color, kinds = batch.shape()
        layout = frame_layout(whole, color, kinds)
        count = len(seen_by)
        check_room(
            count * sum(int(np.prod(shape)) * dtype.itemsize for shape, dtype in layout),
            f"{count} frames of {whole[0]} x {whole[1]} pixels",
            "cameras",
        )
        call = Call(
            Frames(0, count, seen_by if alone else None, whole, options),
            self._kept.packed(scene, batch.revision) if alone else packed(scene, seen_by, passes),
            layout,
            count,
            self._step(count, 1),
            title="frames",
        )
        self._draw(call, progress)
        arrays = list(call.arrays)
        pixels = None if color is None else arrays.pop(0)
        named = {name: array for (name, _, _), array in zip(kinds, arrays, strict=True)}
        return FrameBatch(count, whole, pixels, named, format, batch.encoding)

    @checked_call
    def capture_scenes(
        self,
        make_scene: Callable[[int], Scene],
        count: int,
        *,
        position: npt.ArrayLike = (0.0, 0.0, 0.0),
        size: int = 256,
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
        """Capture many scenes, which the workers make, and of which each lives only until it is captured.

        Parameters
        ----------
        make_scene : callable (int) -> Scene
            Called with 0, 1, ..., `count` - 1 for the scenes, each number in one of the workers, and with 0 in this
            process, too, to know the outputs. What it gives should follow from the number alone. Workers import it: it
            stands at the top of a module, or of a script that makes the pool below ``if __name__ == "__main__":``.
            Other functions, such as a lambda or one of a notebook, need the package cloudpickle.
        count : int
            How many scenes there are, 0 or more.
        position : array_like (3,) or (count, 3)
            The place of the capture in each scene, world; one for all, or one for each.
        size : int
            N, pixels along an edge of a face.
        outputs, near, far, format, samples, depth_format, depth_order, max_lod_error
            As in `Renderer.capture`.
        progress : bool
            As in `Renderer.capture_many`.

        Returns
        -------
        CubeMapBatch
            A cubemap of each scene; a scene that `make_scene` gives again begins as if it were new.

        Raises
        ------
        TypeError, ValueError, ContextError, Error
            As `cubecam.capture_scenes` and `capture_many` raise; TypeError, too, for a function that workers do not
            find. What `make_scene` raises ends the call.
        """
        number_of_scenes = whole_number(count, "count", 0)
        if not callable(make_scene):
            raise TypeError(f"make_scene: expected a callable, got {text_of(make_scene)}")
        places = np.broadcast_to(places_of(position, number_of_scenes), (number_of_scenes, 3))
        options = _checked(
            {
                "size": size,
                "near": near,
                "far": far,
                "outputs": outputs,
                "format": format,
                "samples": samples,
                "eye": None,
                "depth_format": depth_format,
                "depth_order": depth_order,
                "max_lod_error": max_lod_error,
            }
        )
        own = self._own()
        payload = packed_function(make_scene, "make_scene")
        scene = scene_of(make_scene, 0) if number_of_scenes else Scene()
        at = places[:1]
        batch = _CaptureBatch(own, scene, at, None, exclude=(), **options)
        check_batch_room(batch, number_of_scenes)
        call = Call(
            Scenes(0, places, options, batch.outputs, batch.encoding),
            payload,
            cube_layout(batch),
            number_of_scenes,
            self._step(number_of_scenes, 1),
            title="scenes",
        )
        del scene
        self._draw(call, progress)
        made = _cubes(batch, call.arrays)
        made.positions = np.array(places)
        return made

    def _own(self) -> Renderer:
        """Give the renderer that checks arguments."""
        if self._renderer is None:
            raise ContextError(CLOSED)
        return self._renderer

    def _captures(
        self,
        scene: Scene,
        positions: npt.ArrayLike,
        rotations: npt.ArrayLike | None,
        exclude: Iterable[Node],
        options: dict[str, Any],
        *,
        in_memory: bool,
    ) -> tuple[Call, _CaptureBatch]:
        options = _checked(options)
        left_out = listed(exclude)
        batch = _CaptureBatch(self._own(), scene, positions, rotations, exclude=left_out, **options)
        count, most = len(batch), batch.most_cubes
        if in_memory:
            step, window = self._step(count, most), None
        else:
            step = min(most, self._step(count, 1))
            window = 2 * self._workers + 1
        check_batch_room(batch, count if window is None else min(count, step * window))
        places = floats_of(positions)
        assert places is not None
        call = Call(
            Captures(
                places, floats_of(rotations), frozenset(node.id for node in left_out), options
            ),
            self._kept.packed(scene, batch.revision),
            cube_layout(batch),
            count,
            step,
            title="captures",
            window=window,
        )
        return call, batch

    def _step(self, count: int, unit: int) -> int:
        """Give the length of pieces: whole units, if there are enough of them for all workers."""
        wanted = count // (self._workers * _PIECES)
        if wanted >= unit:
            return min(wanted // unit * unit, max(unit, _MOST))
        return max(1, min(unit, -(-count // (self._workers * 2))))

    def _draw(self, call: Call, progress: bool) -> None:
        with (
            bar(call.title, call.count, None if progress else False) as advance,
            self._crew.pieces(call) as pieces,
        ):
            for piece in pieces:
                advance(piece.count)

    def _one_by_one(self, call: Call, batch: _CaptureBatch, progress: bool) -> Iterator[CubeMap]:
        with (
            bar(call.title, call.count, None if progress else False) as advance,
            self._crew.pieces(call) as pieces,
        ):
            for piece in pieces:
                part = _cubes(batch, call.arrays_of(piece))
                for number in range(len(part)):
                    yield part[number]
                    advance()


def _cubes(batch: _CaptureBatch, arrays: Arrays) -> CubeMapBatch:
    names = [name for name, _, _ in batch.outputs]
    return CubeMapBatch(
        arrays[0], outputs=dict(zip(names, arrays[1:], strict=True)), encoding=batch.encoding
    )


def _checking(options: dict[str, Any], executor: Executor | None) -> Renderer:
    """Make the renderer that checks arguments."""
    try:
        return Renderer(**options)
    except ContextError:
        if executor is None:
            raise
        # Where an executor draws there may be a GPU, and here none.
        return Renderer(**{**options, "device": "software"})


def _follows(camera: Camera | StereoCamera) -> bool:
    """Find whether a node moves a camera."""
    eyes = [camera.left, camera.right] if isinstance(camera, StereoCamera) else [camera]
    return any(getattr(eye, "parent", None) is not None for eye in eyes)


def _checked(options: dict[str, Any]) -> dict[str, Any]:
    """Give options that can be read more than once."""
    return {**options, "outputs": listed(options["outputs"])}


def _cores() -> int:
    return max(len(os.sched_getaffinity(0)), 1)


def _environment(workers: int) -> dict[str, str]:
    """Give variables by which the threads of all workers together are as many as the cores."""
    threads = _cores() // workers
    wanted = {
        # Mesa's software driver; 0: it draws in the thread that calls it.
        "LP_NUM_THREADS": str(threads if threads > 1 else 0),
        "OMP_NUM_THREADS": str(max(threads, 1)),
        "OPENBLAS_NUM_THREADS": str(max(threads, 1)),
    }
    return {name: value for name, value in wanted.items() if name not in os.environ}
