"""The only file that calls OpenImageIO: it reads picture files to arrays with attributes, and
writes them. `picture_files.read_picture` chooses who reads a file.

OpenImageIO is imported when the first file is read or written, not with `cubecam`.
"""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from .._checks import text_of
from .._core import ImageError
from .outside import calls_outside, interruptible
from .picture_kinds import FREE_PIXELS, most_bytes

if TYPE_CHECKING:
    from pathlib import Path

    from ..typing import Encoding
    from .picture_kinds import Kind
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


_TYPES = {"uint8": "uint8", "uint16": "uint16", "half": "float16"}
# Packings of which a block, or a bit, may stand for any number of pixels, so that a file's length bounds nothing.
_UNBOUNDED = {
    "openexr": ("dwa", "htj2k"),
    "tiff": ("ccitt", "zstd", "webp", "lerc", "lzma", "jxl", "jp2", "jpeg2000"),
}
_MOST_CHANNELS = 1024
# Bytes that take OpenImageIO a tenth of a second or more: Ctrl-C does not wait for it.
_LARGE = 1 << 20
_MOST_PARTS = 4096


@dataclass(frozen=True)
class Picture:
    """The contents of a file: (H, W, C) pixels, row 0 on top, C of 1, 3 or 4, and its attributes by name.

    `faces` are those of a file that holds them one by one, (6, N, N, C) in the order +X -X +Y -Y +Z -Z, and `levels`
    its smaller levels. `encoding` is what a file says about its whole numbers, None if it says nothing.
    """

    pixels: Array
    attributes: dict[str, Any] = field(default_factory=dict)
    faces: Array | None = None
    levels: tuple[Array, ...] = ()
    encoding: Encoding | None = None

    @property
    def environment(self) -> str:
        """ "cube" or "latlong" where the file says that it is an OpenEXR environment map, else ""."""
        text = str(self.attributes.get("textureformat", ""))
        return {"CubeFace Environment": "cube", "LatLong Environment": "latlong"}.get(text, "")


def read(path: Path, kind: Kind, part: int | str | None = None) -> Picture:
    """Read a picture of a file of a known kind.

    `part` is a number or, in an EXR file, the name of a part, of a view or of a layer. None is the first part of an EXR
    file that has colours, else the first picture.

    Raises
    ------
    ImageError
        When the contents are not a picture that OpenImageIO reads, end early, or claim more than their bytes hold.
    ValueError
        For a part that the file does not have.
    """
    # For these extensions OpenImageIO makes pictures up, without looking at the file.
    if path.suffix.lower() in (".null", ".nul", ".term"):
        return read_bytes(path.read_bytes(), kind, part)
    length = path.stat().st_size
    if length < _LARGE:
        return _read(str(path), length, kind, part)
    return interruptible(_read, str(path), length, kind, part)


def read_bytes(data: bytes, kind: Kind, part: int | str | None = None) -> Picture:
    """Read a picture of a file that is in memory."""
    if len(data) < _LARGE:
        return _read_bytes(data, kind, part)
    return interruptible(_read_bytes, data, kind, part)


def _read_bytes(data: bytes, kind: Kind, part: int | str | None) -> Picture:
    with _MemoryFile("." + kind.name) as memory:
        memory.write(data)
        return _read(memory.name, len(data), kind, part)


