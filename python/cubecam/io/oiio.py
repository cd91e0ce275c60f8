"""The only file that calls OpenImageIO: it reads picture files to arrays with attributes, and writes them.

OpenImageIO is imported when the first file is read or written, not with `cubecam`.
"""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import ImageError

if TYPE_CHECKING:
    from pathlib import Path

    from .pixels import Array

# OpenImageIO's names of the sample types that are read without conversion; all other types are read as float.
_STORED = {
    "uint8": "uint8",
    "uint16": "uint16",
    "uint32": "uint",
    "uint": "uint",
    "half": "half",
    "float": "float",
}
_SAMPLES = {
    "uint8": "uint8",
    "uint16": "uint16",
    "uint32": "uint",
    "float16": "half",
    "float32": "float",
}


@dataclass(frozen=True)
class Picture:
    """The contents of a file: (H, W, C) pixels, row 0 on top, C of 1, 3 or 4, and its attributes by name."""

    pixels: Array
    attributes: dict[str, Any] = field(default_factory=dict)

    @property
    def environment(self) -> str:
        """ "cube" or "latlong" where the file says that it is an OpenEXR environment map, else ""."""
        text = str(self.attributes.get("textureformat", ""))
        return {"CubeFace Environment": "cube", "LatLong Environment": "latlong"}.get(text, "")


def read(path: Path) -> Picture:
    """Read the first picture of a file.

    Raises
    ------
    ImageError
        When the contents are not a picture that OpenImageIO reads, or end early.
    """
    import OpenImageIO as oiio

    config = oiio.ImageSpec()
    # Without this attribute colour is multiplied by alpha, and the colour where alpha is 0 is lost.
    config.attribute("oiio:UnassociatedAlpha", 1)
    file = oiio.ImageInput.open(str(path), config)
    if file is None:
        raise ImageError(
            f"{path}: expected a picture file (EXR, HDR, PNG, JPEG, ...): {_reason(oiio)}"
        )
    try:
        spec = file.spec()
        stored = _STORED.get(str(spec.format), "float")
        pixels = file.read_image(0, 0, 0, spec.nchannels, stored)
        problem = _reason(file)
    finally:
        file.close()
    # OpenImageIO fills a JPEG that ends early with grey, and reports the error only by a message.
    if pixels is None or "remature end" in problem:
        raise ImageError(f"{path}: the picture is broken or ends early: {problem}")
    try:
        attributes: dict[str, Any] = {item.name: item.value for item in spec.extra_attribs}
        names = list(spec.channelnames)
    except UnicodeDecodeError as error:
        raise ImageError(f"{path}: expected names in UTF-8 in the header, got {error}") from error
    pixels = _window(np.atleast_3d(pixels), spec)
    pixels = _by_name(pixels, names, path)
    return Picture(_upright(pixels, int(attributes.get("Orientation", 1))), attributes)


def encode(
    extension: str,
    pixels: Array,
    attributes: dict[str, Any] | None = None,
) -> bytes:
    """Turn (H, W, C) pixels into the bytes of a file of the kind that `extension` (".png") names.

    The file is made in memory: libjpeg ends the process on a full disk and libpng says nothing, whereas
    Python's own write raises an OSError.
    """
    import OpenImageIO as oiio

    height, width, channels = pixels.shape
    file = oiio.ImageOutput.create("picture" + extension)
    if file is None:
        raise ImageError(f"cannot write {extension} files: {_reason(oiio)}")
    spec = oiio.ImageSpec(width, height, channels, _SAMPLES[pixels.dtype.name])
    for name, value in (attributes or {}).items():
        spec.attribute(name, value)
    with _MemoryFile(extension) as memory:
        done = file.open(memory.name, spec) and file.write_image(np.ascontiguousarray(pixels))
        done = file.close() and done
        problem = _reason(file)
        # An EXR's last bytes are written when the writer goes, not when it is closed.
        del file
        if not done:
            raise ImageError(
                f"cannot write {width} x {height} x {channels} pixels as {extension}: {problem}"
            )
        return memory.read()


class _MemoryFile:
    """A file without a place on disk that a library can open by name; a temporary one where there is no memfd."""

    def __init__(self, extension: str) -> None:
        if hasattr(os, "memfd_create"):
            self._fd = os.memfd_create("cubecam")
            self.name, self._on_disk = f"/proc/self/fd/{self._fd}", False
        else:
            self._fd, self.name = tempfile.mkstemp(suffix=extension)
            self._on_disk = True

    def read(self) -> bytes:
        with open(self._fd, "rb", closefd=False) as file:
            file.seek(0)
            return file.read()

    def __enter__(self) -> _MemoryFile:
        return self

    def __exit__(self, *_: object) -> None:
        os.close(self._fd)
        if self._on_disk:
            os.unlink(self.name)


def _reason(teller: Any) -> str:
    """What OpenImageIO, or one of its files, says went wrong."""
    try:
        message = str(teller.geterror())
    except UnicodeDecodeError:  # it quotes a broken file's bytes
        message = ""
    return " ".join(message.split()) or "no reason given"


def _window(pixels: Array, spec: Any) -> Array:
    """Place an EXR's data window in its display window, which is the picture; outside the data it is 0."""
    full = (spec.full_width, spec.full_height)
    left, top = spec.x - spec.full_x, spec.y - spec.full_y
    height, width = pixels.shape[:2]
    if (left, top, width, height) == (0, 0, *full) or min(full) <= 0:
        return pixels
    picture = np.zeros((full[1], full[0], pixels.shape[2]), pixels.dtype)
    rows = slice(max(top, 0), min(top + height, full[1]))
    columns = slice(max(left, 0), min(left + width, full[0]))
    if rows.start < rows.stop and columns.start < columns.stop:
        picture[rows, columns] = pixels[
            rows.start - top : rows.stop - top, columns.start - left : columns.stop - left
        ]
    return picture


def _by_name(pixels: Array, names: list[str], path: Path) -> Array:
    """Pick red, green, blue and alpha by name: EXR channels of mixed types come in another order."""
    layers = [name.rpartition(".")[0] for name in names]
    lower = [name.lower() for name in names]
    for layer in dict.fromkeys(["", *layers]):
        prefix = layer.lower() + "." if layer else ""
        found = [lower.index(prefix + c) for c in "rgb" if prefix + c in lower]
        if len(found) == 3:
            alpha = [lower.index(prefix + "a")] if prefix + "a" in lower else []
            return pixels[:, :, found + alpha]
    if len(names) in (1, 3, 4):
        return pixels
    if len(names) == 2 and "a" in lower:
        alpha_at = lower.index("a")
        return pixels[:, :, [1 - alpha_at] * 3 + [alpha_at]]
    raise ImageError(
        f"{path}: expected 1, 3 or 4 channels, or some named R, G, B; got {', '.join(names)}"
    )


def _upright(pixels: Array, orientation: int) -> Array:
    """Turn a photograph as its Exif orientation (TIFF 6.0, tag 274) says, so that row 0 is its top."""
    if 5 <= orientation <= 8:
        pixels = pixels.transpose(1, 0, 2)
    if orientation in (3, 4, 7, 8):
        pixels = pixels[::-1]
    if orientation in (2, 3, 6, 7):
        pixels = pixels[:, ::-1]
    return np.ascontiguousarray(pixels)
