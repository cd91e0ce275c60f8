"""Captures into a Zarr store, by this process, a pool or a cluster, and on from where an earlier call was ended.

docs/adr/0037 says which files are written in which order, and why a chunk is either there or not.
"""

from __future__ import annotations

import contextlib
import errno
import itertools
import os
import sys
import time
import warnings
from collections.abc import Callable, Iterable, Iterator, Mapping
from concurrent.futures import CancelledError
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of, whole_number
from .._core import Error, Node, Scene, __version__
from .._progress import bar
from ..batches.cubemaps import CubeMapBatch
from ..batches.labelled import Named
from ..batches.store import (
    drawn_places,
    finish,
    group_of,
    is_group,
    make_store,
    need_zarr,
    open_batch,
    path_of,
    replacing,
)
from ..pool.memory import Arrays, Layout
from ..pool.pool import Pool
from ..pool.work import Captures
from ..typing import DepthFormat, DepthOrder, Format
from .plan import Plan, plan_of
from .worker import draw, same_bytes

if TYPE_CHECKING:
    import zarr
    from distributed import Client
    from zarr.abc.store import Store

__all__ = ["capture_to_zarr"]

#: Chunks that are under way for each thread of a cluster: few, so that the scheduler keeps no long lists.
_AHEAD = 4
#: The least number of chunks under way.
_LEAST = 64


@checked_call
def capture_to_zarr(
    scene: Scene,
    positions: npt.ArrayLike,
    store: str | os.PathLike[str] | Store,
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
    chunk: int = 64,
    client: Client | None = None,
    pool: Pool | None = None,
    workers: int | None = None,
    resources: Mapping[str, float] | None = None,
    resume: bool = True,
    overwrite: bool = False,
    progress: bool = True,
) -> CubeMapBatch:
    """Capture a scene from many places into a Zarr store; what an earlier call has finished is kept.

    The store is one of `CubeMapBatch.to_zarr`, with an array ``drawn`` (P,) bool that says which places are there.
    Places are drawn and written in chunks of `chunk`. A chunk counts as soon as ``drawn`` says so, which is written
    after all else; whatever ends a process before that, the chunk is drawn again by the next call. The attribute
    ``complete`` is True when all are there. Bytes depend neither on who draws nor on how often the work was
    interrupted.

    Parameters
    ----------
    scene, positions, size, outputs, rotations, near, far, exclude, format, samples, eye
        As in `Renderer.capture_many`.
    depth_format, depth_order, max_lod_error
        As in `Renderer.capture_many`.
    store : path, str or zarr.abc.store.Store
        The store to write or to go on with. All workers of a cluster must reach it under this name.
    chunk : int
        Places that are drawn at once, and make one file of each array. Each place is a chunk of Zarr in it.
    client : distributed.Client, optional
        Its workers draw and write. The scene is sent once to each.
    pool : Pool, optional
        Its processes draw, and this one writes.
    workers : int, optional
        A pool of so many processes, for this call. None, without client and pool: this process draws.
    resources : mapping of str to float, optional
        With a client: what a chunk takes of a worker, such as ``{"GPU": 1}`` for workers that were started with
        ``--resources "GPU=1"``.
    resume : bool
        Whether a store that an earlier call of the same captures has begun is gone on with; False: it is an error.
    overwrite : bool
        Whether a store that is there goes, whatever it holds; other files and folders never do.
    progress : bool
        As in `Renderer.capture_many`; places that are there count.

    Returns
    -------
    CubeMapBatch
        The finished store, as `open_batch` opens it.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer.capture_many` raises; ValueError, too, if the store holds other captures: the error says what
        differs.
    FileExistsError
        With ``resume=False``, if there is a store; if there is something else.
    Error
        If the cluster is lost or gives up. What is finished stays.
    ImportError
        Without the packages of ``pip install "cubecam[cluster]"``.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam import cluster
    >>> scene = cc.Scene(background=(0, 0, 1))
    >>> ball = scene.add(cc.Mesh.sphere(1), cc.BasicMaterial(color="red"))
    >>> places = [(x, 0, 3) for x in range(10)]
    >>> batch = cluster.capture_to_zarr(scene, places, "ball.zarr", 8, outputs=["distance"], chunk=4)
    >>> batch
    CubeMapBatch(10, size=8, channels=4, dtype=float32, outputs=('distance',), encoding='linear')
    >>> bool(batch[0].distance.min() < 2.2)
    True
    """
    need_zarr("capture_to_zarr")
    if sum(way is not None for way in (client, pool, workers)) > 1:
        raise ValueError("expected one of client=, pool= and workers=, got several")
    if client is not None:
        _check_client(client)
    if pool is not None and not isinstance(pool, Pool):
        raise TypeError(f"pool: expected a Pool or None, got {text_of(pool)}")
    if resources is not None and client is None:
        raise ValueError("resources: expected with client=, got it without")
    if workers is not None:
        whole_number(workers, "workers", 1)
    options: dict[str, Any] = {
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
    }
    plan = plan_of(scene, positions, rotations, exclude, chunk, options)
    path = path_of(store)
    place: Any = store if path is None else str(path.absolute())
    group = _begun(place, path, plan, resume, overwrite)
    known = drawn_places(group)
    assert known is not None  # the store has the array: it is one of these
    todo = [k for k in range(plan.chunks) if not known[k * plan.chunk : (k + 1) * plan.chunk].all()]
    job = _Job(place, plan.names, plan.chunk, plan.hash, plan.layout, _mark(plan))
    with bar("captures", len(plan), None if progress else False) as advance:
        advance(len(plan) - sum(plan.span(k)[1] for k in todo))
        if not todo:
            pass
        elif client is not None:
            _by_client(client, plan, job, todo, advance, resources)
        elif pool is not None:
            _by_pool(pool, scene, plan, job, todo, advance)
        elif workers is not None:
            with Pool(workers) as made:
                _by_pool(made, scene, plan, job, todo, advance)
        else:
            for number in todo:
                _write(job, number, draw(plan.payload, plan.hash, plan.part(number), plan.layout))
                advance(plan.span(number)[1])
    _end(group, place, path)
    opened: CubeMapBatch = open_batch(place)
    return opened