@calls_outside
def _read(name: str, length: int, kind: Kind, part: int | str | None) -> Picture:
    import OpenImageIO as oiio

    config = oiio.ImageSpec()
    # Without this attribute colour is multiplied by alpha, and the colour where alpha is 0 is lost.
    config.attribute("oiio:UnassociatedAlpha", 1)
    file = oiio.ImageInput.open(name, config)
    if file is None:
        raise ImageError(f"expected {kind.told} that can be read: {_reason(oiio)}")
    try:
        # OpenImageIO tries the reader of the extension first, and some readers need no file.
        if file.format_name() != kind.name:
            raise ImageError(f"expected {kind.told}, which starts so, got {file.format_name()}")
        try:
            index, layer = _find_part(file, kind, part)
            spec = file.spec()
            attributes: dict[str, Any] = {item.name: item.value for item in spec.extra_attribs}
            names = list(spec.channelnames)
        except UnicodeDecodeError as error:
            raise ImageError(f"expected names in UTF-8 in the header, got {error}") from error
        chosen = _channels(names, layer)
        _check_claim(spec, attributes, kind, length)
        stored = _STORED.get(str(spec.format), "float")
        pixels = file.read_image(index, 0, 0, spec.nchannels, stored)
        problem = _reason(file)
    finally:
        file.close()
    # OpenImageIO fills a JPEG that ends early with grey, and reports the error only by a message.
    if pixels is None or "remature end" in problem:
        raise ImageError(f"the picture is broken or ends early: {problem}")
    pixels = np.atleast_3d(pixels)
    if chosen != list(range(len(names))):
        pixels = pixels[:, :, chosen]
    pixels = _window(pixels, spec)
    return Picture(_upright(pixels, int(attributes.get("Orientation", 1))), attributes)


def _check_claim(spec: Any, attributes: dict[str, Any], kind: Kind, length: int) -> None:
    """Compare the size that a header claims with what the bytes of the file may hold, before memory is taken."""
    if spec.deep:
        raise ImageError("expected one sample a pixel, got a deep EXR file")
    if spec.depth > 1:
        raise ImageError(f"expected a picture, got a volume of {spec.depth} layers")
    if spec.nchannels > _MOST_CHANNELS:
        raise ImageError(f"expected at most {_MOST_CHANNELS} channels, got {spec.nchannels}")
    size = spec.nchannels * np.dtype(_TYPES.get(str(spec.format), "float32")).itemsize
    # A tile is decoded as a whole, also where it is larger than the picture.
    width = max(spec.width, spec.tile_width)
    height = max(spec.height, spec.tile_height)
    packing = str(attributes.get("compression", "")).lower()
    ratio = kind.ratio
    if packing.startswith(_UNBOUNDED.get(kind.name, ("no packing",))):
        ratio = None
    elif kind.name == "tiff" and ratio is not None:
        bits = int(attributes.get("oiio:BitsPerSample", 8))
        ratio *= max(1, 8 // max(bits, 1)) * (
            3 if attributes.get("tiff:PhotometricInterpretation") == 3 else 1
        )
    most = most_bytes(ratio, length, width * height, size)
    if width * height * size > most:
        raise ImageError(
            f"expected at most {most} bytes of numbers in {length} bytes of {kind.told}, got a header of "
            f"{spec.width} x {spec.height} pixels of {size} bytes"
            + (f" in tiles of {spec.tile_width} x {spec.tile_height}" if spec.tile_width else "")
        )
    # Outside the data there are zeros, which take no bytes of the file.
    full = spec.full_width * spec.full_height
    if full > FREE_PIXELS and full * size > most:
        raise ImageError(
            f"expected a display window of at most {FREE_PIXELS} pixels, or {most} bytes, for {spec.width} x "
            f"{spec.height} pixels of data, got {spec.full_width} x {spec.full_height}"
        )


def _find_part(file: Any, kind: Kind, part: int | str | None) -> tuple[int, str | None]:
    """Go to a part of a file; give its number and, if `part` names a layer, its name."""
    if part is None and kind.name != "openexr":
        return 0, None
    if isinstance(part, int):
        if file.seek_subimage(part, 0):
            return part, None
        parts = _parts(file)
    else:
        parts = _parts(file)
        found = _first_colors(parts) if part is None else _named(parts, part)
        if found is not None:
            if not file.seek_subimage(found[0], 0):
                raise ImageError(f"the header of part {found[0]} is broken: {_reason(file)}")
            return found
    told = ", ".join(
        f"{index} {item.name!r}" if item.name else str(index) for index, item in enumerate(parts)
    )
    layers = sorted({layer for item in parts for layer in item.layers if layer})
    more = f" or a layer: {', '.join(layers)}" if layers else ""
    raise ValueError(f"part: expected one of {told}{more}; got {text_of(part)}")


@dataclass(frozen=True)
class _Part:
    name: str
    view: str
    layers: dict[str, list[str]]  # the channels of each layer, "" for those without one


