"""Batches in Zarr stores: `CubeMapBatch.to_zarr`, `FrameBatch.to_zarr` and `open_batch`.

A store is one group of Zarr 3. Each array has one file for some places (a shard), in which each place is a chunk of its
own, so that one place is read without the others. The attributes of the group say what the numbers are.
"""

from __future__ import annotations

import errno
import os
import shutil
import uuid
import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._checks import text_of, whole_number
from .._core import Scene
from .._scene_hash import scene_hash
from .cubemaps import CubeMapBatch
from .frames import FrameBatch
from .labelled import CUBES, FRAMES, Labels, Named, labels_of, names_of_places

if TYPE_CHECKING:
    import zarr
    from zarr.abc.store import Store

__all__ = [
    "drawn_places",
    "fill",
    "finish",
    "group_of",
    "is_group",
    "make_store",
    "need_zarr",
    "open_batch",
    "path_of",
    "replacing",
    "write_batch",
]

#: What the layout of the store is called in its attributes; another number means another layout.
LAYOUT = 1
#: The attribute by which a group says what it holds.
KIND = "cubecam_batch"


def need_zarr(caller: str) -> Any:
    """Import zarr; raise ImportError with the command that mends it."""
    try:
        import zarr
    except ImportError as error:
        raise ImportError(
            f"{caller}() needs zarr 3 (and Python 3.11 or newer): pip install 'zarr>=3.1.6'"
        ) from error
    if int(zarr.__version__.partition(".")[0]) < 3:
        raise ImportError(
            f"{caller}() needs zarr 3 (and Python 3.11 or newer), got zarr {zarr.__version__}: "
            "pip install 'zarr>=3.1.6'"
        )
    return zarr


def path_of(store: Any) -> Path | None:
    """Give the folder that a store is, None if it is an address or an object of zarr; raise TypeError for others."""
    if isinstance(store, str):
        return None if "://" in store else Path(store)
    if isinstance(store, os.PathLike):
        return Path(store)
    from zarr.abc.store import Store

    if isinstance(store, Store):
        return None
    raise TypeError(f"store: expected a path or a store of zarr, got {text_of(store)}")


def write_batch(
    batch: CubeMapBatch | FrameBatch,
    store: str | os.PathLike[str] | Store,
    scene: Scene | None,
    chunk: int,
    overwrite: bool,
) -> None:
    """Write a batch; see `CubeMapBatch.to_zarr`."""
    need_zarr("to_zarr")
    places = whole_number(chunk, "chunk", 1)
    path = path_of(store)
    labels = labels_of(batch, hash_of(scene, batch.scene_hash))
    with _new_store(store, path, overwrite) as place:
        group = make_store(place, labels, places, len(batch), complete=False)
        for first in range(0, len(batch), places):
            fill(group, labels.variables, first, min(places, len(batch) - first))
        finish(group)


def hash_of(scene: Scene | None, otherwise: str | None) -> str | None:
    """Give the hash of a scene, or what is known without one."""
    if scene is None:
        return otherwise
    if not isinstance(scene, Scene):
        raise TypeError(f"scene: expected a Scene or None, got {text_of(scene)}")
    return scene_hash(scene)


@contextmanager
def _new_store(store: Any, path: Path | None, overwrite: bool) -> Iterator[Any]:
    """Give a place for a store that nobody sees until it is whole.

    A folder is written beside its place and then renamed. Other stores have no names to exchange: there the attribute
    "complete", which is written last, says that all is there.
    """
    if path is None:
        _refuse_group(store, overwrite)
        yield store
        return
    with replacing(path, overwrite) as draft:
        yield str(draft)


def is_group(store: Any) -> bool:
    """Say whether a store of zarr, or an address, holds a group."""
    import zarr

    try:
        zarr.open_group(store, mode="r")
    except (FileNotFoundError, ValueError):
        return False
    return True


