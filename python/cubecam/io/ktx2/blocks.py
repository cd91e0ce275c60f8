"""Blocks of 4 x 4 texels, BC1 to BC7: OpenImageIO decodes them as a DDS file in memory."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..._core import ImageError
from .. import dds, oiio
from ..picture_kinds import DDS

if TYPE_CHECKING:
    from ..pixels import Array
    from .texels import Format


def decode(form: Format, data: memoryview, width: int, height: int, count: int) -> Array:
    """Give `count` pictures whose blocks lie one after another, (count, H, W, C)."""
    rows = (height + 3) // 4 * 4
    header = dds.header(width, rows * count, form.dxgi)
    pixels = oiio.read_bytes(header + bytes(data), DDS).pixels
    if pixels.shape[:2] != (rows * count, width):
        raise ImageError(f"expected {width} x {rows * count} texels, got {pixels.shape}")
    if form.name.startswith("BC1_RGB_"):
        pixels = pixels[..., :3]
    return np.ascontiguousarray(pixels.reshape(count, rows, width, -1)[:, :height])
