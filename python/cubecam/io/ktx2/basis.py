"""Basis Universal textures, ETC1S and UASTC, by the package opengl-basisu."""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from ..._core import ImageError
from ..picture_kinds import most_bytes

if TYPE_CHECKING:
    from ..pixels import Array
    from .header import Header


def decode(header: Header, data: bytes, layer: int, count: int) -> list[Array]:
    """Give the first `count` levels of a layer, each (faces, H, W, 3 or 4) uint8.

    Raises
    ------
    ImageError
        If the package is missing, or refuses the file.
    """
    try:
        basisu: Any = import_module("opengl_basisu")
    except ImportError:
        raise ImageError(
            f"expected the package opengl-basisu, which reads Basis Universal ({header.basis}), to be installed: "
            "pip install 'cubecam[ktx2]'"
        ) from None
    pixels = header.width * header.height * header.faces
    most = most_bytes(None, len(data), pixels, 4)
    if pixels * 4 > most:
        raise ImageError(
            f"expected at most {most} bytes of numbers in {len(data)} bytes of {header.basis}, got {pixels * 4}"
        )
    try:
        texture = basisu.open(data)
        channels = 4 if texture.has_alpha else 3
        return [
            np.stack(
                [
                    texture.transcode("rgba8", level, face, layer).data[..., :channels]
                    for face in range(header.faces)
                ]
            )
            for level in range(count)
        ]
    except (ValueError, IndexError) as error:
        raise ImageError(f"expected a texture of {header.basis}, got: {error}") from None
