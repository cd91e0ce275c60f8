"""What lets numpy, matplotlib and other libraries take frames, cubemaps and images as arrays."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ._calls import checked_call
from ._core import CubeMap, Frame, Image
from .io.screen import numbers_of

if TYPE_CHECKING:
    from .typing import Pixels

CPU = (1, 0)  # kDLCPU of DLPack, and its only device
_NUMPY = tuple(int(part) for part in np.__version__.split(".")[:2])


def as_array(
    self: Frame | CubeMap | Image,
    dtype: np.dtype[np.generic] | None = None,
    copy: bool | None = None,
) -> npt.NDArray[np.generic]:
    """Give the picture's numbers to ``numpy.asarray``: the colour of a frame, the faces of a cubemap.

    Parameters
    ----------
    dtype : dtype, optional
        None: that of the picture.
    copy : bool, optional
        True: always a copy. False: never; raises ValueError if `dtype` needs one. None: a copy if `dtype` needs one.

    Returns
    -------
    ndarray (H, W, C), of a cubemap (6, N, N, C)
        Without a copy, that of a cubemap or an image is read-only.

    Raises
    ------
    ValueError
        For a frame without a colour, or a copy that is not allowed.
    """
    return array_of(numbers_of(self)[0], dtype, copy)


def array_of(
    values: npt.NDArray[Any], dtype: npt.DTypeLike | None, copy: bool | None
) -> npt.NDArray[Any]:
    """Give numbers to ``numpy.asarray``; see `as_array`."""
    if copy:
        return np.array(values, dtype=dtype)
    if copy is False and dtype is not None and np.dtype(dtype) != values.dtype:
        raise ValueError(f"copy=False: expected dtype {values.dtype}, got {np.dtype(dtype)}")
    return np.asarray(values, dtype)


@checked_call
def cube_numpy(self: CubeMap, *, writable: bool = False) -> Pixels:
    """Give the faces as an array.

    Parameters
    ----------
    writable : bool
        False: `faces`, the read-only view without a copy. True: a copy, which belongs to the caller.

    Returns
    -------
    ndarray (6, N, N, C) in the cube's `dtype`

    Examples
    --------
    >>> import cubecam as cc, numpy as np
    >>> cube = cc.CubeMap(np.zeros((6, 4, 4, 3), np.float32))
    >>> own = cube.numpy(writable=True)
    >>> own[cc.Face.POS_Y] = 1
    >>> float(cube.faces.max()), float(own.max())
    (0.0, 1.0)
    """
    return np.array(self.faces) if writable else self.faces


def dlpack(
    self: Frame | CubeMap | Image,
    *,
    stream: object = None,
    max_version: tuple[int, int] | None = None,
    dl_device: tuple[int, int] | None = None,
    copy: bool | None = None,
) -> object:
    """Give the picture's numbers to ``from_dlpack`` of numpy, torch, jax and others (DLPack, array API 2023.12).

    A frame's colour is shared. The numbers of a cubemap and an image must not change: they are shared as read-only if
    the reader knows version 1 of DLPack, which can say so, and are copied otherwise.
    """
    return dlpack_of(numbers_of(self)[0], stream, max_version, dl_device, copy)


def dlpack_of(
    values: npt.NDArray[Any],
    stream: object = None,
    max_version: tuple[int, int] | None = None,
    dl_device: tuple[int, int] | None = None,
    copy: bool | None = None,
) -> object:
    """Give an array to ``from_dlpack``; see `dlpack`."""
    versioned = max_version is not None and max_version[0] >= 1 and _NUMPY >= (2, 1)
    if stream is not None:
        raise BufferError(f"stream: expected None for numbers in main memory, got {stream!r}")
    if dl_device is not None and tuple(dl_device) != CPU:
        raise BufferError(f"dl_device: expected main memory, (1, 0), got {dl_device}")
    if copy is False and not values.flags.writeable and not versioned:
        raise BufferError(
            "expected a reader of DLPack 1.0 and numpy 2.1 or later, since these numbers are read-only; "
            "got copy=False and an older one"
        )
    if not versioned:
        own = copy or not values.flags.writeable
        return (np.array(values) if own else values).__dlpack__()
    options: dict[str, Any] = {"max_version": max_version, "copy": copy}
    return values.__dlpack__(**options)


def dlpack_device(self: object) -> tuple[int, int]:
    """Give the device of the numbers to ``from_dlpack``: main memory."""
    return CPU