def _refuse_group(store: Any, overwrite: bool) -> None:
    if is_group(store) and not overwrite:
        raise FileExistsError(
            errno.EEXIST, "expected an empty store, or overwrite=True, got a group", str(store)
        )


@contextmanager
def replacing(path: Path, overwrite: bool) -> Iterator[Path]:
    """Give the name of a folder that gets the name `path` at the end, unless something raises."""
    check_place(path, overwrite)
    mark = uuid.uuid4().hex[:12]
    draft = path.with_name(f".{path.name}.{mark}.partial")
    draft.mkdir()  # raises if the folder around it does not exist
    try:
        yield draft
        old = path.with_name(f".{path.name}.{mark}.old")
        if overwrite and path.exists():
            path.rename(old)
        try:
            draft.rename(path)
        except OSError:
            if old.exists():
                old.rename(path)
            check_place(path, overwrite)  # somebody wrote one in the meantime
            raise
        shutil.rmtree(old, ignore_errors=True)
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def check_place(path: Path, overwrite: bool) -> None:
    """Raise FileExistsError if a store may not be written to a place."""
    if not os.path.lexists(path):
        return
    if not overwrite:
        raise FileExistsError(
            errno.EEXIST, "expected no file of this name, or overwrite=True", str(path)
        )
    if not any((path / name).is_file() for name in ("zarr.json", ".zgroup", ".zattrs")):
        raise FileExistsError(
            errno.EEXIST, "overwrite=True: expected a Zarr group, got something else", str(path)
        )


def make_store(
    store: Any,
    labels: Labels,
    chunk: int,
    count: int,
    *,
    complete: bool,
    more: dict[str, Any] | None = None,
    ledger: Named | None = None,
) -> zarr.Group:
    """Make a group with empty arrays for what was drawn, and with its coordinates.

    Parameters
    ----------
    store : str or Store
        Where; a group that is there goes.
    labels : Labels
        Names, shapes and types; the values of the variables are not read.
    chunk : int
        Places of one file.
    count : int
        All places.
    complete : bool
        The attribute of that name.
    more : dict
        Further attributes.
    ledger : Named, optional
        An array that says what is there, with 0 for what is not: the array "drawn".
    """
    import zarr

    group = zarr.open_group(store, mode="w", zarr_format=3)
    told = " ".join(name for name in labels.coordinates if name not in _own_axes(labels))
    for name, row in labels.variables.items():
        attributes = {**row.attributes, **({"coordinates": told} if told else {})}
        shape = tuple(map(int, row.values.shape))
        _array(group, name, row.axes, shape, row.values.dtype, (1, *shape[1:]), chunk, attributes)
    for name, row in labels.coordinates.items():
        texts = isinstance(row.values, list)
        values = np.array(row.values, dtype=object if texts else None)
        kind: Any = str if texts else values.dtype
        made = _array(group, name, row.axes, values.shape, kind, values.shape, 0, row.attributes)
        if values.size:
            made[...] = values
    if ledger is not None:
        shape = tuple(map(int, ledger.values.shape))
        _array(group, "drawn", ledger.axes, shape, np.dtype(bool), (chunk,), 0, ledger.attributes)
    is_cubes = "face" in labels.coordinates
    group.attrs.update(
        {
            KIND: "cubemaps" if is_cubes else "frames",
            "cubecam_layout": LAYOUT,
            "count": count,
            "outputs": [name for name in labels.variables if name != "color"],
            **labels.attributes,
            **(more or {}),
            "complete": complete,
        }
    )
    with warnings.catch_warnings():
        # It is no part of the format yet; who does not know it reads the arrays one by one.
        warnings.simplefilter("ignore")
        zarr.consolidate_metadata(group.store, path=group.path, zarr_format=3)
    return zarr.open_group(store, mode="r+", zarr_format=3)


def _own_axes(labels: Labels) -> set[str]:
    """Give the coordinates that belong to an axis of their own name."""
    return {name for name, row in labels.coordinates.items() if row.axes == (name,)}


