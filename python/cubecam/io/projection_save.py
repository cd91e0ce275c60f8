"""Write a picture that a projection makes of a cube, for `cubecam convert`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import formats
from .cubemap_save import _storable
from .files import as_path
from .screen import Clipping, check_look, curve_for
from .writing import write_files

if TYPE_CHECKING:
    from collections.abc import Callable

    from .._core import CubeMap
    from ..typing import Pixels, Tonemap
    from .files import PathLike


def save_projection(
    cube: CubeMap,
    path: PathLike,
    projected: Callable[[CubeMap, np.dtype[Any]], Pixels],
    *,
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    half: bool = False,
) -> None:
    """Write a picture that `projected(cube, dtype)` makes, as `save_cubemap` writes a panorama."""
    check_look(exposure, tonemap, None)
    target = as_path(path)
    light = formats.holds_light(target, cube.faces)
    curve = curve_for(cube, cube.faces, tonemap)
    exact = formats.stores(target, cube.dtype) and (
        light or (exposure == 0 and cube.encoding == "srgb")
    )
    # An alpha of 1 goes before the picture gets corners with an alpha of 0, which a JPEG cannot hold.
    source = _storable(cube, target)
    picture = projected(source, cube.dtype if exact else np.dtype(np.float32))
    clipping = Clipping()
    with clipping.gathered():
        ready = formats.for_file(picture, cube.encoding, light, exposure, curve, None)
    encoded = formats.encode(target, ready, half=half or cube.dtype == np.float16)
    clipping.warn()
    write_files({target: encoded})
