"""Frames of many cameras, as one array."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy.typing as npt

from .._array_protocol import CPU, array_of, dlpack_of
from .._calls import checked_call
from .._core import Scene
from ._outputs import Output, OutputArrays

if TYPE_CHECKING:
    import xarray
    from zarr.abc.store import Store

    from ..typing import Encoding, Format, Pixels

__all__ = ["FrameBatch"]


class FrameBatch:
    """Frames of one size and format, as one array: what `Renderer.render_many` returns.

    ``len(batch)`` is F, the number of frames.

    Attributes
    ----------
    color : ndarray (F, H, W, 4) or None
        The colours, uint8, float16 or float32 by the format; None with ``format=None``. In a batch of `open_batch` an
        array of zarr, which reads what is indexed.
    outputs : dict of str to ndarray (F, H, W) or (F, H, W, channels)
        The outputs; each is a property, too: ``batch.distance``.
    format : str or None
        The format, as `Renderer.render` takes it.
    encoding : str
        "linear" or "srgb", what the numbers of `color` are.
    scene_hash : str or None
        `cubecam.scene_hash` of what was rendered, if it is known: from a store, or because it was set.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.Scene(background=(1, 0, 0))
    >>> cameras = [cc.PerspectiveCamera(position=(0, 0, z)) for z in (1, 2, 3)]
    >>> with cc.Renderer() as renderer:
    ...     batch = renderer.render_many(scene, cameras, (32, 16))
    >>> batch
    FrameBatch(3, size=(32, 16), format='rgba8', encoding='linear')
    >>> batch.color[2, 0, 0].tolist()
    [255, 0, 0, 255]
    """

    __module__ = "cubecam"

    distance = Output("F, H, W")
    z = Output("F, H, W")
    normal = Output("F, H, W")
    position = Output("F, H, W")
    id = Output("F, H, W")
    label = Output("F, H, W")
    depth = Output("F, H, W")
    stencil = Output("F, H, W")

    def __init__(
        self,
        count: int,
        size: tuple[int, int],
        color: Pixels | None,
        outputs: OutputArrays,
        format: Format | None,  # noqa: A002 - the name that Renderer.render has
        encoding: Encoding,
    ) -> None:
        self.color = color
        self.outputs = outputs
        self.format = format
        self.encoding = encoding
        self.scene_hash: str | None = None
        self._count = count
        self._size = size

    @property
    def size(self) -> tuple[int, int]:
        """tuple of int: (width, height), pixels."""
        return self._size

    def __len__(self) -> int:
        return self._count

    def __array__(
        self, dtype: npt.DTypeLike | None = None, copy: bool | None = None
    ) -> npt.NDArray[Any]:
        """Give `color` to ``numpy.asarray``."""
        return array_of(self._colors(), dtype, copy)

    def __dlpack__(self, **wanted: Any) -> Any:
        """Give `color` to ``from_dlpack`` of numpy, torch, jax and others, which share the memory."""
        return dlpack_of(self._colors(), **wanted)

    def __dlpack_device__(self) -> tuple[int, int]:
        """Give the device of `color` to ``from_dlpack``: main memory."""
        return CPU

    def _colors(self) -> Pixels:
        if self.color is None:
            raise ValueError("expected frames with a colour, got a batch with format=None")
        return self.color

    def __repr__(self) -> str:
        names = f", outputs={tuple(self.outputs)}" if self.outputs else ""
        return (
            f"FrameBatch({len(self)}, size={self.size}, format={self.format!r}{names}, "
            f"encoding={self.encoding!r})"
        )

    @checked_call
    def to_xarray(self, *, scene: Scene | None = None) -> xarray.Dataset:
        """Give the batch to xarray: ``color`` with dims frame, row, column, channel, and each output.

        Parameters
        ----------
        scene : Scene, optional
            What was rendered: the attribute ``scene_hash`` is its `scene_hash`. None: that of the batch, if it has one.

        Returns
        -------
        xarray.Dataset
            It shares the batch's memory.

        Raises
        ------
        ImportError
            Without the package xarray.
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

        Parameters
        ----------
        store, scene, chunk, overwrite
            As in `CubeMapBatch.to_zarr`, with frames in place of cubemaps.

        Raises
        ------
        FileExistsError, ImportError, OSError
            As `CubeMapBatch.to_zarr` raises.

        Examples
        --------
        >>> import cubecam as cc
        >>> scene, cameras = cc.Scene(background=(1, 0, 0)), [cc.PerspectiveCamera()] * 3
        >>> with cc.Renderer() as renderer:
        ...     renderer.render_many(scene, cameras, (32, 16)).to_zarr("red.zarr")
        >>> again = cc.open_batch("red.zarr")
        >>> again, again.color[2, 0, 0].tolist()
        (FrameBatch(3, size=(32, 16), format='rgba8', encoding='linear'), [255, 0, 0, 255])
        """
        from .store import write_batch

        write_batch(self, store, scene, chunk, overwrite)
