"""Pictures of results (cubemaps, frames, images): the same numbers as in files (`to_screen`)."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from .._core import CubeMap
from ..io import oiio
from ..io.images import encode_picture
from ..io.screen import to_screen
from ..typing import Tonemap

if TYPE_CHECKING:
    import numpy.typing as npt

    from .._core import Frame, Image

# A notebook keeps every picture in its file: larger faces are shown at this size.
_LARGEST_FACE = 256


def cube_picture(
    cube: CubeMap, *, exposure: float = 0.0, tonemap: Tonemap | None = "neutral"
) -> npt.NDArray[np.uint8]:
    """Draw the horizontal cross as seen from inside: not mirrored, with -Z in the middle of the view.

    uint8 (3N, 4N, 4); cells that no face covers are transparent, the rest is opaque.
    """
    shown = CubeMap(to_screen(cube, exposure=exposure, tonemap=tonemap))
    picture = shown.to_layout("cross", convention="inside")
    picture = np.repeat(picture, 3, axis=2) if picture.shape[2] == 1 else picture[..., :3]
    covered = np.zeros((*picture.shape[:2], 1), np.uint8)
    covered[cube.size : 2 * cube.size] = 255
    covered[:, cube.size : 2 * cube.size] = 255
    return np.concatenate([picture, covered], axis=2)


def cube_png(cube: CubeMap) -> bytes:
    """Draw `cube_picture` at a size that a notebook can keep."""
    if cube.size > _LARGEST_FACE:
        cube = cube.resize(_LARGEST_FACE)
    return oiio.encode(".png", cube_picture(cube), {"oiio:UnassociatedAlpha": 1})


def frame_png(frame: Frame) -> bytes:
    """Draw the frame's colour, as `Frame.save` does."""
    return encode_picture(Path("frame.png"), frame)


def image_png(image: Image) -> bytes:
    """Draw a material's picture."""
    return encode_picture(Path("image.png"), image)