@dataclass(frozen=True)
class _Job:
    """What a process needs to write chunks."""

    store: Any
    names: list[str]
    chunk: int
    scene_hash: str
    layout: Layout
    mark: dict[str, Any]


def _mark(plan: Plan) -> dict[str, Any]:
    """Give the attributes by which a store is known again."""
    return {
        "source": f"cubecam {__version__}",
        "scene_hash": plan.hash,
        "request": plan.request,
        "count": len(plan),
    }


def _check_client(client: Any) -> None:
    distributed = sys.modules.get("distributed")  # who has a Client has imported it
    if distributed is None or not isinstance(client, distributed.Client):
        raise TypeError(f"client: expected a Client of distributed or None, got {text_of(client)}")
    if client.asynchronous:
        raise ValueError("client: expected one with asynchronous=False, got one for coroutines")


# ----- the store


def _begun(place: Any, path: Path | None, plan: Plan, resume: bool, overwrite: bool) -> zarr.Group:
    """Open the store of this plan, or make it."""
    there = os.path.lexists(place) if path is not None else is_group(place)
    if there and not overwrite:
        if not resume:
            raise FileExistsError(
                errno.EEXIST, "expected no store of this name, or resume=True", str(place)
            )
        return _same(place, plan)
    labels = plan.labels()
    ledger = Named(
        ("probe",),
        np.zeros(len(plan), bool),
        {"long_name": "whether the place is there; written after all else"},
    )
    new: dict[str, Any] = {"complete": False, "more": {"request": plan.request}, "ledger": ledger}
    if path is None:
        return make_store(place, labels, plan.chunk, len(plan), **new)
    try:
        with replacing(path.absolute(), overwrite) as draft:
            make_store(str(draft), labels, plan.chunk, len(plan), **new)
    except FileExistsError:
        if overwrite or not resume:
            raise
        # Another process has begun it in the meantime.
    return _same(place, plan)


def _same(place: Any, plan: Plan) -> zarr.Group:
    """Open a store, and refuse one of other captures."""
    group = group_of(place, "r+")
    known = dict(group.attrs)
    if "request" not in known or "drawn" not in group:
        raise ValueError(
            f"{place}: expected a store that capture_to_zarr() began, got another one; overwrite=True begins anew"
        )
    differences = list(_differences(known, _mark(plan)))
    if differences:
        raise ValueError(
            f"{place}: expected a store of the same captures to go on with, got another one: "
            f"{'; '.join(differences)}; overwrite=True begins anew"
        )
    return group


def _differences(known: Mapping[str, Any], wanted: Mapping[str, Any]) -> Iterator[str]:
    for name, value in wanted.items():
        there = known.get(name)
        if name == "request":
            yield from _differences(there if isinstance(there, dict) else {}, value)
        elif there != value:
            yield f"{name} there {there!r}, here {value!r}"


