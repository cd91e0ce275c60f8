"""The pictures of a model: decoded from the bytes of their files, each once, several at a time."""

from __future__ import annotations

import os
from collections.abc import Callable, Hashable, Iterable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from .._core import FileError, ImageError, MeshError
from .picture_files import decode_picture
from .pixels import Array, on_color, srgb_decode

#: What the pictures of any model may become, in bytes of numbers: this many, and so many for each byte of their files.
#: A file may name one tiny picture of one colour thousands of times.
_FREE_BYTES = 512 << 20
_RATIO = 256

Key = Hashable


class ModelPictures:
    """Pictures by key. `source(key)` gives the bytes of a picture file, and raises `FileError` if there are none."""

    def __init__(self, source: Callable[[Key], bytes]) -> None:
        self._source = source
        self._done: dict[Key, Array | FileError] = {}
        self._files = 0
        self._numbers = 0

    def prefetch(self, keys: Iterable[Key]) -> None:
        """Decode pictures at the same time; what is wrong with one is raised by `pixels`."""
        todo = [key for key in dict.fromkeys(keys) if key not in self._done]
        # One after another, since the source is no part of what several threads may do.
        files: dict[Key, bytes] = {}
        for key in todo:
            try:
                files[key] = self._source(key)
            except FileError as error:
                self._done[key] = error
        workers = min(len(files), os.cpu_count() or 1, 8)
        if workers > 1:
            with ThreadPoolExecutor(workers) as pool:
                for key, found in zip(files, pool.map(_decoded, files.values()), strict=True):
                    self._keep(key, found, len(files[key]))
        else:
            for key, data in files.items():
                self._keep(key, _decoded(data), len(data))

    def pixels(self, key: Key) -> Array:
        """Return the pixels (H, W, C) of a picture as its file has them, row 0 on top, without a copy.

        Raises
        ------
        FileError
            If the picture cannot be read.
        """
        self.prefetch([key])
        found = self._done[key]
        if isinstance(found, FileError):
            raise found
        return found

    def _keep(self, key: Key, found: Array | FileError, length: int) -> None:
        self._done[key] = found
        self._files += length
        if isinstance(found, FileError):
            return
        self._numbers += found.nbytes
        most = _FREE_BYTES + _RATIO * self._files
        if self._numbers > most:
            raise MeshError(
                f"expected pictures of at most {most} bytes of numbers in {self._files} bytes of files, got more"
            )


def _decoded(data: bytes) -> Array | FileError:
    try:
        pixels = decode_picture(data).pixels
    except FileError as error:
        return error
    if pixels.dtype.kind == "f" and np.isnan(pixels).any():
        return ImageError("expected numbers, got NaN")
    return pixels


def numbers_for(pixels: Array, *, color: bool) -> Array:
    """Turn pixels of a file into those of an `Image`: 8 bits and floats stay as they are, other integers become floats.

    Those of a colour are sRGB (section 3.9.2 of glTF 2.0); an `Image` of floats is linear, so that they are decoded.
    """
    if pixels.dtype == np.uint8 or pixels.dtype.kind == "f":
        return pixels
    values = np.asarray(pixels / np.float32(np.iinfo(pixels.dtype).max), np.float32)
    return on_color(srgb_decode, values) if color else values
