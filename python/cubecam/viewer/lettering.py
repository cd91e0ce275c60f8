"""Text and plates on a picture, with the typeface that comes with Pillow."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

if TYPE_CHECKING:
    Color = tuple[int, int, int]
    Box = tuple[float, float, float, float]


class Lettering:
    """Writes on an 8-bit picture (height, width, 3); `picture` gives the result."""

    def __init__(
        self, pixels: npt.NDArray[np.uint8], ink: Color, paper: Color, unit: float | None = None
    ) -> None:
        from PIL import Image, ImageDraw

        self._image = Image.fromarray(np.ascontiguousarray(pixels))
        #: Pillow's own drawing, for lines.
        self.draw = ImageDraw.Draw(self._image, "RGBA")
        self.ink, self.paper = ink, paper
        self.size = self._image.size
        #: The height of letters in pixels, from which all distances follow.
        self.unit = unit or float(np.clip(round(min(self.size) / 32), 11, 40))

    def _font(self, scale: float = 1.0) -> Any:
        from PIL import ImageFont

        return ImageFont.load_default(max(8, round(self.unit * scale)))

    def width(self, text: str, scale: float = 1.0) -> float:
        """Measure a line in pixels."""
        return float(self._font(scale).getlength(text))

    def wrapped(self, text: str, width: float) -> list[str]:
        """Break a text into lines of at most this width in pixels."""
        lines: list[str] = []
        for word in text.split():
            longer = f"{lines[-1]} {word}" if lines else word
            if lines and self.width(longer) <= width:
                lines[-1] = longer
            else:
                lines.append(word)
        return lines

    def write(
        self,
        text: str,
        at: tuple[float, float],
        *,
        anchor: str = "la",
        scale: float = 1.0,
        plain: bool = False,
        ink: Color | None = None,
    ) -> None:
        """Write a line; unless `plain`, white with a dark edge, which can be read on any picture."""
        font = self._font(scale)
        place = (round(float(at[0])), round(float(at[1])))
        if plain:
            self.draw.text(place, text, ink or self.ink, font, anchor=anchor)
            return
        edge = max(1, round(self.unit * scale / 9))
        self.draw.text(
            place, text, "white", font, anchor=anchor, stroke_width=edge, stroke_fill="#20262e"
        )

    def plate(self, box: Box) -> None:
        """Darken or lighten a box, so that plain text on it can be read."""
        self.draw.rounded_rectangle(box, self.unit * 0.3, fill=(*self.paper, 215))

    def box(self, box: Box, color: Color) -> None:
        """Fill a box with a colour."""
        self.draw.rectangle(box, fill=color)

    @property
    def picture(self) -> npt.NDArray[np.uint8]:
        """The picture, (height, width, 3)."""
        return np.asarray(self._image)
