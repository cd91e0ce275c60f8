"""Images: PNG files, samplers and textures (sections 3.8.2 to 3.8.4 of glTF 2.0)."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ...._core import Image
from ... import formats
from ...pixels import on_color, srgb_encode, to_float32, to_integers
from ..extras.classes import KEY, PLANS
from .document import Array, Document, Json

if TYPE_CHECKING:
    from .values import Values

_WRAPS = {"repeat": 10497, "clamp": 33071, "mirror": 33648}
_FILTERS = {
    "nearest": 9728,
    "linear": 9729,
    "nearest_mipmap_nearest": 9984,
    "linear_mipmap_nearest": 9985,
    "nearest_mipmap_linear": 9986,
    "linear_mipmap_linear": 9987,
}


@dataclass
class _Written:
    """An image with its texture, and the kinds of maps that show it: True for maps of colours."""

    image: Image
    texture: int
    shown_as: set[bool] = field(default_factory=set)


class Pictures:
    """The images of a document; each gets one texture."""

    def __init__(self, document: Document) -> None:
        self._document = document
        self._written: dict[int, _Written] = {}

    def texture(self, image: Image, colors: bool | None = None) -> int:
        """Return the texture of an image; `colors` says whether a map of colours shows it, where 8 bits are sRGB."""
        found = self._written.get(id(image))
        if found is None:
            # The source follows in `finish`, when it is known which maps show the image.
            sampler = self._document.lists.setdefault("samplers", [])
            entry = sampler_of(image)
            number = sampler.index(entry) if entry in sampler else None
            if number is None:
                number = self._document.add("samplers", entry)
            found = _Written(image, self._document.add("textures", {"sampler": number}))
            self._written[id(image)] = found
        if colors is not None:
            found.shown_as.add(colors)
        return found.texture

    def finish(self, values: Values) -> None:
        """Write the picture of each texture; what PNG or glTF cannot say of it stands in its extras."""
        shown_as: dict[tuple[int, int], set[bool]] = {}
        for written in self._written.values():
            entry = self._document.lists["textures"][written.texture]
            pixels = approximation(written.image, True in written.shown_as)
            entry["source"] = self._document.picture(png(pixels))
            # Readers may take equal pictures for one.
            shown_as.setdefault(_place(entry), set()).update(written.shown_as)
        for written in list(self._written.values()):
            image, entry = written.image, self._document.lists["textures"][written.texture]
            if _says_all(image, shown_as[_place(entry)]):
                continue
            exact = {"class": "Image", **values.properties(image, _SETTINGS)}
            if not _holds(image, True in written.shown_as):
                exact["pixels"] = values.array(image.pixels)
            entry["extras"] = {KEY: exact}


def _place(entry: Json) -> tuple[int, int]:
    return entry["source"], entry["sampler"]


_SETTINGS = tuple(name for name in PLANS["Image"].made if name != "pixels")


def sampler_of(image: Image) -> dict[str, int]:
    """Return the sampler by which an image is looked up."""
    u, v = (image.wrap, image.wrap) if isinstance(image.wrap, str) else image.wrap
    return {
        "magFilter": _FILTERS[image.mag_filter],
        "minFilter": _FILTERS[image.min_filter],
        "wrapS": _WRAPS[u],
        "wrapT": _WRAPS[v],
    }


def png(pixels: Array) -> bytes:
    """Return (H, W, C) uint8 pixels as a PNG file."""
    return formats.encode(Path("picture.png"), pixels)


def approximation(image: Image, colors: bool) -> Array:
    """Return 8-bit pixels that show an image in a map of colours (sRGB), or of other numbers."""
    pixels = image.pixels
    if _holds(image, colors):
        return pixels
    values = np.clip(np.nan_to_num(to_float32(pixels), nan=0.0, posinf=1.0, neginf=0.0), 0, 1)
    return to_integers(on_color(srgb_encode, values) if colors else values, 255)


def _holds(image: Image, colors: bool) -> bool:
    """Say whether a PNG holds the numbers of an image, and other programs see the same colours in it."""
    return image.dtype == np.uint8 and not (colors and image.encoding == "linear")


def _says_all(image: Image, shown_as: set[bool]) -> bool:
    """Say whether the file's picture becomes an equal image for whoever reads glTF alone."""
    colors = True in shown_as
    usual = "srgb" if colors else "linear"
    return _holds(image, colors) and len(shown_as) == 1 and image.encoding == usual
