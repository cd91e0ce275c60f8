"""Words in pictures: a line of text in a corner, and several pictures as one, each with its name."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Literal, TypeAlias

import numpy as np
import numpy.typing as npt

from cubecam.viewer.lettering import Lettering

Array: TypeAlias = npt.NDArray[Any]
Corner: TypeAlias = Literal["top left", "top right", "bottom left", "bottom right"]

_WHITE, _DARK = (255, 255, 255), (32, 38, 46)


def label(picture: Array, text: str, corner: Corner = "top left") -> Array:
    """Write lines of text into a corner: white letters with a dark edge, which can be read on every picture.

    picture : (H, W, 3 or 4), uint8, or floats whose 0 to 1 are the numbers of a screen; the result has its dtype.
    Letters are a 22nd of the shorter side high, and smaller where the text would not fit. Pictures with a side below
    80 pixels have no room for text, and are returned without.
    """
    height, width = picture.shape[:2]
    if min(width, height) < 80:
        return np.array(picture)
    lines = text.split("\n")
    size = float(np.clip(round(min(width, height) / 22), 10, 40))
    blank = np.zeros((height, width, 3), np.uint8)
    while size > 8 and max(Lettering(blank, _WHITE, _DARK, size).width(t) for t in lines) > (
        width - size
    ):
        size -= 1
    vertical, horizontal = corner.split()
    x = size / 2 if horizontal == "left" else width - size / 2
    step = 1.25 * size
    first = size / 2 if vertical == "top" else height - size / 2 - step * len(lines)
    # The letters are drawn on black and on white: the two pictures tell how much of the ground each pixel keeps.
    sheets = []
    for ground in (0, 255):
        sheet = Lettering(np.full((height, width, 3), ground, np.uint8), _WHITE, _DARK, size)
        for number, line in enumerate(lines):
            anchor = "la" if horizontal == "left" else "ra"
            sheet.write(line, (x, first + step * number), anchor=anchor)
        sheets.append(sheet.picture.astype(np.float64) / 255)
    dark, light = sheets
    kept = light - dark
    scale = 255 if picture.dtype == np.uint8 else 1
    color = kept * (picture[..., :3].astype(np.float64) / scale) + dark
    result = np.array(picture)
    changed = (kept < 1).any(axis=-1)
    written = color[changed] * scale
    result[changed, :3] = (np.rint(written) if scale == 255 else written).astype(picture.dtype)
    if picture.shape[2] == 4:
        result[changed, 3] = scale
    return result


def panels(rows: Sequence[Sequence[tuple[str, Array]]]) -> Array:
    """Put rows of pictures of one size together, each with its name in the top left corner."""
    return np.concatenate(
        [np.concatenate([label(shown, name) for name, shown in row], axis=1) for row in rows]
    )
