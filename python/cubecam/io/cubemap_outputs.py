"""Write outputs of a capture, such as distances, normals and ids, to EXR files: `CubeMap.save(path, output=)`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from .._checks import text_of
from . import formats
from .cubemap_names import Source, check_openexr
from .files import as_path
from .stored_as import stored_files

if TYPE_CHECKING:
    from pathlib import Path

    from .._core import CubeMap
    from ..typing import Center, Convention, Layout
    from .pixels import Array


def encode_output(
    cube: CubeMap,
    path: Source,
    six: list[Path] | None,
    output: str,
    *,
    layout: Layout | None,
    convention: Convention | None,
    width: int | None,
    center: Center,
) -> dict[Path, bytes]:
    """Give the contents of the one file at `path`, or of the six files, with the arguments of `save_cubemap`.

    Raises
    ------
    ValueError
        For an output that the cube does not have, a name that does not end in .exr, an output of two channels,
        or whole numbers below 0.
    """
    paths = [as_path(path)] if six is None else six
    for path in paths:
        if path.suffix.lower() != ".exr":
            raise ValueError(
                f"output {output!r}: expected a file name that ends in .exr, since other kinds hold colours, "
                f"got {text_of(path.name)}"
            )
    pictures: Array
    attributes: dict[str, Any] = {}
    chosen = "inside" if layout == "openexr" else convention or "gl"
    if six is not None:
        pictures = cube.to_convention(chosen, output=output)
    elif layout == "equirect":
        pictures = cube.to_equirect(width=width, center=center, output=output)[None]
    else:
        if layout == "openexr":
            check_openexr(convention)
            attributes["textureformat"] = "CubeFace Environment"
        pictures = cube.to_layout(layout or "cross", convention=chosen, output=output)[None]
    if pictures.ndim == 4 and pictures.shape[-1] == 2:
        raise ValueError(
            f"output {text_of(output)}: expected 1, 3 or 4 channels, which picture files hold, got 2"
        )
    if pictures.dtype == np.uint8:  # as a float of a file, such a number would be divided by 255
        pictures = pictures.astype(np.uint32)
    return {
        path: formats.encode(path, picture, attributes=attributes | told.attributes())
        for path, picture, told in zip(
            paths, pictures, stored_files(six, layout, chosen, center), strict=True
        )
    }
