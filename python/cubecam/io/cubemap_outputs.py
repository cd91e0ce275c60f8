"""Write outputs of a capture, such as distances, normals and ids, to EXR files: `CubeMap.save(path, output=)`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from . import formats
from .cubemap_names import FACE_NAMES, Source, check_openexr
from .files import as_path
from .stored_as import StoredAs

if TYPE_CHECKING:
    from pathlib import Path

    from .._core import CubeMap
    from ..typing import Center, Convention, FileLayout
    from .pixels import Array


def encode_output(
    cube: CubeMap,
    path: Source,
    six: list[Path] | None,
    output: str,
    *,
    layout: FileLayout | None,
    convention: Convention | None,
    width: int | None,
    center: Center,
) -> dict[Path, bytes]:
    """Give the contents of the one file at `path`, or of the six files, with the arguments of `save_cubemap`.

    Raises
    ------
    ValueError
        For an output that the cube does not have, a name that does not end in .exr, an output of two channels,
        whole numbers below 0, or a layout that does not go with the number of files.
    """
    if six is not None and layout not in (None, "faces"):
        raise ValueError(f'layout: expected "faces" or None for six files, got {layout!r}')
    if layout == "faces" and six is None:
        raise ValueError(
            f'layout "faces": expected six paths or a name with {{face}}, got {path!r}'
        )
    paths = [as_path(path)] if six is None else six
    for path in paths:
        if path.suffix.lower() != ".exr":
            raise ValueError(
                f"output {output!r}: expected a file name that ends in .exr, since other kinds hold colours, "
                f"got {path.name!r}"
            )
    pictures: Array
    attributes: dict[str, Any] = {}
    chosen = "inside" if layout == "openexr" else convention or "gl"
    if six is not None or layout == "faces":
        stored = [StoredAs(layout="faces", convention=chosen, face=name) for name in FACE_NAMES[0]]
        pictures = cube.to_convention(chosen, output=output)
    elif layout == "equirect":
        stored = [StoredAs(layout=layout, center=center)]
        pictures = cube.to_equirect(width=width, center=center, output=output)[None]
    else:
        if layout == "openexr":
            check_openexr(convention)
            attributes["textureformat"] = "CubeFace Environment"
        stored = [StoredAs(layout=layout or "cross", convention=chosen)]
        pictures = cube.to_layout(layout or "cross", convention=chosen, output=output)[None]
    if pictures.ndim == 4 and pictures.shape[-1] == 2:
        raise ValueError(
            f"output {output!r}: expected 1, 3 or 4 channels, which picture files hold, got 2"
        )
    if pictures.dtype == np.uint8:  # as a float of a file, such a number would be divided by 255
        pictures = pictures.astype(np.uint32)
    return {
        path: formats.encode(path, picture, attributes=attributes | told.attributes())
        for path, picture, told in zip(paths, pictures, stored, strict=True)
    }
