"""Write cubemaps to files: the method `CubeMap.save`."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from .._calls import checked_call
from .._checks import text_of
from .._core import CubeMap
from ..typing import Center, Compression, Convention, FileLayout, Tonemap
from . import formats
from .babylon_env import encode_env
from .cube_files import SUFFIXES, encode_cube
from .cubemap_names import (
    Source,
    check_names,
    check_openexr,
    layout_name,
    picture_layout,
    six_paths,
)
from .cubemap_outputs import encode_output
from .files import as_path
from .pixels import Array
from .screen import Clipping, check_look, curve_for
from .sh_file import encode_sh
from .stored_as import stored_files
from .writing import write_files

if TYPE_CHECKING:
    from pathlib import Path


@checked_call
def save_cubemap(
    cube: CubeMap,
    path: Source,
    *,
    layout: FileLayout | None = None,
    convention: Convention | None = None,
    width: int | None = None,
    center: Center = "-z",
    exposure: float = 0.0,
    tonemap: Tonemap | None = "neutral",
    srgb: bool | None = None,
    half: bool = False,
    output: str = "color",
    compression: Compression | None = None,
) -> None:
    """Write a cubemap as one picture or six files. The method `CubeMap.save`.

    A file of 8 bits holds what a screen shows: linear floats are mapped by the tone curve, then everything linear is
    sRGB-encoded. EXR and HDR hold linear numbers; KTX2 and DDS hold the cube's own, with filtered levels
    (`CubeMap.levels` of `prefilter`), which other kinds leave out.

    Parameters
    ----------
    path : path, sequence of six paths, or a name with {face}
        The extension names the kind of file, as in `save_image`, or .ktx2, .dds, .env (Babylon.js: filtered by
        roughness, in Babylon's own steps) or .json (the numbers of `sh`). {face} becomes px nx py ny pz nz. {level}
        becomes 0, 1, ...: a name such as "sky/{level}_{face}.hdr" stands for six files of each filtered level.
    layout : str, optional
        "cross", "vertical_cross", "row", "column", "equirect" or "openexr" for one picture ("cross" if None);
        "faces" or None for six files. "openexr" is OpenEXR's environment cube: a column of "inside" faces with
        samples on the borders and the `envmap` attribute, .exr only.
    convention : {"gl", "inside", "three"}, optional
        How the faces are stored; "gl" by default ("inside" for "openexr").
    width : int, optional
        Width of an equirect in pixels, an even number. None: 4 times the face size.
    center : {"-z", "+z", "+x", "-x"}
        The direction in the middle of an equirect.
    exposure : float
        Stops: colours are multiplied by ``2**exposure``.
    tonemap : {"neutral", "reinhard", "aces"} or None
        The curve for linear floats, see `to_screen`. None clips, with a warning.
    srgb : bool, optional
        False writes the numbers as they are; None and True as described above.
    half : bool
        True stores an EXR with 16 bits a number.
    output : str
        "color", or the name of an output in `outputs`, such as "distance", "normal" and "id". Its numbers are written
        to .exr as they are, as floats or whole numbers of 32 bits, in any layout, and never mixed (`to_equirect`).
    compression : {"zstd", "zlib"}, optional
        How the levels of a .ktx2 file are packed. "zstd" needs the package of the extra "ktx2".

    Raises
    ------
    OSError
        If a folder does not exist or may not be written, or the disk is full. The old files stay as they were.
    ValueError
        For unknown names, options that do not go together, numbers that the file cannot hold, or an output that the
        cube does not have.

    Notes
    -----
    Cells of a cross without a face are 0. A cubemap of float16 is written to EXR as half.

    A KTX2 or DDS file holds uint8 as it is, in a format of the cube's `encoding`, and floats as light; three channels
    become four. Level k has N >> k texels an edge; filtered levels of other sizes are resized. The file says
    that its levels are filtered (docs/conventions.md), and `load_cubemap` reads them back. A cube with ``mipmaps=True``
    and without filtered levels gets plain mipmaps, all others one level. Fewer levels than N has powers of two keep the
    last one from becoming too small: `prefilter` with log2(N) - 3 of them ends at 16 texels.

    Examples
    --------
    >>> import cubecam as cc, tempfile, pathlib
    >>> folder = pathlib.Path(tempfile.mkdtemp())
    >>> cube = cc.load_environment(cc.sample_data("forest.exr"), size=32)
    >>> cube.save(folder / "probe.exr", layout="cross", convention="inside")
    >>> cc.load_cubemap(folder / "probe.exr", convention="inside") == cube
    True
    """
    named = layout_name(layout)
    check_names(convention, center)
    if isinstance(path, (str, os.PathLike)) and "{level}" in str(as_path(path)):
        _save_levels(
            cube, str(as_path(path)), layout=layout, convention=convention, width=width, center=center,
            exposure=exposure, tonemap=tonemap, srgb=srgb, half=half, output=output,
        )  # fmt: skip
        return
    paths = six_paths(path, for_reading=False)
    if paths is not None and len(set(paths)) < 6:
        raise ValueError(f"expected six different paths, got {[str(path) for path in paths]}")
    wanted = picture_layout(named, paths, path)
    if width is not None and wanted != "equirect":
        raise ValueError(
            f'width: expected with layout="equirect" only, got it with {text_of(layout)}'
        )
    check_look(exposure, tonemap, srgb)
    suffix = "" if paths is not None else as_path(path).suffix.lower()
    if compression is not None and suffix != ".ktx2":
        raise ValueError(f'compression: expected with ".ktx2" only, got {text_of(compression)}')
    if suffix in (".env", ".json"):
        data = encode_env(cube) if suffix == ".env" else encode_sh(cube)
        write_files({as_path(path): data})
        return
    if suffix in SUFFIXES:
        if wanted is not None or output != "color" or srgb:
            raise ValueError(
                f"layout, output, srgb: expected none of them for {suffix} files, which hold faces in the numbers of "
                f"the cube, got {text_of(wanted)}, {text_of(output)}, {text_of(srgb)}"
            )
        data = encode_cube(
            cube,
            suffix,
            convention=convention,
            exposure=exposure,
            half=half,
            compression=compression,
        )
        write_files({as_path(path): data})
        return
    if output != "color":
        if half or exposure != 0 or srgb:
            raise ValueError(
                f'half, exposure, srgb: expected with output="color" only, got output={text_of(output)}, '
                "whose numbers are written as they are"
            )
        contents = encode_output(
            cube, path, paths, output,
            layout=wanted, convention=convention, width=width, center=center,
        )  # fmt: skip
        write_files(contents)
        return
    half = half or cube.dtype == np.float16
    kept_as = "inside" if wanted == "openexr" else convention or "gl"
    stored = stored_files(paths, wanted, kept_as, center)
    # What the cube's own numbers are decides, even where resampling makes floats of whole numbers.
    curve = curve_for(cube, cube.faces, tonemap)

    clipping = Clipping()

    def ready(pixels: Array, light: bool) -> Array:
        with clipping.gathered():
            return formats.for_file(pixels, cube.encoding, light, exposure, curve, srgb)

    if paths is not None:
        faces = cube.to_convention(convention or "gl")
        contents = {
            target: formats.encode(
                target,
                ready(face, formats.holds_light(target, cube.faces)),
                half=half,
                attributes=told.attributes(),
            )
            for target, face, told in zip(paths, faces, stored, strict=True)
        }
        clipping.warn()
        write_files(contents)
        return
    target = as_path(path)
    attributes: dict[str, Any] = {}
    # Numbers of a screen are 8-bit and hold no NaN, so that they lose their alpha later.
    light = formats.holds_light(target, cube.faces)
    shown = srgb is not False and not light
    source = cube if shown else _storable(cube, target)
    # If the file rounds the numbers, they are not rounded before, since two roundings would add up.
    kept = exposure == 0 and (srgb is False or cube.encoding == "srgb")
    exact = formats.stores(target, cube.dtype) and (kept or light)
    resampled = cube.dtype if exact else np.dtype(np.float32)
    if wanted == "equirect":
        picture = ready(source.to_equirect(width=width, center=center, dtype=resampled), light)
    elif wanted == "openexr":
        if target.suffix.lower() != ".exr":
            raise ValueError(
                f'layout "openexr": expected a file name that ends in .exr, got {text_of(target.name)}'
            )
        check_openexr(convention)
        picture = ready(source.to_layout("openexr", dtype=resampled), light)
        # OpenImageIO writes the attribute envmap from this text, and rejects a number under that name.
        attributes["textureformat"] = "CubeFace Environment"
    elif shown:
        # The six faces alone are mapped and encoded, since half of a cross is empty.
        source = _storable(CubeMap(ready(cube.faces, light)), target)
        picture = source.to_layout(wanted or "cross", convention=convention or "gl")
    else:
        picture = source.to_layout(wanted or "cross", convention=convention or "gl")
        picture = ready(picture, light)
    attributes |= stored[0].attributes()
    encoded = formats.encode(target, picture, half=half, attributes=attributes)
    clipping.warn()
    write_files({target: encoded})


def _save_levels(cube: CubeMap, name: str, **options: Any) -> None:
    """Write each filtered level under its number."""
    if options["output"] != "color":
        raise ValueError(
            f'output: expected "color" for files of levels, got {text_of(options["output"])}'
        )
    for k, level in enumerate(cube.levels):
        faces = CubeMap(level, mipmaps=False, encoding=cube.encoding)
        save_cubemap(faces, name.replace("{level}", str(k)), **options)


def _storable(cube: CubeMap, target: Path) -> CubeMap:
    """Remove an alpha of 1 if the file cannot hold alpha, before a layout adds cells with an alpha of 0."""
    if cube.channels != 4 or formats.holds_alpha(target):
        return cube
    faces = cube.faces
    return CubeMap(faces[..., :3], encoding=cube.encoding) if formats.is_opaque(faces) else cube
