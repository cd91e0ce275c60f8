"""A contact sheet: small pictures in rows, with a line of text below each."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..io.pixels import Array

_GAP, _TEXT = 12, 22  # pixels between the cells, and for the text below each
_PAPER, _INK = (250, 250, 250), (30, 30, 30)


def contact_sheet(
    pictures: Sequence[Array], labels: Sequence[str], cell: int = 208, columns: int = 4
) -> Array:
    """Draw pictures, uint8 (H, W, 3 or 4), each into a square of `cell` pixels; the sheet is uint8 (H, W, 3)."""
    from PIL import Image, ImageDraw

    columns = max(1, min(columns, len(pictures)))
    rows = -(-len(pictures) // columns)
    step_x, step_y = cell + _GAP, cell + _TEXT + _GAP
    sheet = Image.new("RGB", (_GAP + columns * step_x, _GAP + rows * step_y), _PAPER)
    draw = ImageDraw.Draw(sheet)
    for index, (pixels, label) in enumerate(zip(pictures, labels, strict=True)):
        left, top = _GAP + index % columns * step_x, _GAP + index // columns * step_y
        picture = Image.fromarray(np.ascontiguousarray(pixels[..., :3]))
        picture.thumbnail((cell, cell))
        sheet.paste(
            picture, (left + (cell - picture.width) // 2, top + (cell - picture.height) // 2)
        )
        font = _font(draw, label, cell)
        width = draw.textlength(label, font=font)
        draw.text((left + (cell - width) / 2, top + cell + 4), label, fill=_INK, font=font)
    return np.asarray(sheet)


def _font(draw: Any, label: str, width: int) -> Any:
    """Choose the largest font, from 14 pixels downwards, in which the label is not wider than `width`."""
    from PIL import ImageFont

    for size in range(14, 6, -1):
        font = ImageFont.load_default(size)
        if draw.textlength(label, font=font) <= width:
            return font
    return font
