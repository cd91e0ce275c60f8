"""All of a KTX2 file that comes before its texels: read, and checked against the bytes that are there."""

from __future__ import annotations

import struct
from dataclasses import dataclass

from ..._core import ImageError
from . import packing
from .texels import FORMATS, Format, format_name

MAGIC = b"\xabKTX 20\xbb\r\n\x1a\n"
HEADER = struct.Struct("<12s9I4I2Q")
LEVEL = struct.Struct("<3Q")
_LARGEST = 1 << 16  # texels along an edge
_MOST_LAYERS = 1 << 16
_ETC1S, _UASTC = 163, 166
_OTHER_MODELS = {167: "UASTC HDR 4x4", 168: "UASTC HDR 6x6", 162: "ASTC"}
_SRGB = 2


@dataclass(frozen=True)
class Level:
    """Where the bytes of a level are, and how many there are without compression (0 for BasisLZ)."""

    offset: int
    length: int
    unpacked: int


@dataclass(frozen=True)
class Header:
    """What a file says about itself.

    `format` is None for Basis Universal, `basis` then names which of its two codecs.
    """

    width: int
    height: int
    layers: int
    faces: int
    scheme: int
    levels: tuple[Level, ...]
    format: Format | None
    basis: str
    srgb: bool
    key_values: dict[str, bytes]

    def size(self, level: int) -> tuple[int, int]:
        """Give width and height of a level."""
        return max(1, self.width >> level), max(1, self.height >> level)

    def text(self, key: str) -> str:
        """Give the value of a key as text, "" if there is none."""
        return self.key_values.get(key, b"").split(b"\0")[0].decode("utf-8", "replace")


def read_header(source: bytes | memoryview) -> Header:
    """Read header, level index, descriptor and keys.

    Raises
    ------
    ImageError
        For headers that are broken, and for kinds that are not read: volumes, and formats that it names.
    """
    data = memoryview(source)
    if len(data) < HEADER.size or data[:12] != MAGIC:
        raise ImageError(f"expected a KTX2 header of {HEADER.size} bytes, got {len(data)}")
    (
        _, number, type_size, width, height, depth, layers, faces, level_count, scheme,
        dfd_at, dfd_length, keys_at, keys_length, _, _,
    ) = HEADER.unpack_from(data)  # fmt: skip
    if depth > 1:
        raise ImageError(f"expected a picture or a cubemap, got a KTX2 volume of {depth} layers")
    height = max(height, 1)  # a row of texels has no height
    if not (1 <= width <= _LARGEST and height <= _LARGEST):
        raise ImageError(f"expected 1 to {_LARGEST} texels along an edge, got {width} x {height}")
    if faces not in (1, 6):
        raise ImageError(f"expected one or six faces, got {faces}")
    if faces == 6 and width != height:
        raise ImageError(f"expected square faces, got {width} x {height}")
    if layers > _MOST_LAYERS:
        raise ImageError(f"expected at most {_MOST_LAYERS} layers, got {layers}")
    most = max(width, height).bit_length()
    if level_count > most:
        raise ImageError(f"expected at most {most} levels, got {level_count}")
    if scheme not in (packing.NONE, packing.BASIS_LZ, packing.ZSTD, packing.ZLIB):
        raise ImageError(f"expected BasisLZ, Zstandard or zlib, got the supercompression {scheme}")
    form = FORMATS.get(number)
    if form is None and number != 0:
        raise ImageError(f"expected a format of texels that is read, got {format_name(number)}")
    if form is not None and type_size != form.type_size:
        raise ImageError(f"expected typeSize {form.type_size} for {form.name}, got {type_size}")
    model, transfer = _descriptor(_part(data, dfd_at, dfd_length, "descriptor"))
    basis = "" if form is not None else _basis(model, scheme)
    if form is not None and scheme == packing.BASIS_LZ:
        raise ImageError(f"expected Zstandard or zlib for {form.name}, got BasisLZ")
    index = _part(data, HEADER.size, LEVEL.size * max(1, level_count), "level index")
    levels = tuple(Level(*row) for row in LEVEL.iter_unpack(index))
    for k, level in enumerate(levels):
        if level.offset + level.length > len(data):
            raise ImageError(
                f"expected {level.length} bytes of level {k} from byte {level.offset} on, got a file of {len(data)}"
            )
    return Header(
        width, height, max(1, layers), faces, scheme, levels, form, basis,
        form.srgb if form is not None and (form.srgb or transfer is None) else transfer == _SRGB,
        _keys(_part(data, keys_at, keys_length, "keys")),
    )  # fmt: skip


def _part(data: memoryview, at: int, length: int, told: str) -> memoryview:
    if at + length > len(data):
        raise ImageError(
            f"expected {length} bytes of the {told} from byte {at} on, got a file of {len(data)}"
        )
    return data[at : at + length]


def _descriptor(data: memoryview) -> tuple[int | None, int | None]:
    """Give colour model and transfer function of the basic block; None where there is no descriptor."""
    if len(data) < 28:
        return None, None
    kind = struct.unpack_from("<I", data, 4)[0]
    return (data[12], data[14]) if kind == 0 else (None, None)


def _basis(model: int | None, scheme: int) -> str:
    if model == _ETC1S and scheme == packing.BASIS_LZ:
        return "ETC1S"
    if model == _UASTC and scheme != packing.BASIS_LZ:
        return "UASTC"
    told = _OTHER_MODELS.get(model or 0, f"the colour model {model}")
    raise ImageError(f"expected ETC1S or UASTC in a KTX2 file without a VkFormat, got {told}")


def _keys(data: memoryview) -> dict[str, bytes]:
    found: dict[str, bytes] = {}
    at = 0
    while at + 4 <= len(data):
        length = int.from_bytes(data[at : at + 4], "little")
        if at + 4 + length > len(data):
            raise ImageError(f"expected {length} bytes of a key, got {len(data) - at - 4}")
        key, end, value = bytes(data[at + 4 : at + 4 + length]).partition(b"\0")
        if not end:
            raise ImageError("expected a key that ends in a zero byte, got one without")
        found[key.decode("utf-8", "replace")] = value
        at += 4 + (length + 3) // 4 * 4
    return found
