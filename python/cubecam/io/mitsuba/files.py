"""The files beside a Mitsuba scene, collected before any is written; the textures that show them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import Image
from .. import formats
from ..left_out import LeftOut
from ..pixels import on_color, srgb_decode, to_float32

Array = npt.NDArray[Any]
Json = dict[str, Any]


class Files:
    """Names of files and their contents; equal pictures are one file."""

    def __init__(self, target: Path) -> None:
        self._target = target
        self._known: dict[bytes, Path] = {}
        self._pictures: dict[tuple[tuple[int, ...], bytes], str] = {}
        self._counts: dict[str, int] = {}
        self.contents: dict[Path, bytes] = {}

    def add(self, data: bytes, extension: str) -> str:
        """Note the contents of a file, and return its path."""
        path = self._known.get(data)
        if path is None:
            number = self._counts.get(extension, 0)
            self._counts[extension] = number + 1
            path = self._target.with_name(f"{self._target.stem}-{number}{extension}")
            self._known[data] = path
            self.contents[path] = data
        return str(path)

    def picture(self, pixels: Array) -> str:
        """Note a picture (H, W, C) of linear floats as an EXR file, and return its path."""
        found = pixels.astype(np.float32)
        key = (
            found.shape,
            found.tobytes(),
        )  # the bytes of a file tell the second in which it was made
        if key not in self._pictures:
            self._pictures[key] = self.add(formats.encode(Path("picture.exr"), found), ".exr")
        return self._pictures[key]


class Textures:
    """Bitmaps of Mitsuba that show images of cubecam."""

    def __init__(self, files: Files, left_out: LeftOut) -> None:
        self._files = files
        self._left_out = left_out

    def color(self, image: Image, factor: Array, *, decoded: bool) -> Json:
        """Return a map of colours: the image times a factor (3,); `decoded`: 8-bit sRGB is decoded."""
        if decoded and _is_coded(image) and image.channels == 3 and (factor == 1).all():
            data = formats.encode(Path("picture.png"), np.asarray(image.pixels))
            return {**self._sampler(image), "filename": self._files.add(data, ".png")}
        return self._bitmap(image, numbers_of(image, decoded)[..., :3] * factor, raw=False)

    def values(self, image: Image, pixels: Array) -> Json:
        """Return a map of numbers: pixels (H, W, 1) or (H, W, 3) made from those of the image."""
        return self._bitmap(image, pixels, raw=True)

    def _bitmap(self, image: Image, pixels: Array, raw: bool) -> Json:
        return {
            **self._sampler(image),
            "filename": self._files.picture(_at_least_two(pixels)),
            "raw": raw,
        }

    def _sampler(self, image: Image) -> Json:
        wraps = [image.wrap] if isinstance(image.wrap, str) else list(image.wrap)
        if len(set(wraps)) > 1:
            self._left_out.add(
                "a Mitsuba texture has one wrap mode for both axes: that of u is used"
            )
        return {
            "type": "bitmap",
            "filter_type": "nearest" if image.mag_filter == "nearest" else "bilinear",
            "wrap_mode": wraps[0],
            # Without this Mitsuba keeps 8-bit pictures in half precision.
            "format": "variant",
        }


def numbers_of(image: Image, decoded: bool) -> Array:
    """Return the pixels (H, W, 3 or 4) of an image as float32; grey becomes RGB."""
    pixels = to_float32(np.asarray(image.pixels))
    if pixels.shape[2] == 1:
        pixels = np.repeat(pixels, 3, axis=2)
    return on_color(srgb_decode, pixels) if decoded and _is_coded(image) else pixels


def _is_coded(image: Image) -> bool:
    return image.dtype == np.uint8 and image.encoding == "srgb"


def _at_least_two(pixels: Array) -> Array:
    """Mitsuba filters pictures of one row or column to two by a wide filter; repeated, they look the same."""
    height, width = pixels.shape[:2]
    return np.repeat(np.repeat(pixels, 2 if height < 2 else 1, 0), 2 if width < 2 else 1, 1)
