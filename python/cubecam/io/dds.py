"""Read DDS files: cubemaps, and pictures of the kinds of numbers that OpenImageIO does not read.

Microsoft, "Programming guide for DDS": the headers, and the order of faces and levels. Each face is stored with all its
levels before the next face. Compressed blocks (BC1 to BC7) are decoded by OpenImageIO.
"""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from .._core import ImageError

if TYPE_CHECKING:
    from ..typing import Encoding
    from .pixels import Array

MAGIC = b"DDS "
#: How the remark begins that cubecam leaves in the reserved bytes of a file.
OWN = "cubecam"
FACES = ("+X", "-X", "+Y", "-Y", "+Z", "-Z")
_HEADER = struct.Struct("<4s7I44x2I4s5I5I")
_DX10 = struct.Struct("<5I")
_FLAG_ALPHA, _FLAG_FOUR_CC, _FLAG_RGB, _FLAG_LUMINANCE, _FLAG_ALPHA_ONLY = (
    0x1,
    0x4,
    0x40,
    0x20000,
    0x2,
)
_CAPS2_CUBE, _CAPS2_FIRST_FACE, _CAPS2_VOLUME = 0x200, 0x400, 0x200000
_MISC_CUBE, _DIMENSION_3D = 0x4, 4
_LARGEST = 1 << 16  # texels along an edge; Direct3D ends at 16384

Decoder = Callable[[bytes, int], "Array"]