def _write(job: _Job, number: int, arrays: Arrays) -> None:
    """Write a chunk: the arrays, and then that they are there."""
    for attempt in range(3):
        group = group_of(job.store, "r+")
        known = dict(group.attrs)
        if any(known.get(name) != value for name, value in job.mark.items()):
            raise ValueError(
                f"{job.store}: expected the store of this call, got another one: it was replaced in the meantime"
            )
        first = number * job.chunk
        rows = slice(first, first + len(arrays[0]))
        try:
            for name, values in zip(("color", *job.names), arrays, strict=True):
                array: Any = group[name]
                array[rows] = values
            ledger: Any = group["drawn"]
            ledger[rows] = True
            return
        except FileNotFoundError:  # another process has just ended the store, and cleared away
            if attempt == 2:
                raise


def _end(group: zarr.Group, place: Any, path: Path | None) -> None:
    """Say that all is there, and clear away what killed processes have left."""
    drawn = drawn_places(group)
    if drawn is None or not drawn.all():
        missing = 0 if drawn is None else int((~drawn).sum())
        raise Error(f"{place}: expected all places to be there, got {missing} missing")
    if path is not None:
        # zarr writes beside a file and then renames; what was killed in between stays.
        for left in Path(place).rglob("*.partial"):
            left.unlink(missing_ok=True)
    if group.attrs.get("complete") is not True:
        finish(group)


# ----- who draws


def _by_pool(
    pool: Pool,
    scene: Scene,
    plan: Plan,
    job: _Job,
    todo: list[int],
    advance: Callable[[int], None],
) -> None:
    """Let a pool draw ahead while this process writes."""
    rows = np.concatenate(
        [np.arange(first, first + count) for first, count in map(plan.span, todo)]
    )
    turns = plan.work.rotations
    cubes = pool.iter_captures(
        scene,
        plan.work.positions[rows],
        rotations=None if turns is None else turns[rows],
        exclude=plan.work.left_out(scene),
        progress=False,
        **plan.work.options,
    )
    with contextlib.closing(cubes):  # type: ignore[type-var]
        for number in todo:
            count = plan.span(number)[1]
            arrays = [np.empty((count, *shape), dtype) for shape, dtype in plan.layout]
            for row, cube in enumerate(itertools.islice(cubes, count)):
                for array, values in zip(arrays, (cube.faces, *cube.outputs.values()), strict=True):
                    array[row] = values
            _write(job, number, arrays)
            advance(count)


def _by_client(
    client: Client,
    plan: Plan,
    job: _Job,
    todo: list[int],
    advance: Callable[[int], None],
    resources: Mapping[str, float] | None,
) -> None:
    """Let the workers of a cluster draw and write."""
    from distributed import KilledWorker, as_completed

    # A task and no scattered data: if all workers that have it die, the scheduler makes it again.
    name = f"cubecam-scene-{plan.hash}-{time.time_ns()}"
    options: dict[str, Any] = {"pure": False}
    if resources is not None:
        options["resources"] = dict(resources)

    def submit(number: int) -> Any:
        return client.submit(
            _draw_and_write,
            payload,
            job,
            number,
            plan.part(number),
            key=f"{name}-{number}",
            **options,
        )

    waiting = iter(todo)
    under_way: set[Any] = set()
    raised: BaseException | None = None
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", message="Sending large graph")
            payload = client.submit(same_bytes, plan.payload, key=name, pure=False)
        ahead = max(_LEAST, _AHEAD * sum(client.nthreads().values()))
        under_way |= {submit(number) for number in itertools.islice(waiting, ahead)}
        done = as_completed(list(under_way))
        for future in done:
            if future.status == "error":  # a worker's own, such as a full disk
                raised = future.exception().with_traceback(future.traceback())
                break
            number = future.result()
            under_way.discard(future)
            advance(plan.span(number)[1])
            for following in itertools.islice(waiting, 1):
                new = submit(following)
                under_way.add(new)
                done.add(new)
    except (CancelledError, OSError) as error:  # of the connection to the scheduler
        raise _lost(job, error) from error
    finally:
        if under_way and client.status == "running":
            with contextlib.suppress(Exception):
                client.cancel(list(under_way))
    if isinstance(raised, KilledWorker):
        raise _lost(job, raised) from raised
    if raised is not None:
        raise raised


def _lost(job: _Job, error: BaseException) -> Error:
    return Error(
        f"{job.store}: the cluster was lost or gave up ({error!r}); what is finished stays, and the same call goes on "
        "with it"
    )


def _draw_and_write(payload: bytes, job: _Job, number: int, work: Captures) -> int:
    """Draw and write a chunk on a worker."""
    _write(job, number, draw(payload, job.scene_hash, work, job.layout))
    return number
