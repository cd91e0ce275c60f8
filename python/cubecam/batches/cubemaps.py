"""Cubemaps from many places, as one array."""

from __future__ import annotations

import operator
import os
from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from .._array_protocol import CPU, array_of, dlpack_of
from .._calls import checked_call
from .._checks import one_of, text_of
from .._core import CubeMap, Scene, _cube_of_batch, _to_array
from ..typing import Encoding
from ._outputs import Output, OutputArrays

if TYPE_CHECKING:
    import xarray
    from zarr.abc.store import Store

    from ..typing import Pixels

__all__ = ["CubeMapBatch"]


class CubeMapBatch:
    """Cubemaps of one size and type, as one array: what `Renderer.capture_many` and `capture_scenes` return.

    ``len(batch)`` is P, the number of cubemaps; ``batch[i]`` is one as a `CubeMap`, ``batch[2:5]`` a batch of some, and
    a loop gives one after the other.

    Parameters
    ----------
    faces : ndarray (P, 6, N, N, C) uint8, float16 or float32
        Faces of all cubemaps in "gl" layout (docs/conventions.md). The batch keeps the array, not a copy.
    outputs : mapping of str to ndarray (P, 6, N, N) or (P, 6, N, N, channels), optional
        Further numbers for each texel, by name, as captures have them.
    positions : array_like (P, 3), optional
        The places of the captures, world.
    rotations : array_like (P, 4), optional
        Quaternions w, x, y, z that turned the axes of the cubes against the world's. None: they were not turned.
    encoding : str
        "linear" or "srgb", what the numbers of `faces` are.

    Attributes
    ----------
    faces : ndarray (P, 6, N, N, C)
        Faces of all cubemaps, writable. In a batch of `open_batch` an array of zarr, which reads what is indexed.
    outputs : dict of str to ndarray
        The outputs, as `faces`; each is a property, too: ``batch.distance``.
    positions : ndarray (P, 3) float64 or None
        The places of the captures, world.
    rotations : ndarray (P, 4) float64 or None
        How the cubes were turned.
    scene_hash : str or None
        `cubecam.scene_hash` of what was captured, if it is known: from a store, or because it was set.
    drawn : ndarray (P,) bool or None
        Which cubemaps are there, in a batch of a store that is not finished. None: all.

    Raises
    ------
    TypeError
        For arrays of other types.
    ValueError
        For arrays whose shapes do not fit together, or an encoding that does not exist.

    Examples
    --------
    >>> import numpy as np
    >>> import cubecam as cc
    >>> batch = cc.CubeMapBatch(np.zeros((10, 6, 4, 4, 3), np.float32))
    >>> batch
    CubeMapBatch(10, size=4, channels=3, dtype=float32, encoding='linear')
    >>> batch[0]
    CubeMap(size=4, channels=3, dtype=float32, mipmaps=False, encoding='linear')
    >>> len(batch[::2])
    5
    """

    __module__ = "cubecam"

    distance = Output("P, 6, N, N")
    z = Output("P, 6, N, N")
    normal = Output("P, 6, N, N")
    position = Output("P, 6, N, N")
    id = Output("P, 6, N, N")
    label = Output("P, 6, N, N")
    depth = Output("P, 6, N, N")
    stencil = Output("P, 6, N, N")

    @checked_call
    def __init__(
        self,
        faces: npt.ArrayLike,
        *,
        outputs: Mapping[str, npt.ArrayLike] | None = None,
        positions: npt.ArrayLike | None = None,
        rotations: npt.ArrayLike | None = None,
        encoding: Encoding = "linear",
    ) -> None:
        self.faces: Pixels = _array(faces, "faces")
        if self.faces.ndim != 5 or self.faces.shape[1] != 6 or self.faces.shape[2] < 1:
            raise ValueError(f"faces: expected shape (P, 6, N, N, C), got {self.faces.shape}")
        if self.faces.shape[2] != self.faces.shape[3] or self.faces.shape[4] not in (1, 3, 4):
            raise ValueError(
                f"faces: expected shape (P, 6, N, N, C), C 1, 3 or 4, got {self.faces.shape}"
            )
        if self.faces.dtype not in (np.uint8, np.float16, np.float32):
            raise TypeError(
                f"faces: expected uint8, float16 or float32, got dtype {self.faces.dtype}"
            )
        self.outputs: OutputArrays = {}
        for name, values in (outputs or {}).items():
            array = _array(values, name)
            if array.shape[:4] != self.faces.shape[:4] or array.ndim > 5:
                expected = ", ".join(map(str, self.faces.shape[:4]))
                raise ValueError(
                    f"{name}: expected shape ({expected}) or ({expected}, channels), got {array.shape}"
                )
            self.outputs[name] = array
        self.positions = _places(positions, "positions", len(self), 3)
        self.rotations = _places(rotations, "rotations", len(self), 4)
        self.encoding: Encoding = one_of(encoding, "encoding", ("linear", "srgb"))
        self.scene_hash: str | None = None
        self.drawn: npt.NDArray[np.bool_] | None = None

    @property
    def size(self) -> int:
        """int: N, texels along an edge of a face."""
        return int(self.faces.shape[2])

    @property
    def channels(self) -> int:
        """int: C, 1, 3 or 4."""
        return int(self.faces.shape[4])

    @property
    def dtype(self) -> np.dtype[Any]:
        """dtype: of `faces`, uint8, float16 or float32."""
        return self.faces.dtype

    def __len__(self) -> int:
        return int(self.faces.shape[0])

    @overload
    def __getitem__(self, place: int) -> CubeMap: ...
    @overload
    def __getitem__(
        self, place: slice | npt.NDArray[np.integer | np.bool_] | list[int]
    ) -> CubeMapBatch: ...
    def __getitem__(self, place: Any) -> CubeMap | CubeMapBatch:
        """Give one cubemap, a copy, or several: a slice is a view of the same memory, as with numpy.

        What a batch of `open_batch` gives is read at once, and lies in memory.
        """
        if isinstance(place, (slice, list, np.ndarray)):
            return self._some(place)
        try:
            number = operator.index(place)
        except TypeError:
            raise TypeError(
                f"expected an int, a slice or an array of ints, got {text_of(place)}"
            ) from None
        if not -len(self) <= number < len(self):
            raise IndexError(f"expected {-len(self)} to {len(self) - 1}, got {number}")
        outputs = {name: values[number] for name, values in self.outputs.items()}
        return _cube_of_batch(self.faces[number], outputs, self.encoding)

    def __iter__(self) -> Iterator[CubeMap]:
        return (self[number] for number in range(len(self)))

    def _some(self, place: Any) -> CubeMapBatch:
        some = CubeMapBatch(
            _taken(self.faces, place),
            outputs={name: _taken(values, place) for name, values in self.outputs.items()},
            positions=None if self.positions is None else self.positions[place],
            rotations=None if self.rotations is None else self.rotations[place],
            encoding=self.encoding,
        )
        some.scene_hash = self.scene_hash
        some.drawn = None if self.drawn is None else self.drawn[place]
        return some

    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[Any]:
        """Give `faces` to ``numpy.asarray``."""
        return array_of(self.faces, dtype, copy)

    def __dlpack__(self, **wanted: Any) -> Any:
        """Give `faces` to ``from_dlpack`` of numpy, torch, jax and others, which share the memory."""
        return dlpack_of(self.faces, **wanted)

    def __dlpack_device__(self) -> tuple[int, int]:
        """Give the device of `faces` to ``from_dlpack``: main memory."""
        return CPU

    def __repr__(self) -> str:
        names = f", outputs={tuple(self.outputs)}" if self.outputs else ""
        return (
            f"CubeMapBatch({len(self)}, size={self.size}, channels={self.channels}, "
            f"dtype={self.dtype}{names}, encoding={self.encoding!r})"
        )

    @checked_call
    def to_xarray(self, *, scene: Scene | None = None) -> xarray.Dataset:
        """Give the batch to xarray, with names for axes and faces and the conventions as attributes.

        Parameters
        ----------
        scene : Scene, optional
            What was captured: the attribute ``scene_hash`` is its `scene_hash`. None: that of the batch, if it has one.

        Returns
        -------
        xarray.Dataset
            ``color`` with dims probe, face, row, column, channel, and each output; they share the batch's memory.
            Coordinates: ``face`` ("+x" to "-z"), ``channel``, and, where the batch knows them, ``x``, ``y``, ``z`` and
            ``rotation`` of each probe; ``place_x``, ``place_y`` and ``place_z`` if an output has one of these names. A
            batch of `open_batch` is read as a whole; ``xarray.open_zarr`` of its store reads the parts that are used.

        Raises
        ------
        ImportError
            Without the package xarray.
        ValueError
            If a material's output has the name of a coordinate, such as ``face``.

        Examples
        --------
        >>> import numpy as np
        >>> import cubecam as cc
        >>> batch = cc.CubeMapBatch(np.zeros((10, 6, 4, 4, 3), np.float32), positions=np.zeros((10, 3)))
        >>> data = batch.to_xarray()
        >>> data.color.sel(face="+y", channel="r").dims
        ('probe', 'row', 'column')
        """
        from .labelled import dataset
        from .store import hash_of

        return dataset(self, hash_of(scene, self.scene_hash))

    @checked_call
    def to_zarr(
        self,
        store: str | os.PathLike[str] | Store,
        *,
        scene: Scene | None = None,
        chunk: int = 64,
        overwrite: bool = False,
    ) -> None:
        """Write the batch to a Zarr 3 store, from which `open_batch` and ``xarray.open_zarr`` read it.

        The group has the arrays, names and attributes of `to_xarray`: ``color`` and each output with the dims probe,
        face, row, column and channel, the coordinates, and attributes with convention, encoding and units. Each cubemap
        is a chunk of its own, compressed by Zstandard with a checksum. A folder appears under its name when all of it
        is written; in other stores the attribute ``complete`` is written last.

        Parameters
        ----------
        store : path, str or zarr.abc.store.Store
            The folder to write, an address that zarr can write, or a store of zarr.
        scene : Scene, optional
            What was captured, as in `to_xarray`.
        chunk : int
            Cubemaps of one file (a shard).
        overwrite : bool
            Whether a store that is there may go; another file or folder never does.

        Raises
        ------
        FileExistsError
            If there is something, unless it is a store and `overwrite` is True.
        ImportError
            Without the package zarr 3, which needs Python 3.11 or newer.
        OSError
            As writing files raises.
        ValueError
            As `to_xarray` raises, and for a `chunk` below 1.

        Examples
        --------
        >>> import numpy as np, xarray
        >>> import cubecam as cc
        >>> scene = cc.Scene(background=(0, 0, 1))
        >>> with cc.Renderer() as renderer:
        ...     batch = renderer.capture_many(scene, np.eye(3), 8, outputs=["distance"])
        >>> batch.to_zarr("blue.zarr", scene=scene)
        >>> data = xarray.open_zarr("blue.zarr", chunks=None)
        >>> data.color.sel(face="+y", channel="b").mean().item(), data.attrs["scene_hash"] == cc.scene_hash(scene)
        (1.0, True)
        """
        from .store import write_batch

        write_batch(self, store, scene, chunk, overwrite)


def _taken(values: Any, place: Any) -> Any:
    """Index an array; one of zarr, which is read, knows neither steps backwards nor masks in this way."""
    if isinstance(values, np.ndarray):
        return values[place]
    if isinstance(place, slice) and (place.step is None or place.step > 0):
        return np.asarray(values[place])
    return np.asarray(values.oindex[np.arange(values.shape[0])[place]])


def _array(value: npt.ArrayLike, name: str) -> npt.NDArray[Any]:
    return value if type(value) is np.ndarray else np.asarray(_to_array(value, name))


def _places(
    value: npt.ArrayLike | None, name: str, count: int, width: int
) -> npt.NDArray[np.float64] | None:
    if value is None:
        return None
    array = _array(value, name)
    if array.shape != (count, width):
        raise ValueError(f"{name}: expected shape ({count}, {width}), got {array.shape}")
    return array.astype(np.float64, copy=False)