@dataclass(frozen=True)
class _Format:
    """A kind of pixels: its name, the bytes of a pixel (of a block of 4 x 4 with no `decode`), and what decodes them to
    (count, C) numbers.
    """

    name: str
    bytes: int
    decode: Decoder | None = None

    def size(self, width: int, height: int) -> int:
        """Give the bytes of a level."""
        if self.decode is None:
            return ((width + 3) // 4) * ((height + 3) // 4) * self.bytes
        return width * height * self.bytes


def _plain(name: str, dtype: str, channels: int, order: tuple[int, ...] | None = None) -> _Format:
    """Channels one after another; `order` picks some of them."""
    kind = np.dtype(dtype)

    def decode(data: bytes, count: int) -> Array:
        found = np.frombuffer(data, kind, count * channels).reshape(count, channels)
        return (found if order is None else found[:, list(order)]).astype(kind.newbyteorder("="))

    return _Format(name, kind.itemsize * channels, decode)


def small_floats(data: bytes, count: int) -> Array:
    """R11G11B10: floats without a sign, 5 bits of exponent as in half floats, 6, 6 and 5 bits of fraction."""
    words = np.frombuffer(data, "<u4", count)
    halves = np.stack([(words & 0x7FF) << 4, (words >> 11 & 0x7FF) << 4, (words >> 22) << 5], -1)
    return halves.astype(np.uint16).view(np.float16)


def shared_exponent(data: bytes, count: int) -> Array:
    """R9G9B9E5: fraction / 512 * 2**(exponent - 15)."""
    words = np.frombuffer(data, "<u4", count)
    fractions = np.stack([words & 0x1FF, words >> 9 & 0x1FF, words >> 18 & 0x1FF], -1)
    return np.ldexp(fractions.astype(np.float32), (words >> 27).astype(np.int32)[:, None] - 24)


def _masked(bits: int, masks: tuple[int, ...]) -> _Format:
    """Channels by their bits: as uint8, scaled to 255, or as uint16, scaled to 65535, where one has more than 8."""
    widths = [mask.bit_count() for mask in masks]
    shifts = [(mask & -mask).bit_length() - 1 for mask in masks]
    size = bits // 8
    if bits not in (8, 16, 24, 32) or any(
        mask == 0 or mask >> shift != (1 << width) - 1 or mask >> bits or width > 16
        for mask, width, shift in zip(masks, widths, shifts, strict=True)
    ):
        raise ImageError(
            f"expected 8, 16, 24 or 32 bits a pixel with a mask for each channel, got {bits} bits with "
            f"{', '.join(f'{mask:#x}' for mask in masks)}"
        )
    top, dtype = (255, np.uint8) if max(widths) <= 8 else (65535, np.uint16)

    def decode(data: bytes, count: int) -> Array:
        found = np.frombuffer(data, np.uint8, count * size).reshape(count, size)
        if all(width == 8 and shift % 8 == 0 for width, shift in zip(widths, shifts, strict=True)):
            return found[:, [shift // 8 for shift in shifts]]
        words = np.zeros((count, 4), np.uint8)
        words[:, :size] = found
        whole = words.view("<u4")[:, 0]
        out = np.empty((count, len(masks)), dtype)
        for channel, (mask, width, shift) in enumerate(zip(masks, widths, shifts, strict=True)):
            value, most = (whole & mask) >> shift, (1 << width) - 1
            out[:, channel] = (value.astype(np.uint64) * top * 2 + most) // (2 * most)
        return out

    return _Format(f"{bits} bits a pixel", size, decode)


# DXGI_FORMAT, of the header that follows "DX10".
_DXGI = {
    2: _plain("R32G32B32A32_FLOAT", "<f4", 4),
    6: _plain("R32G32B32_FLOAT", "<f4", 3),
    10: _plain("R16G16B16A16_FLOAT", "<f2", 4),
    11: _plain("R16G16B16A16_UNORM", "<u2", 4),
    24: _masked(32, (0x3FF, 0xFFC00, 0x3FF00000, 0xC0000000)),
    26: _Format("R11G11B10_FLOAT", 4, small_floats),
    27: _plain("R8G8B8A8_TYPELESS", "u1", 4),
    28: _plain("R8G8B8A8_UNORM", "u1", 4),
    29: _plain("R8G8B8A8_UNORM_SRGB", "u1", 4),
    41: _plain("R32_FLOAT", "<f4", 1),
    54: _plain("R16_FLOAT", "<f2", 1),
    56: _plain("R16_UNORM", "<u2", 1),
    61: _plain("R8_UNORM", "u1", 1),
    67: _Format("R9G9B9E5_SHAREDEXP", 4, shared_exponent),
    71: _Format("BC1_UNORM", 8),
    72: _Format("BC1_UNORM_SRGB", 8),
    74: _Format("BC2_UNORM", 16),
    75: _Format("BC2_UNORM_SRGB", 16),
    77: _Format("BC3_UNORM", 16),
    78: _Format("BC3_UNORM_SRGB", 16),
    80: _Format("BC4_UNORM", 8),
    85: _masked(16, (0xF800, 0x7E0, 0x1F)),
    86: _masked(16, (0x7C00, 0x3E0, 0x1F, 0x8000)),
    87: _plain("B8G8R8A8_UNORM", "u1", 4, (2, 1, 0, 3)),
    88: _plain("B8G8R8X8_UNORM", "u1", 4, (2, 1, 0)),
    90: _plain("B8G8R8A8_TYPELESS", "u1", 4, (2, 1, 0, 3)),
    91: _plain("B8G8R8A8_UNORM_SRGB", "u1", 4, (2, 1, 0, 3)),
    92: _plain("B8G8R8X8_TYPELESS", "u1", 4, (2, 1, 0)),
    93: _plain("B8G8R8X8_UNORM_SRGB", "u1", 4, (2, 1, 0)),
    95: _Format("BC6H_UF16", 16),
    96: _Format("BC6H_SF16", 16),
    98: _Format("BC7_UNORM", 16),
    99: _Format("BC7_UNORM_SRGB", 16),
    115: _masked(16, (0xF00, 0xF0, 0xF, 0xF000)),
}
# Codes of Direct3D 9, which stand for a name of four letters.
_FOUR_CC = {
    b"DXT1": _Format("DXT1", 8),
    b"DXT2": _Format("DXT2", 16),
    b"DXT3": _Format("DXT3", 16),
    b"DXT4": _Format("DXT4", 16),
    b"DXT5": _Format("DXT5", 16),
    b"ATI1": _Format("ATI1", 8),
    b"BC4U": _Format("BC4U", 8),
    36: _plain("A16B16G16R16", "<u2", 4),
    111: _plain("R16F", "<f2", 1),
    113: _plain("A16B16G16R16F", "<f2", 4),
    114: _plain("R32F", "<f4", 1),
    116: _plain("A32B32G32R32F", "<f4", 4),
}
# What is refused by name.
_OTHERS = {
    b"ATI2": "ATI2, two channels",
    b"BC5U": "BC5U, two channels",
    b"BC5S": "BC5S, two channels",
    b"BC4S": "BC4S, numbers with a sign",
    110: "Q16W16V16U16, numbers with a sign",
    112: "G16R16F, two channels",
    115: "G32R32F, two channels",
    117: "CxV8U8",
}
_OTHER_DXGI = {
    16: "R32G32_FLOAT, two channels",
    31: "R8G8B8A8_SNORM, numbers with a sign",
    34: "R16G16_FLOAT, two channels",
    35: "R16G16_UNORM, two channels",
    49: "R8G8_UNORM, two channels",
    81: "BC4_SNORM, numbers with a sign",
    83: "BC5_UNORM, two channels",
    84: "BC5_SNORM, two channels",
}


@dataclass(frozen=True)
class Dds:
    """The header of a file. `images` is the number of pictures: six for a cubemap."""

    width: int
    height: int
    levels: int
    images: int
    cube: bool
    start: int  # of the pixels
    format: _Format | None
    told: str  # the name of a format, also of one that is not read
    text: str  # what the writing program left in the reserved bytes
    fields: tuple[Any, ...]  # of the header
    fields10: tuple[int, ...] | None


def read_header(data: bytes) -> Dds:
    """Read the headers, and check that the pixels that they tell of are there.

    Raises
    ------
    ImageError
        For headers that are broken or that no program writes, faces that are missing, volumes, and pixels that end
        early.
    """
    if len(data) < _HEADER.size or data[:4] != MAGIC:
        raise ImageError(f"expected a DDS header of {_HEADER.size} bytes, got {len(data)}")
    fields = _HEADER.unpack_from(data)
    _, _, _, height, width, _, _, levels, _, flags, code, bits, *rest = fields
    masks, caps2 = tuple(rest[:4]), rest[5]
    start, fields10, images = _HEADER.size, None, 1
    cube = bool(caps2 & _CAPS2_CUBE)
    volume = bool(caps2 & _CAPS2_VOLUME)
    if flags & _FLAG_FOUR_CC and code == b"DX10":
        if len(data) < start + _DX10.size:
            raise ImageError("expected a header after DX10, got a file that ends early")
        fields10 = _DX10.unpack_from(data, start)
        start += _DX10.size
        number, dimension, misc, images, _ = fields10
        cube = cube or bool(misc & _MISC_CUBE)  # some programs write only the older mark
        volume = volume or dimension == _DIMENSION_3D
        form, told = _DXGI.get(number), _OTHER_DXGI.get(number, f"DXGI format {number}")
    else:
        form, told = _legacy(flags, code, bits, masks)
        if cube:
            _check_faces(caps2)
    if volume:
        raise ImageError("expected a picture or a cubemap, got a DDS volume")
    told = form.name if form is not None else told
    if not (1 <= width <= _LARGEST and 1 <= height <= _LARGEST):
        raise ImageError(f"expected 1 to {_LARGEST} texels along an edge, got {width} x {height}")
    if cube and width != height:
        raise ImageError(f"expected square faces, got {width} x {height}")
    levels = max(levels, 1)
    if levels > max(width, height).bit_length():
        raise ImageError(f"expected at most {max(width, height).bit_length()} levels, got {levels}")
    images = max(images, 1) * (6 if cube else 1)
    text = data[32:76].split(b"\0")[0].decode("ascii", "replace")
    found = Dds(width, height, levels, images, cube, start, form, told, text, fields, fields10)
    if form is not None:
        _check_length(found, len(data))
        # Some programs count the faces of one cubemap in the header that follows "DX10", some the cubemaps.
        if cube and images == 36 and len(data) < start + 36 * stride(found):
            found = replace(found, images=6)
    return found


def stride(dds: Dds) -> int:
    """Give the bytes from one picture to the next: all levels."""
    assert dds.format is not None
    sizes = [(max(1, dds.width >> i), max(1, dds.height >> i)) for i in range(dds.levels)]
    return sum(dds.format.size(*size) for size in sizes)


def _check_length(dds: Dds, length: int) -> None:
    images = 6 if dds.cube else 1
    if length < dds.start + images * stride(dds):
        raise ImageError(
            f"expected {images * stride(dds)} bytes of {dds.told} after the header, got {length - dds.start}"
        )


def _legacy(
    flags: int, code: bytes, bits: int, masks: tuple[int, ...]
) -> tuple[_Format | None, str]:
    if flags & _FLAG_FOUR_CC:
        number = int.from_bytes(code, "little")
        key: bytes | int = code if number > 255 else number
        told = code.decode("latin-1") if number > 255 else str(number)
        return _FOUR_CC.get(key), _OTHERS.get(key, f"the code {told!r}")
    alpha = (masks[3],) if flags & _FLAG_ALPHA and masks[3] else ()
    if flags & _FLAG_RGB:
        return _masked(bits, masks[:3] + alpha), ""
    if flags & _FLAG_LUMINANCE:
        return _masked(bits, (masks[0],) * (3 if alpha else 1) + alpha), ""
    if flags & _FLAG_ALPHA_ONLY:
        return _masked(bits, (masks[3],)), ""
    return None, f"pixels of the flags {flags:#x}"


def _check_faces(caps2: int) -> None:
    missing = [face for i, face in enumerate(FACES) if not caps2 & (_CAPS2_FIRST_FACE << i)]
    if missing:
        raise ImageError(f"expected six faces, got a DDS cubemap without {', '.join(missing)}")


def decode(
    dds: Dds,
    data: bytes,
    first: int,
    count: int,
    blocks: Callable[[bytes], Array],
    level: int = 0,
) -> Array:
    """Give a level of `count` pictures from `first` on, (count, H, W, C).

    `blocks` reads the bytes of a DDS file of one picture, for the kinds that are stored in blocks.
    """
    if dds.format is None:
        raise ImageError(f"expected a DDS file of one, three or four channels, got {dds.told}")
    step = stride(dds)
    width, height = max(1, dds.width >> level), max(1, dds.height >> level)
    size, before = dds.format.size(width, height), stride(replace(dds, levels=level))
    starts = [dds.start + i * step + before for i in range(first, first + count)]
    if starts[-1] + size > len(data):
        raise ImageError(f"expected {dds.images} pictures in the DDS file, got {len(data)} bytes")
    texels = b"".join(data[at : at + size] for at in starts)
    if dds.format.decode is not None:
        pixels = dds.format.decode(texels, count * width * height)
        return pixels.reshape(count, height, width, -1)
    rows = (height + 3) // 4 * 4
    pixels = blocks(_one_picture(dds, width, rows * count) + texels)
    shape = (count, rows, width, pixels.shape[-1])
    if pixels.size != np.prod(shape):
        raise ImageError(f"expected {shape} pixels of {dds.told}, got {pixels.shape}")
    return pixels.reshape(shape)[:, :height]


def encoding(dds: Dds) -> Encoding | None:
    """Say what whole numbers are, where cubecam wrote the file, or DXGI's format says it; None: the file does not."""
    if dds.format is None or dds.fields10 is None:
        return None
    if dds.format.name.endswith("_SRGB"):
        return "srgb"
    return "linear" if dds.text.startswith(OWN) else None


def header(
    width: int,
    height: int,
    number: int,
    *,
    levels: int = 1,
    cube: bool = False,
    row: int = 0,
    remark: bytes = b"",
) -> bytes:
    """Make the headers of a file, with the one that follows "DX10".

    `number` is DXGI's of the format, `row` the bytes of a row of the first level (0: not said), `remark` up to 44 bytes
    in the place that is reserved for programs' own use.
    """
    flags = 0x1007 | (0x20000 if levels > 1 else 0) | (0x8 if row else 0)
    caps = 0x1000 | (0x8 if levels > 1 or cube else 0) | (0x400000 if levels > 1 else 0)
    caps2 = _CAPS2_CUBE | 0xFC00 if cube else 0
    top = struct.pack("<4s7I", MAGIC, 124, flags, height, width, row, 0, levels)
    form = struct.pack("<2I4s5I", 32, _FLAG_FOUR_CC, b"DX10", 0, 0, 0, 0, 0)
    rest = struct.pack("<5I", caps, caps2, 0, 0, 0)
    more = _DX10.pack(number, 3, _MISC_CUBE if cube else 0, 1, 0)
    return top + remark.ljust(44, b"\0") + form + rest + more


def _one_picture(dds: Dds, width: int, height: int) -> bytes:
    """Make the header of a file that holds the blocks of all pictures, one below another, without levels."""
    fields = list(dds.fields)
    fields[3:8] = [height, width, 0, 0, 1]
    fields[2] = 0x1007  # caps, height, width, pixel format
    fields[-5:] = [0x1000, 0, 0, 0, 0]  # a texture without faces and levels
    header = _HEADER.pack(*fields)
    if dds.fields10 is not None:
        header += _DX10.pack(dds.fields10[0], 3, 0, 1, 0)
    return header