def _array(
    group: zarr.Group,
    name: str,
    axes: tuple[str, ...],
    shape: tuple[int, ...],
    dtype: Any,
    chunk: tuple[int, ...],
    shard: int,
    attributes: dict[str, Any],
) -> Any:
    """Make an array; its files have `shard` chunks along the first axis each, 0: one chunk each.

    zarr writes no file where all numbers are 0, so files do not say what was written.
    """
    from zarr.codecs import ZstdCodec

    chunks = tuple(max(1, length) for length in chunk)
    return group.create_array(
        name,
        shape=shape,
        dtype=dtype,
        chunks=chunks,
        shards=(shard, *chunks[1:]) if shard else None,
        compressors=[ZstdCodec(level=1, checksum=True)],
        fill_value="" if dtype is str else 0,
        dimension_names=axes,
        attributes=attributes,
    )


def fill(group: zarr.Group, variables: dict[str, Named], first: int, count: int) -> None:
    """Write some places of all variables, whose values begin at place 0."""
    for name, row in variables.items():
        array: Any = group[name]
        array[first : first + count] = row.values[first : first + count]


def finish(group: zarr.Group) -> None:
    """Say that all is there."""
    group.attrs.update({"complete": True})


@checked_call
def open_batch(store: str | os.PathLike[str] | Store, *, incomplete: bool = False) -> Any:
    """Open a batch that `CubeMapBatch.to_zarr`, `FrameBatch.to_zarr` or `cubecam.cluster.capture_to_zarr` wrote.

    Opening reads no pictures: `faces`, `color` and the outputs of the batch are arrays of zarr, which read what is
    indexed and give arrays of numpy. ``batch[i]`` reads one cubemap, ``batch[2:5]`` some, ``batch[:]`` all, as a
    batch in memory.

    Parameters
    ----------
    store : path, str or zarr.abc.store.Store
        A folder, an address that zarr can read, such as ``"s3://..."``, or a store of zarr.
    incomplete : bool
        Whether a store that is not finished is opened as well. `CubeMapBatch.drawn` then says which places are there;
        the others are 0.

    Returns
    -------
    CubeMapBatch or FrameBatch
        What was written.

    Raises
    ------
    FileNotFoundError
        If there is no such folder.
    ValueError
        For a group that cubecam did not write, for one in which arrays are missing, and for one that is not finished.
    ImportError
        Without the package zarr 3.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> batch = cc.CubeMapBatch(np.zeros((10, 6, 4, 4, 3), np.float32))
    >>> batch.to_zarr("black.zarr")
    >>> again = cc.open_batch("black.zarr")
    >>> again[7]
    CubeMap(size=4, channels=3, dtype=float32, mipmaps=False, encoding='linear')
    >>> again[:]
    CubeMapBatch(10, size=4, channels=3, dtype=float32, encoding='linear')
    """
    need_zarr("open_batch")
    group = group_of(store)
    known = dict(group.attrs)
    missing = _missing_places(group, known)
    if missing and not incomplete:
        raise ValueError(
            f"{_name(store)}: expected a batch that is complete, got one in which {missing}; "
            "open_batch(..., incomplete=True) opens it all the same"
        )
    if known[KIND] == "cubemaps":
        return _cubes(store, group, known)
    return _frames(store, group, known)


