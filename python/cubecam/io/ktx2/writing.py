"""Write KTX2 files: cubemaps and pictures without block compression."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from . import packing
from .header import HEADER, LEVEL, MAGIC
from .texels import descriptor, number_of

if TYPE_CHECKING:
    from ...typing import Encoding
    from ..pixels import Array

_WRITER = "cubecam"


def write(
    levels: Sequence[Array],
    *,
    encoding: Encoding,
    compression: str | None = None,
    key_values: Mapping[str, str] | None = None,
) -> bytes:
    """Make the bytes of a file.

    Parameters
    ----------
    levels : sequence of ndarray
        The largest first: (6, N, N, C) of a cubemap, (H, W, C) of a picture, row 0 on top; C is 1, 3 or 4; uint8,
        float16 or float32, all of one dtype. Edges are those of the first, halved and rounded down each time. Three
        channels are written as four, with an alpha of 1, since GPUs have few formats of three.
    encoding : {"linear", "srgb"}
        What whole numbers are; floats are linear.
    compression : {"zstd", "zlib"}, optional
        How each level is packed.
    key_values : mapping of str to str
        Remarks besides KTXorientation and KTXwriter.

    Returns
    -------
    bytes

    Raises
    ------
    ValueError
        For levels of other sizes.
    ImageError
        If the package for Zstandard is missing.
    """
    pictures = [_four_channels(level) for level in levels]
    first = pictures[0]
    faces = 6 if first.ndim == 4 else 1
    height, width, channels = first.shape[-3:]
    for k, level in enumerate(pictures):
        expected = (*first.shape[:-3], max(1, height >> k), max(1, width >> k), channels)
        if level.shape != expected or level.dtype != first.dtype:
            raise ValueError(
                f"level {k}: expected {expected} {first.dtype}, got {level.shape} {level.dtype}"
            )
    srgb = encoding == "srgb" and first.dtype == np.uint8
    scheme = packing.SCHEMES[compression]
    told = {"KTXorientation": "rd", "KTXwriter": _WRITER, **(key_values or {})}
    keys = b"".join(_key(name, told[name]) for name in sorted(told))
    form = descriptor(first.dtype, channels, srgb)
    form_at = HEADER.size + LEVEL.size * len(pictures)
    keys_at = form_at + len(form)
    head = HEADER.pack(
        MAGIC, number_of(first.dtype, channels, srgb), first.dtype.itemsize, width, height, 0, 0, faces,
        len(pictures), scheme, form_at, len(form), keys_at, len(keys), 0, 0,
    )  # fmt: skip
    start = keys_at + len(keys)
    aligned = math.lcm(channels * first.dtype.itemsize, 4) if scheme == packing.NONE else 1
    body, index = b"", [b""] * len(pictures)
    for k in reversed(range(len(pictures))):  # the smallest level comes first
        little = first.dtype.newbyteorder("<")
        plain = np.ascontiguousarray(pictures[k], dtype=little).tobytes()
        packed = packing.pack(scheme, plain)
        body += bytes(-(start + len(body)) % aligned)
        index[k] = LEVEL.pack(start + len(body), len(packed), len(plain))
        body += packed
    return head + b"".join(index) + form + keys + body


def _key(name: str, text: str) -> bytes:
    both = name.encode() + b"\0" + text.encode() + b"\0"
    return struct.pack("<I", len(both)) + both + bytes(-len(both) % 4)


def _four_channels(level: Array) -> Array:
    if level.shape[-1] != 3:
        return level
    one = 255 if level.dtype == np.uint8 else 1
    return np.concatenate([level, np.full_like(level[..., :1], one)], axis=-1)
