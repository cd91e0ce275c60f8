"""A small picture of what was made, in the terminal: by its graphics where it has any, else in blocks of colour."""

from __future__ import annotations

import importlib.util
import sys
from typing import TYPE_CHECKING, Any

from .help import option

if TYPE_CHECKING:
    from collections.abc import Callable

    import numpy as np
    import numpy.typing as npt

__all__ = ["preview", "preview_option"]

_WIDTH, _HEIGHT = 64, 20  # of the picture, at most, in characters


def preview_option(function: Callable[..., Any]) -> Callable[..., Any]:
    """Declare `no_preview`."""
    return option(
        "--no-preview", is_flag=True, help="Show no small picture of the result in the terminal."
    )(function)


def preview(pixels: npt.NDArray[np.uint8]) -> None:
    """Show uint8 (H, W, 3 or 4) if standard output is a terminal with colours; what fails shows nothing."""
    if sys.stdout is None or not sys.stdout.isatty():
        return
    from rich.console import Console

    from ..pictures.cards import Shot
    from ..pictures.rich_text import colorful, half_blocks

    console = Console()
    if not colorful(console) or console.width < 20:
        return
    height, width = pixels.shape[:2]
    # A character is about twice as high as wide.
    columns = max(2, min(_WIDTH, console.width - 1, round(2 * _HEIGHT * width / height)))
    picture: Any = _graphics(pixels, columns) or half_blocks(Shot(_with_alpha(pixels)), columns)
    console.print(picture)


def _graphics(pixels: npt.NDArray[np.uint8], columns: int) -> Any:
    """Give a picture of real pixels where textual-image is installed and the terminal can show them."""
    if importlib.util.find_spec("textual_image") is None:
        return None
    try:
        from PIL import Image
        from textual_image.renderable import Image as Renderable
        from textual_image.renderable import SixelImage, TGPImage

        if Renderable not in (SixelImage, TGPImage):
            return None
        picture = Image.fromarray(pixels)
        picture.thumbnail((16 * columns, 32 * columns))
        return Renderable(picture, width=columns)
    except Exception:  # a terminal that answers in an unknown way still gets the blocks
        return None


def _with_alpha(pixels: npt.NDArray[np.uint8]) -> npt.NDArray[np.uint8]:
    import numpy as np

    if pixels.shape[2] == 4:
        return pixels
    return np.concatenate([pixels, np.full_like(pixels[..., :1], 255)], axis=2)
