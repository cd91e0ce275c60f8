"""Read KTX2 files."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..._core import ImageError
from . import basis, blocks, packing
from .header import Header, read_header

if TYPE_CHECKING:
    from ...typing import Encoding
    from ..pixels import Array

_SWIZZLE = re.compile(r"[rgba01]{4}")


@dataclass(frozen=True)
class Ktx2:
    """The contents of a file.

    `size` is (width, height) of level 0. `levels` are arrays, the largest first: (6, N, N, C) of a cubemap, whose faces
    are +X -X +Y -Y +Z -Z, (H, W, C) of a picture, row 0 on top; uint8, uint16, float16 or float32; C is 1, 3 or 4.
    `encoding` says what the numbers are: "linear" or "srgb". `key_values` are the file's own remarks, by name.
    """

    size: tuple[int, int]
    faces: int
    levels: tuple[Array, ...]
    encoding: Encoding
    layers: int
    key_values: dict[str, bytes]

    def text(self, key: str) -> str:
        """Give the value of a key as text, "" if there is none."""
        return self.key_values.get(key, b"").split(b"\0")[0].decode("utf-8", "replace")


def read(
    data: bytes | bytearray | memoryview, *, levels: int | None = None, layer: int = 0
) -> Ktx2:
    """Read a file from its bytes.

    Parameters
    ----------
    data : bytes
        The whole file.
    levels : int, optional
        How many levels are decoded at most, from the largest on. None: all of them.
    layer : int
        Which element of an array texture.

    Returns
    -------
    Ktx2
        Two channels get a third one of 0; KTXswizzle and the KTXorientation of pictures are applied. Alpha is as
        stored. Numbers of Basis Universal, ETC1S and UASTC, are uint8.

    Raises
    ------
    ImageError
        For files that are broken, end early or claim more than their bytes can hold; for kinds that are not read, such
        as ETC2 and ASTC, which the message names; if a package is missing, which it names.
    ValueError
        For a layer that the file does not have.
    """
    view = memoryview(data).cast("B")
    header = read_header(view)
    if not 0 <= layer < header.layers:
        raise ValueError(f"part: expected 0 to {header.layers - 1}, got {layer}")
    count = len(header.levels) if levels is None else min(levels, len(header.levels))
    if header.format is None:
        found = basis.decode(header, bytes(view), layer, count)
    else:
        found = [_level(header, view, k, layer) for k in range(count)]
    finished = tuple(_finished(header, pictures) for pictures in found)
    return Ktx2(
        (header.width, header.height),
        header.faces,
        finished,
        "srgb" if header.srgb else "linear",
        header.layers,
        header.key_values,
    )


def _level(header: Header, view: memoryview, k: int, layer: int) -> Array:
    """Decode the pictures of a level, (faces, H, W, C)."""
    form, level = header.format, header.levels[k]
    assert form is not None
    width, height = header.size(k)
    one = form.level_bytes(width, height) * header.faces
    size = one * header.layers
    packed = view[level.offset : level.offset + level.length]
    if header.scheme == packing.NONE:
        if level.length != size:
            raise ImageError(
                f"expected {size} bytes of {form.name} in level {k}, got {level.length}"
            )
        unpacked = packed
    else:
        if level.unpacked != size:
            raise ImageError(
                f"expected uncompressedByteLength {size} of {form.name} in level {k}, got {level.unpacked}"
            )
        packing.check_size(header.scheme, level.length, width * height * header.faces, size)
        unpacked = packing.unpack(header.scheme, packed, size)
    mine = unpacked[layer * one : (layer + 1) * one]
    if form.decode is None:
        return blocks.decode(form, mine, width, height, header.faces)
    pixels = form.decode(mine, width * height * header.faces)
    return pixels.reshape(header.faces, height, width, -1)


def _finished(header: Header, pictures: Array) -> Array:
    """Apply the keys that change what a reader sees."""
    swizzle = header.text("KTXswizzle")
    if _SWIZZLE.fullmatch(swizzle) and swizzle != "rgba":
        pictures = _swizzled(pictures, swizzle)
    orientation = header.text("KTXorientation") or "rd"
    if header.faces == 6:
        if orientation != "rd":
            raise ImageError(f"expected a cubemap of KTXorientation rd, got {orientation!r}")
        return pictures
    picture = pictures[0]
    if orientation[1:2] == "u":
        picture = picture[::-1]
    if orientation[:1] == "l":
        picture = picture[:, ::-1]
    return np.ascontiguousarray(picture)


def _swizzled(pictures: Array, swizzle: str) -> Array:
    """Pick channels by name; alpha is left out where it is 1 throughout by definition."""
    one = np.iinfo(pictures.dtype).max if pictures.dtype.kind == "u" else 1
    has = pictures.shape[-1]
    held = {name: index for index, name in enumerate("rgba") if index < has}
    opaque = swizzle[3] == "1" or (swizzle[3] == "a" and "a" not in held)
    named = swizzle[:3] if opaque else swizzle
    out = np.empty((*pictures.shape[:-1], len(named)), pictures.dtype)
    for index, name in enumerate(named):
        if name in held:
            out[..., index] = pictures[..., held[name]]
        else:
            out[..., index] = one if name in "1a" else 0
    return out