def _parts(file: Any) -> list[_Part]:
    found: list[_Part] = []
    while len(found) < _MOST_PARTS and file.seek_subimage(len(found), 0):
        spec = file.spec()
        layers: dict[str, list[str]] = {}
        for channel in spec.channelnames:
            layer, _, name = channel.rpartition(".")
            layers.setdefault(layer, []).append(name.lower())
        name = spec.getattribute("oiio:subimagename") or spec.getattribute("name") or ""
        # In a part of several views, the channels without a layer are of the first view.
        view = spec.getattribute("view") or (spec.getattribute("multiView") or ("",))[0]
        found.append(_Part(str(name), str(view), layers))
    return found


def _first_colors(parts: list[_Part]) -> tuple[int, str | None]:
    for has in (
        lambda names: {"r", "g", "b"} <= names,
        lambda names: "y" in names and "x" not in names,
    ):
        for index, part in enumerate(parts):
            if any(has(set(names)) for names in part.layers.values()):
                return index, None
    return 0, None


def _named(parts: list[_Part], name: str) -> tuple[int, str | None] | None:
    for index, part in enumerate(parts):
        if name == part.name:
            return index, None
    for index, part in enumerate(parts):
        if name == part.view:
            return index, None
    for index, part in enumerate(parts):
        if name and name in part.layers:
            return index, name
    return None


def encode(
    extension: str,
    pixels: Array,
    attributes: dict[str, Any] | None = None,
) -> bytes:
    """Turn (H, W, C) pixels into the bytes of a file of the kind that `extension` (".png") names.

    The file is made in memory: libjpeg ends the process on a full disk and libpng says nothing, whereas
    Python's own write raises an OSError.
    """
    if pixels.nbytes < _LARGE:
        return _encode(extension, pixels, attributes)
    return interruptible(_encode, extension, pixels, attributes)


@calls_outside
def _encode(extension: str, pixels: Array, attributes: dict[str, Any] | None) -> bytes:
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

    def write(self, data: bytes) -> None:
        with open(self._fd, "wb", closefd=False) as file:
            file.write(data)

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


def _channels(names: list[str], layer: str | None) -> list[int]:
    """Pick red, green, blue and alpha by name: EXR channels of mixed types come in another order.

    `layer` is the one to take; None is the first one with colours, those without a layer before all others.
    """
    lower = [name.lower() for name in names]
    wanted = [layer] if layer is not None else ["", *(name.rpartition(".")[0] for name in names)]
    if {"ry", "by"} & set(lower):
        raise ImageError(
            f"expected R, G, B or Y, got luminance and chroma ({', '.join(names)}), which are not read"
        )
    for prefix in dict.fromkeys(f"{name.lower()}." if name else "" for name in wanted):
        places = {c: lower.index(prefix + c) for c in "rgbya" if prefix + c in lower}
        alpha = [places["a"]] if "a" in places else []
        if {"r", "g", "b"} <= places.keys():
            return [places["r"], places["g"], places["b"], *alpha]
        # Grey: a single channel is kept as one. Beside an X, Y is a coordinate.
        if "y" in places and prefix + "x" not in lower:
            return [places["y"]] * 3 + alpha if alpha else [places["y"]]
    if layer is not None:
        own = [i for i, name in enumerate(names) if name.rpartition(".")[0] == layer]
    else:
        own = list(range(len(names)))
    if len(own) in (1, 3, 4):
        return own
    if len(own) == 2 and "a" in [lower[i].rpartition(".")[2] for i in own]:
        alpha = [i for i in own if lower[i].rpartition(".")[2] == "a"]
        return [i for i in own if i not in alpha] * 3 + alpha
    raise ImageError(f"expected 1, 3 or 4 channels, or some named R, G, B; got {', '.join(names)}")


def _upright(pixels: Array, orientation: int) -> Array:
    """Turn a photograph as its Exif orientation (TIFF 6.0, tag 274) says, so that row 0 is its top."""
    if 5 <= orientation <= 8:
        pixels = pixels.transpose(1, 0, 2)
    if orientation in (3, 4, 7, 8):
        pixels = pixels[::-1]
    if orientation in (2, 3, 6, 7):
        pixels = pixels[:, ::-1]
    return np.ascontiguousarray(pixels)
