"""Read a picture file of any kind: by its contents, Radiance, DDS, KTX2, or what OpenImageIO reads."""

from __future__ import annotations

import os
from collections.abc import Mapping
from typing import TypeAlias

import numpy as np

from .._checks import text_of, whole_number
from .._core import ImageError, _is_whole_number
from . import dds, ktx2, oiio, radiance
from .files import as_path, open_file
from .oiio import Picture
from .picture_kinds import DDS, Kind, check_canvas, find_kind, refused_kind
from .pixels import Array
from .stored_as import ATTRIBUTE, KTX_KEY, StoredAs

#: A part of a file that holds several pictures: a number from 0 on, or a name.
Part: TypeAlias = int | str


def read_picture(
    path: object, part: Part | None = None, *, faces: bool = False, levels: bool | None = None
) -> Picture:
    """Read a picture of a file.

    `faces` gives a cubemap of a DDS or KTX2 file as one picture with `faces` and `levels`, and `part` counts cubemaps;
    else the parts of such a file are its faces. Its smaller levels are read if `levels` is True, and if it is None
    where the file says that they are filtered by roughness.

    Raises
    ------
    OSError
        As `existing_file`.
    ImageError
        When the contents are not a picture that is read, end early, or claim more than their bytes can hold.
    ValueError
        For a part that the file does not have.
    TypeError
        For a part that is neither a whole number nor a name.
    """
    part = _checked(part)
    found = as_path(path)
    with open_file(found, ImageError) as file:
        start = file.read(64)
        length = file.seek(0, os.SEEK_END)
        file.seek(max(0, length - 26))
        end = file.read(26)
        file.seek(0)
        # These are read here, other kinds by OpenImageIO, which opens the file by its name.
        own = (radiance.MAGIC, dds.MAGIC, ktx2.MAGIC)
        data = file.read() if start.startswith(own) else b""
    try:
        _refuse(start)
        if start.startswith(radiance.MAGIC):
            _only(part)
            return Picture(radiance.read(data))
        if start.startswith(dds.MAGIC):
            return _read_dds(data, part, faces, levels)
        if start.startswith(ktx2.MAGIC):
            return _read_ktx2(data, part, faces, levels)
        return oiio.read(found, _kind(start, end, found.suffix, length), part)
    except ImageError as error:
        raise ImageError(f"{found}: {error}") from error.__cause__
    except ValueError as error:
        raise ValueError(f"{found}: {error}") from error.__cause__


def decode_picture(data: bytes) -> Picture:
    """Read a picture of a file that is in memory; its errors name no file.

    Raises
    ------
    ImageError
        When the contents are not a picture that is read, end early, or claim more than their bytes can hold.
    """
    start = data[:64]
    _refuse(start)
    if start.startswith(radiance.MAGIC):
        return Picture(radiance.read(data))
    if start.startswith(dds.MAGIC):
        return _read_dds(data, None, False, False)
    if start.startswith(ktx2.MAGIC):
        return _read_ktx2(data, None, False, False)
    return oiio.read_bytes(data, _kind(start, data[-26:], "", len(data)))


def _refuse(start: bytes) -> None:
    refused = refused_kind(start)
    if refused:
        raise ImageError(
            f"{refused} files are not read yet; expected EXR, HDR, PNG, JPEG, TIFF, WebP, DDS, ..."
        )


def _kind(start: bytes, end: bytes, suffix: str, length: int) -> Kind:
    """Find the kind of a file that OpenImageIO reads, and check the canvas that it claims."""
    kind = find_kind(start, end, suffix)
    if kind is None:
        raise ImageError(
            f"expected a picture file (EXR, HDR, PNG, JPEG, ...), got {length} bytes of another kind"
        )
    check_canvas(kind, start, length)
    return kind


def _checked(part: object) -> Part | None:
    if part is None or isinstance(part, str):
        return part
    if not _is_whole_number(part):
        raise TypeError(f"part: expected a whole number or a name, got {text_of(part)}")
    return whole_number(part, "part", 0)


def _only(part: Part | None) -> None:
    if part not in (None, 0):
        raise ValueError(
            f"part: expected 0 or None, since the file holds one picture; got {text_of(part)}"
        )


def _read_dds(data: bytes, part: Part | None, faces: bool, levels: bool | None) -> Picture:
    """Give all faces of a cubemap, or one picture."""
    header = dds.read_header(data)
    if header.format is None and header.images == 1:
        _only(part)
        return oiio.read_bytes(data, DDS)
    pictures = header.images // 6 if faces and header.cube else header.images
    if header.cube and not faces and part is None:
        raise ImageError(
            "expected a picture, got a DDS cubemap, which load_cubemap reads; part= 0 to "
            f"{pictures - 1} or {', '.join(dds.FACES)} names a face"
        )
    names = dds.FACES if header.images == 6 and header.cube and not faces else ()
    at = _index(part, pictures, names)
    count = 6 if faces and header.cube else 1
    blocks = _Blocks()
    pixels = dds.decode(header, data, at * count, count, blocks)
    if count == 6:
        attributes = {**blocks.attributes, ATTRIBUTE: header.text}
        rest = [
            dds.decode(header, data, at * count, count, blocks, level)
            for level in range(1, header.levels if filtered(attributes, levels) else 1)
        ]
        return Picture(pixels[0], attributes, pixels, tuple(rest), dds.encoding(header))
    return Picture(np.ascontiguousarray(pixels[0]), blocks.attributes)


def _read_ktx2(data: bytes, part: Part | None, faces: bool, levels: bool | None) -> Picture:
    """Give all faces of a cubemap with their levels, or one picture."""
    header = ktx2.read_header(data)
    cube = header.faces == 6
    if cube and not faces:
        if part is None:
            raise ImageError(
                "expected a picture, got a KTX2 cubemap, which load_cubemap reads; part= 0 to "
                f"{6 * header.layers - 1} or {', '.join(dds.FACES)} names a face"
            )
        at = _index(part, 6 * header.layers, dds.FACES)
        found = ktx2.read(data, levels=1, layer=at // 6)
        return Picture(np.ascontiguousarray(found.levels[0][at % 6]), encoding=found.encoding)
    layer = _index(part, header.layers, ())
    attributes = {ATTRIBUTE: header.text(KTX_KEY)}
    every = cube and filtered(attributes, levels)
    found = ktx2.read(data, levels=None if every else 1, layer=layer)
    if not cube:
        return Picture(found.levels[0], attributes, encoding=found.encoding)
    first, *rest = found.levels
    return Picture(first[0], attributes, faces=first, levels=tuple(rest), encoding=found.encoding)


def filtered(attributes: Mapping[str, object], levels: bool | None) -> bool:
    """Say whether the smaller levels of a file are read: as the caller says, or else as the file does."""
    return StoredAs.read(attributes).levels == "roughness" if levels is None else levels


class _Blocks:
    """Decodes the blocks of a DDS file of one picture."""

    def __init__(self) -> None:
        self.attributes: dict[str, object] = {}

    def __call__(self, data: bytes) -> Array:
        picture = oiio.read_bytes(data, DDS)
        self.attributes = picture.attributes
        return picture.pixels


def _index(part: Part | None, count: int, names: tuple[str, ...]) -> int:
    """Find a part by its number or name."""
    if part is None:
        return 0
    if isinstance(part, int) and part < count:
        return part
    if part in names:
        return names.index(str(part))
    listed = f" or one of {', '.join(names)}" if names else ""
    raise ValueError(f"part: expected 0 to {count - 1}{listed}, got {text_of(part)}")
