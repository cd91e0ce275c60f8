"""Read cubemap files: six faces, crosses, rows, columns, panoramas and OpenEXR cubes.

The core knows the place of each texel (docs/conventions.md); this file handles names, files and attributes.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from .._calls import checked_call
from .._checks import text_of
from .._core import CubeMap, ImageError
from ..typing import Center, Convention, FileLayout, Layout
from . import formats
from .cubemap_names import (
    FACE_NAMES,
    Source,
    check_names,
    check_openexr,
    layout_name,
    picture_layout,
    six_paths,
)
from .files import existing_file
from .picture_files import Part, read_picture
from .pixels import Array, to_float32
from .stored_as import StoredAs, chosen

if TYPE_CHECKING:
    from pathlib import Path

    import numpy.typing as npt

    from ..typing import Encoding
    from .oiio import Picture

__all__ = ["load_cubemap", "load_environment"]


@checked_call
def load_cubemap(
    path: Source,
    *,
    layout: FileLayout | None = None,
    convention: Convention | None = None,
    size: int | None = None,
    center: Center | None = None,
    srgb: bool = False,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    part: Part | None = None,
    levels: bool | None = None,
) -> CubeMap:
    """Read a cubemap from six files or one.

    Parameters
    ----------
    path : path, sequence of six paths, or a name with {face}
        Six paths are in the order +X -X +Y -Y +Z -Z. In a name such as "park/{face}.jpg", {face} stands for the first
        of these rows that has all six files: px nx py ny pz nz; posx negx ...; pos-x ...; pos_x ...; xpos xneg ...;
        +x -x ...; right left top bottom (or up down) front back; rt lf up dn ft bk; 0 to 5; 1 to 6; also in capitals.
    layout : str, optional
        "cross", "vertical_cross", "row", "column", "equirect", "openexr", or "faces" for six files. None: the layout
        follows from the shape: 4:3, 3:4, 6:1, 1:6, 2:1.
    convention : {"gl", "inside", "three"}, optional
        How the faces are stored. None: as the file says, if cubecam wrote it; "inside"
        for OpenEXR environment cubes, which always are; else "gl". A panorama has no faces and no convention.
    size : int, optional
        Texels along an edge of a face. None: as stored; for a panorama, the power of two that keeps all detail.
    center : {"-z", "+z", "+x", "-x"}, optional
        The direction in the middle of a panorama. None: as the file says, if cubecam wrote it; else "-z", or "+z" for
        OpenEXR panoramas.
    srgb : bool
        Decode files of 8 and 16 bits to linear float32, as `load_image` does. False keeps their numbers, and the
        cube's `encoding` is "srgb".
    mipmaps : bool
        Let lookups in the result be trilinear.
    dtype : dtype, optional
        "uint8", "float16" or "float32". None: uint8 from 8 bits, float16 from half, else float32.
    part : int or str, optional
        Which picture of a file that holds several, as in `load_image`; of a DDS or KTX2 file with several cubemaps,
        which cubemap. Of six files, the same part of each.
    levels : bool, optional
        Whether the smaller levels of a DDS or KTX2 file are light filtered by roughness: level k of L for the roughness
        ``k / (L - 1)``. They become `CubeMap.levels`. None: as the file says, if cubecam wrote it, else False. With
        `size` there are none.

    Returns
    -------
    CubeMap
        The file's numbers in `dtype`; they are rounded to nearest if the file is resampled (panorama, OpenEXR cube,
        size). `encoding` is "srgb" for files of 8 and 16 bits that were not decoded, else "linear".

    Raises
    ------
    OSError
        If a file does not exist (FileNotFoundError), or may not be read.
    ImageError
        If a file is not a picture, ends early, or claims more pixels than its bytes can hold; for kinds that are not
        read, such as KTX2 of ASTC; for a DDS cubemap without all six faces.
    ValueError
        For a shape of no layout, faces that are not square or not of one size, unknown names, a part that the file
        does not have, or ``levels=True`` for a file without smaller levels.

    Warns
    -----
    ConventionWarning
        If cubecam wrote the file with another convention or centre than the one given here, or as another face.

    Notes
    -----
    In an EXR file with the attribute `envmap`, samples lie on the borders of the faces, by OpenEXR's rule. Such
    files are resampled; all other cubemaps are copied texel by texel.

    A DDS or KTX2 cubemap holds its faces one by one, in the order +X -X +Y -Y +Z -Z. Smaller levels that are plain
    mipmaps are not read; `mipmaps=True` makes them anew from the first.

    Examples
    --------
    >>> import cubecam as cc
    >>> cube = cc.load_cubemap(cc.sample_data("sunset.exr"), size=64)
    >>> cube.faces.shape
    (6, 64, 64, 3)
    """
    named = layout_name(layout)
    check_names(convention, center)
    dtype = None if dtype is None else _checked_dtype(dtype)
    paths = six_paths(path, for_reading=True)
    wanted = picture_layout(named, paths, path)
    if paths is not None:
        files = [read_picture(item, part) for item in paths]
        convention = _convention_of_six(files, paths, convention)
        faces, encoding = _faces(files, paths, srgb)
        cube = CubeMap(faces, convention=convention, mipmaps=mipmaps, encoding=encoding)
    else:
        found = _one_file(path)
        picture = read_picture(found, part, faces=True, levels=levels)
        stored = StoredAs.read(picture.attributes)
        convention = chosen("convention", convention, stored.convention, found)
        center = chosen("center", center, stored.center, found)
        try:
            cube = _from_picture(picture, srgb, wanted, convention, size, center, mipmaps, dtype)
        except ValueError as error:
            raise ValueError(f"{found}: {error}") from error
    if levels and len(cube.levels) == 1:
        raise ValueError(f"levels: expected a DDS or KTX2 file with several levels, got {path}")
    if size not in (None, cube.size):
        return cube.resize(size, dtype=dtype)
    if dtype is None or cube.dtype == np.dtype(dtype):
        return cube
    converted = [
        CubeMap.from_layout(
            CubeMap(level).to_layout("column", dtype=dtype),
            layout="column",
            mipmaps=mipmaps,
            encoding=cube.encoding,
        )
        for level in cube.levels
    ]
    return converted[0] if len(converted) == 1 else CubeMap.from_levels(converted)


@checked_call
def load_environment(
    path: Source,
    *,
    layout: FileLayout | None = None,
    convention: Convention | None = None,
    size: int | None = None,
    center: Center | None = None,
    srgb: bool = False,
    mipmaps: bool = False,
    dtype: npt.DTypeLike | None = None,
    part: Part | None = None,
    levels: bool | None = None,
) -> CubeMap:
    """Read the surroundings of a scene: an equirectangular photograph, or any file that `load_cubemap` reads.

    Parameters
    ----------
    path : path, sequence of six paths, or a name with {face}
        A picture twice as wide as high is a panorama, row 0 straight up; other shapes are cubemaps.
    size : int, optional
        Texels along an edge of a face. None: the next power of two from width / pi, which keeps all detail.
    center : {"-z", "+z", "+x", "-x"}, optional
        The direction in the middle of the panorama: "-z", straight ahead, by default.
    layout, convention, srgb, mipmaps, dtype, part, levels
        As in `load_cubemap`.

    Returns
    -------
    CubeMap
        Numbers that are not clipped: lamps keep values in the thousands. Their type is that of the file, for
        example float16 from an EXR of half floats.

    Raises
    ------
    OSError, ImageError, ValueError
        As `load_cubemap`.

    Notes
    -----
    A photograph of 8 bits (JPEG, PNG) beside lit nodes needs ``srgb=True``: light and the numbers of a screen in one
    picture are encoded together, and the photograph looks pale.

    The numbers are those of the file. Those of the sample photographs are 0 or more, but some programs leave numbers
    below 0 round lamps; if they are visible, use `CubeMap(numpy.maximum(cube.faces, 0))`.

    Examples
    --------
    >>> import cubecam as cc
    >>> sunset = cc.load_environment(cc.sample_data("sunset.exr"))
    >>> sunset.size, bool(sunset.faces.max() > 1000)
    (512, True)
    """
    return load_cubemap(
        path,
        layout=layout,
        convention=convention,
        size=size,
        center=center,
        srgb=srgb,
        mipmaps=mipmaps,
        dtype=dtype,
        part=part,
        levels=levels,
    )


def _load_shown(path: str) -> tuple[CubeMap, bool]:
    """Read a file as `load_cubemap` does, in one go; also return whether it is a panorama."""
    if six_paths(path, for_reading=True) is not None:
        return load_cubemap(path), False
    found = _one_file(path)
    picture = read_picture(found, faces=True)
    stored = StoredAs.read(picture.attributes)
    try:
        cube = _from_picture(
            picture, False, None, stored.convention, None, stored.center, False, None
        )
    except ValueError as error:
        raise ValueError(f"{found}: {error}") from error
    return cube, _is_panorama(picture)


def _is_panorama(picture: Picture) -> bool:
    """Whether a picture of no given layout is a panorama: twice as wide as high, or named so by its file."""
    height, width = picture.pixels.shape[:2]
    return (
        picture.faces is None
        and picture.environment != "cube"
        and (width == 2 * height or picture.environment == "latlong")
    )


def _checked_dtype(dtype: npt.DTypeLike) -> np.dtype[np.generic]:
    try:
        return np.dtype(dtype)
    except Exception as error:
        raise TypeError(
            f"dtype: expected uint8, float16 or float32, got {text_of(dtype)}"
        ) from error


def _one_file(path: object) -> Path:
    try:
        return existing_file(path, ImageError)
    except IsADirectoryError as error:
        told = f"{error.strerror}; six files of a folder are named with {{face}}, such as 'sky/{{face}}.png'"
        raise IsADirectoryError(error.errno, told, error.filename) from None


def _faces(files: list[Picture], paths: list[Path], srgb: bool) -> tuple[Array, Encoding]:
    """Stack six square pictures of one size, converted to the most channels and, if types differ, to float32."""
    faces = [_colors(formats.decode(file.pixels, srgb, file.encoding)) for file in files]
    encodings = {formats.encoding_after_decode(file.pixels, srgb, file.encoding) for file in files}
    shapes = [face.shape[1::-1] for face in faces]
    for path, shape in zip(paths, shapes, strict=True):
        if shape[0] != shape[1] or shape != shapes[0]:
            raise ValueError(
                f"expected six square faces of one size, got {shapes[0][0]} x {shapes[0][1]} in {paths[0]} "
                f"and {shape[0]} x {shape[1]} in {path}"
            )
    if len({face.dtype for face in faces}) > 1:
        faces = [to_float32(face) for face in faces]
    channels = max(face.shape[2] for face in faces)
    encoding: Encoding = "srgb" if encodings == {"srgb"} else "linear"
    return np.stack([_with_channels(face, channels) for face in faces]), encoding


def _convention_of_six(
    files: list[Picture], paths: list[Path], given: Convention | None
) -> Convention:
    """Return the convention to read six files in; warn where a file says something else."""
    stored = [StoredAs.read(file.attributes) for file in files]
    for path, item, name in zip(paths, stored, FACE_NAMES[0], strict=True):
        chosen("face", name, item.face, path)
    stated = list(dict.fromkeys(item.convention for item in stored if item.convention))
    if given is None and len(stated) > 1:
        raise ValueError(
            f"expected six files of one convention, got {' and '.join(stated)} in {paths[0].parent}; "
            "convention= reads them anyway"
        )
    for convention in stated:
        given = chosen("convention", given, convention, paths[0])
    return given or "gl"


def _with_channels(face: Array, channels: int) -> Array:
    if face.shape[2] == 1 and channels > 1:
        face = np.repeat(face, 3, axis=2)
    if face.shape[2] == 3 and channels == 4:
        one = 255 if face.dtype == np.uint8 else 1
        face = np.concatenate([face, np.full_like(face[..., :1], one)], axis=2)
    return face


def _stored_channels(faces: Array, picture: Picture) -> Array:
    """Take away the alpha that a file of cubecam got only because its format has one."""
    added = StoredAs.read(picture.attributes).channels == "3"
    return faces[..., :3] if added and faces.shape[-1] == 4 else faces


def _colors(pixels: Array) -> Array:
    if pixels.dtype.kind == "u" and pixels.dtype != np.uint8:
        raise ImageError(f"expected colours, got {pixels.dtype} whole numbers: an id map?")
    return pixels


def _from_picture(
    picture: Picture,
    srgb: bool,
    layout: Layout | None,
    convention: Convention | None,
    size: int | None,
    center: Center | None,
    mipmaps: bool,
    dtype: npt.DTypeLike | None,
) -> CubeMap:
    encoding = formats.encoding_after_decode(picture.pixels, srgb, picture.encoding)
    if picture.faces is not None:
        if layout is not None:
            raise ValueError(
                f"layout: expected None for a cubemap that holds faces, got {text_of(layout)}"
            )
        made = [
            CubeMap(
                _stored_channels(_colors(formats.decode(level, srgb, picture.encoding)), picture),
                convention=convention or "gl",
                mipmaps=mipmaps,
                encoding=encoding,
            )
            for level in (picture.faces, *picture.levels)
        ]
        return made[0] if len(made) == 1 else CubeMap.from_levels(made)
    pixels = _colors(formats.decode(picture.pixels, srgb, picture.encoding))
    height, width = pixels.shape[:2]
    if picture.environment == "cube" and layout is None:
        layout = "openexr"
    if layout == "openexr":
        check_openexr(convention)
        return CubeMap.from_layout(
            pixels,
            layout="openexr",
            mipmaps=mipmaps,
            dtype=dtype if size is None else None,
            encoding=encoding,
        )
    if layout == "equirect" or (layout is None and _is_panorama(picture)):
        borders = picture.environment == "latlong"
        return CubeMap.from_equirect(
            pixels,
            size=size,
            center=center or ("+z" if borders else "-z"),
            mipmaps=mipmaps,
            sampling="borders" if borders else "centers",
            dtype=dtype,
            encoding=encoding,
        )
    if layout is None and width == height:
        raise ValueError(
            f"expected a panorama or all six faces in one picture, got a square of {width} x {height}; six files are "
            "named with {face}, such as 'sky/{face}.png', or listed"
        )
    return CubeMap.from_layout(
        pixels, layout=layout, convention=convention or "gl", mipmaps=mipmaps, encoding=encoding
    )
