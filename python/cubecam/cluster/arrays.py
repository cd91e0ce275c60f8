"""Captures as arrays of Dask: each chunk is drawn where it lies, when it is needed."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable
from operator import getitem
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from .._calls import checked_call
from .._core import Node, Scene
from ..batches.labelled import labelled_dataset
from ..typing import DepthFormat, DepthOrder, Format
from .plan import Plan, plan_of
from .worker import draw, same_bytes

if TYPE_CHECKING:
    import dask.array
    import xarray

__all__ = ["capture_array", "capture_dataset"]


@checked_call
def capture_array(
    scene: Scene,
    positions: npt.ArrayLike,
    size: int = 256,
    *,
    output: str = "color",
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
) -> dask.array.Array:
    """Give captures from many places as an array of Dask, of which nothing is drawn yet.

    Each chunk is drawn where its numbers are needed: in this process, or on the workers of a cluster, of which each
    keeps a renderer and is sent the scene once. The scene is that of the moment of the call. `capture_dataset` gives
    the colours and several outputs, drawn together.

    If the workers of a cluster were started with ``--resources "GPU=1"``, ``client.compute(array, resources={"GPU":
    1})`` draws one chunk at a time on each.

    Parameters
    ----------
    scene, positions, size, rotations, near, far, exclude, format, samples, eye
        As in `Renderer.capture_many`.
    depth_format, depth_order, max_lod_error
        As in `Renderer.capture_many`.
    output : str
        "color" for the faces, or the name of an output of `Renderer.capture`.
    chunk : int
        Places that are drawn at once, and make a chunk of the array.

    Returns
    -------
    dask.array.Array (P, 6, N, N, 4) or (P, 6, N, N) or (P, 6, N, N, channels)
        The faces, or the output.

    Raises
    ------
    TypeError, ValueError, ContextError
        As `Renderer.capture_many` raises, at the call.
    ImportError
        Without the packages of ``pip install "cubecam[cluster]"``.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam import cluster
    >>> scene = cc.Scene()
    >>> box = scene.add(cc.Mesh.box(2), cc.BasicMaterial())
    >>> places = [(x, 0, 0) for x in range(2, 12)]
    >>> distance = cluster.capture_array(scene, places, 16, output="distance", chunk=5)
    >>> distance.shape, distance.chunks[0]
    ((10, 6, 16, 16), (5, 5))
    >>> distance.min(axis=(1, 2, 3)).compute(scheduler="sync").round(1).tolist()
    [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0]
    """
    _need_dask("capture_array")
    options: dict[str, Any] = {
        "size": size,
        "near": near,
        "far": far,
        "outputs": () if output == "color" else (output,),
        "format": format,
        "samples": samples,
        "eye": eye,
        "depth_format": depth_format,
        "depth_order": depth_order,
        "max_lod_error": max_lod_error,
    }
    arrays = _arrays(plan_of(scene, positions, rotations, exclude, chunk, options))
    return arrays[output]


@checked_call
def capture_dataset(
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
    chunk: int = 64,
) -> xarray.Dataset:
    """Give captures from many places as a dataset of xarray with arrays of Dask; see `capture_array`.

    Parameters
    ----------
    scene, positions, size, outputs, rotations, near, far, exclude, format, samples, eye
        As in `Renderer.capture_many`.
    depth_format, depth_order, max_lod_error
        As in `Renderer.capture_many`.
    chunk : int
        As in `capture_array`.

    Returns
    -------
    xarray.Dataset
        ``color`` and each output, with the names, coordinates and attributes of `CubeMapBatch.to_xarray`. Arrays of one
        chunk that are computed together are drawn once.

    Raises
    ------
    TypeError, ValueError, ContextError, ImportError
        As `capture_array` raises.

    Examples
    --------
    >>> import cubecam as cc
    >>> from cubecam import cluster
    >>> scene = cc.Scene(background=(0, 0, 1))
    >>> data = cluster.capture_dataset(scene, [(x, 0, 0) for x in range(10)], 8, outputs=["id"])
    >>> data.color.sel(channel="b").mean().compute().item(), dict(data.id.sizes)
    (1.0, {'probe': 10, 'face': 6, 'row': 8, 'column': 8})
    """
    _need_dask("capture_dataset")

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
    labels = plan.labels()
    for name, array in _arrays(plan).items():
        labels.variables[name].values = array
    return labelled_dataset(labels)


def _need_dask(caller: str) -> None:
    try:
        import dask.array  # noqa: F401
        import xarray  # noqa: F401
    except ImportError as error:
        raise ImportError(
            f'{caller}() needs dask and xarray (and Python 3.11 or newer): pip install "cubecam[cluster]"'
        ) from error


def _arrays(plan: Plan) -> dict[str, dask.array.Array]:
    """Make an array for the faces and for each output; the scene is one task, which each worker gets once."""
    import dask.array
    from dask.highlevelgraph import HighLevelGraph

    request = json.dumps(plan.request, sort_keys=True)
    mark = hashlib.sha256(f"{plan.hash} {request}".encode()).hexdigest()[:32]
    scene, drawn = f"cubecam-scene-{plan.hash}", f"cubecam-captures-{mark}"
    layers: dict[str, Any] = {
        scene: {scene: (same_bytes, plan.payload)},
        drawn: {
            (drawn, number): (draw, scene, plan.hash, plan.part(number), list(plan.layout))
            for number in range(plan.chunks)
        },
    }
    dependencies: dict[str, set[str]] = {scene: set(), drawn: {scene}}
    lengths = tuple(plan.span(number)[1] for number in range(plan.chunks)) or (0,)
    made: dict[str, dask.array.Array] = {}
    for at, (name, (shape, dtype)) in enumerate(
        zip(("color", *plan.names), plan.layout, strict=True)
    ):
        key = f"cubecam-{name}-{mark}"
        rest = (0,) * len(shape)
        layer: dict[Any, Any] = {
            (key, number, *rest): (getitem, (drawn, number), at) for number in range(plan.chunks)
        }
        if not plan.chunks:
            layer = {(key, 0, *rest): (draw_nothing, at, list(plan.layout))}
        graph = HighLevelGraph(
            {**layers, key: layer}, {**dependencies, key: {drawn} if plan.chunks else set()}
        )
        chunks = (lengths, *((length,) for length in shape))
        made[name] = dask.array.Array(graph, key, chunks, dtype=dtype)
    return made


def draw_nothing(at: int, layout: Any) -> Any:
    """Give an array without places."""
    import numpy as np

    shape, dtype = layout[at]
    return np.empty((0, *shape), dtype)