def group_of(store: Any, mode: Literal["r", "r+"] = "r") -> zarr.Group:
    """Open the group of a batch; raise an error that says what is there instead."""
    import zarr

    path = path_of(store)
    if path is not None and not path.exists():
        raise FileNotFoundError(
            errno.ENOENT, "expected a batch that to_zarr() wrote, got nothing", str(path)
        )
    wanted = f"{_name(store)}: expected a Zarr 3 group that to_zarr() wrote, got"
    try:
        group = zarr.open_group(store if path is None else str(path), mode=mode, zarr_format=3)
    except (FileNotFoundError, NotADirectoryError) as error:
        raise ValueError(f"{wanted} something else") from error
    except (ValueError, TypeError, KeyError) as error:  # JSON of another kind
        raise ValueError(f"{wanted} one that zarr cannot read: {error}") from error
    known = dict(group.attrs)
    if known.get(KIND) not in ("cubemaps", "frames"):
        names = ", ".join(sorted(known)) or "none"
        raise ValueError(f"{wanted} one without the attribute {KIND}; its attributes: {names}")
    if known.get("cubecam_layout") != LAYOUT:
        raise ValueError(
            f"{_name(store)}: expected layout {LAYOUT} of stores, got {known.get('cubecam_layout')!r}; "
            f"it was written by {known.get('source', 'another program')}"
        )
    return group


def _name(store: Any) -> str:
    return str(store)


def _missing_places(group: zarr.Group, known: dict[str, Any]) -> str:
    """Say what is missing; nothing is a text without letters."""
    if known.get("complete") is True:
        return ""
    drawn = drawn_places(group)
    if drawn is None:
        return "the last arrays are missing"
    return f"{int((~drawn).sum())} of {len(drawn)} places are missing"


def drawn_places(group: zarr.Group) -> npt.NDArray[np.bool_] | None:
    """Read which places are there; None if the store does not know."""
    if "drawn" not in group:
        return None
    ledger: Any = group["drawn"]
    found = np.zeros(ledger.shape, bool)
    step = ledger.chunks[0]
    for first in range(0, len(found), step):
        try:
            found[first : first + step] = ledger[first : first + step]
        except Exception:  # a damaged file of the ledger says nothing: that part is drawn again
            found[first : first + step] = False
    return found


def _arrays(
    store: Any, group: zarr.Group, known: dict[str, Any], axes: tuple[str, ...]
) -> dict[str, Any]:
    """Give the arrays by name, in the order of the batch that was written."""
    found: dict[str, Any] = {}
    for name in ("color", *known.get("outputs", ())):
        if name not in group:
            if name == "color" and known[KIND] == "frames":
                continue
            raise ValueError(
                f"{_name(store)}: expected the array {name!r}, got {', '.join(sorted(group))}"
            )
        array: Any = group[name]
        names = array.metadata.dimension_names or ()
        if names[: len(axes)] != axes or array.shape[0] != known.get("count"):
            raise ValueError(
                f"{_name(store)}: expected {known.get('count')} x {axes[1:]} of {name!r}, got "
                f"axes {names} of shape {array.shape}"
            )
        found[name] = array
    return found


def _cubes(store: Any, group: zarr.Group, known: dict[str, Any]) -> CubeMapBatch:
    found = _arrays(store, group, known, CUBES)
    batch = CubeMapBatch.__new__(CubeMapBatch)
    batch.faces = found.pop("color")
    batch.outputs = found
    places: list[Any] = [group[name] for name in names_of_places(found) if name in group]
    batch.positions = np.stack([axis[...] for axis in places], -1) if len(places) == 3 else None
    turns: Any = group.get("rotation")
    batch.rotations = None if turns is None else turns[...]
    batch.encoding = known.get("encoding", "linear")
    batch.scene_hash = known.get("scene_hash")
    batch.drawn = None if known.get("complete") is True else drawn_places(group)
    return batch


def _frames(store: Any, group: zarr.Group, known: dict[str, Any]) -> FrameBatch:
    found = _arrays(store, group, known, FRAMES)
    shapes = [array.shape for array in found.values()]
    color = found.pop("color", None)
    made = FrameBatch(
        known["count"],
        (shapes[0][2], shapes[0][1]) if shapes else (0, 0),
        color,
        found,
        known.get("format"),
        known.get("encoding", "linear"),
    )
    made.scene_hash = known.get("scene_hash")
    return made
