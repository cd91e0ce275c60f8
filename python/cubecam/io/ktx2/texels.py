"""The formats of texels: Vulkan's numbers for them, how they are decoded, and the descriptor that a file needs."""

from __future__ import annotations

import struct
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from ..dds import shared_exponent, small_floats

if TYPE_CHECKING:
    from ..pixels import Array

Decoder = Callable[[memoryview, int], "Array"]


@dataclass(frozen=True)
class Format:
    """A kind of texels.

    `bytes` are those of a texel, or of a block of 4 x 4 texels where `dxgi`, Direct3D's number of the same blocks, is
    not 0. `decode` turns the bytes of so many texels into an array (count, C).
    """

    name: str
    type_size: int
    bytes: int
    srgb: bool = False
    decode: Decoder | None = None
    dxgi: int = 0

    def level_bytes(self, width: int, height: int) -> int:
        """Give the bytes of one picture of a level."""
        if self.dxgi:
            return ((width + 3) // 4) * ((height + 3) // 4) * self.bytes
        return width * height * self.bytes


def _plain(
    name: str, dtype: str, channels: int, order: tuple[int, ...] = (), srgb: bool = False
) -> Format:
    """Channels one after another; `order` picks some of them. Two channels get a blue of 0, as lookups see them."""
    kind = np.dtype(dtype)

    def decode(data: memoryview, count: int) -> Array:
        found = np.frombuffer(data, kind, count * channels).reshape(count, channels)
        if order:
            found = found[:, list(order)]
        if channels == 2:
            found = np.concatenate([found, np.zeros_like(found[:, :1])], axis=1)
        return np.ascontiguousarray(found, dtype=kind.newbyteorder("="))

    return Format(name, kind.itemsize, kind.itemsize * channels, srgb, decode)


def _words(name: str, unpack: Callable[[bytes, int], Array]) -> Format:
    return Format(name, 4, 4, False, lambda data, count: unpack(bytes(data), count))


_CHANNELS = {1: "R", 2: "RG", 3: "RGB", 4: "RGBA"}


def _name(channels: str, bits: int, kind: str) -> str:
    return "".join(f"{channel}{bits}" for channel in channels) + "_" + kind


def _table() -> dict[int, Format]:
    """List what is read, by VkFormat (Vulkan 1.3, "Format Definition")."""
    table: dict[int, Format] = {}
    for channels, unorm, srgb in ((1, 9, 15), (2, 16, 22), (3, 23, 29), (4, 37, 43)):
        letters = _CHANNELS[channels]
        table[unorm] = _plain(_name(letters, 8, "UNORM"), "u1", channels)
        table[srgb] = _plain(_name(letters, 8, "SRGB"), "u1", channels, srgb=True)
    for letters, order, unorm, srgb in (
        ("BGR", (2, 1, 0), 30, 36),
        ("BGRA", (2, 1, 0, 3), 44, 50),
    ):
        table[unorm] = _plain(_name(letters, 8, "UNORM"), "u1", len(order), order)
        table[srgb] = _plain(_name(letters, 8, "SRGB"), "u1", len(order), order, True)
    for channels, unorm, half, single in (
        (1, 70, 76, 100),
        (2, 77, 83, 103),
        (3, 84, 90, 106),
        (4, 91, 97, 109),
    ):
        letters = _CHANNELS[channels]
        table[unorm] = _plain(_name(letters, 16, "UNORM"), "<u2", channels)
        table[half] = _plain(_name(letters, 16, "SFLOAT"), "<f2", channels)
        table[single] = _plain(_name(letters, 32, "SFLOAT"), "<f4", channels)
    table[122] = _words("B10G11R11_UFLOAT_PACK32", small_floats)
    table[123] = _words("E5B9G9R9_UFLOAT_PACK32", shared_exponent)
    for number, name, size, dxgi in (
        (131, "BC1_RGB_UNORM_BLOCK", 8, 71),
        (132, "BC1_RGB_SRGB_BLOCK", 8, 71),
        (133, "BC1_RGBA_UNORM_BLOCK", 8, 71),
        (134, "BC1_RGBA_SRGB_BLOCK", 8, 71),
        (135, "BC2_UNORM_BLOCK", 16, 74),
        (136, "BC2_SRGB_BLOCK", 16, 74),
        (137, "BC3_UNORM_BLOCK", 16, 77),
        (138, "BC3_SRGB_BLOCK", 16, 77),
        (139, "BC4_UNORM_BLOCK", 8, 80),
        (143, "BC6H_UFLOAT_BLOCK", 16, 95),
        (144, "BC6H_SFLOAT_BLOCK", 16, 96),
        (145, "BC7_UNORM_BLOCK", 16, 98),
        (146, "BC7_SRGB_BLOCK", 16, 98),
    ):
        table[number] = Format(name, 1, size, "SRGB" in name, None, dxgi)
    return table


FORMATS = _table()
#: What is refused, by the first and last number of each family.
_OTHERS = (
    (140, 140, "BC4_SNORM_BLOCK, numbers with a sign"),
    (141, 142, "BC5, two channels"),
    (147, 156, "ETC2 or EAC"),
    (157, 184, "ASTC"),
    (1000054000, 1000054007, "PVRTC"),
    (1000066000, 1000066013, "ASTC HDR"),
    (124, 130, "depth or stencil"),
)


def format_name(number: int) -> str:
    """Name a VkFormat, also one that is not read."""
    if number in FORMATS:
        return FORMATS[number].name
    for first, last, told in _OTHERS:
        if first <= number <= last:
            return f"VkFormat {number}, {told}"
    return f"VkFormat {number}"


#: What is written: the VkFormat of so many channels of a dtype; of uint8, linear and sRGB.
_WRITTEN = {
    ("uint8", 1): (9, 15),
    ("uint8", 4): (37, 43),
    ("float16", 1): (76, 76),
    ("float16", 4): (97, 97),
    ("float32", 1): (100, 100),
    ("float32", 4): (109, 109),
}
_CHANNEL_IDS = (0, 1, 2, 15)  # R, G, B, A of the model RGBSDA
_LINEAR, _FLOAT, _SIGNED = 0x10, 0x80, 0x40


def number_of(dtype: np.dtype[np.generic], channels: int, srgb: bool) -> int:
    """Give the VkFormat in which such numbers are written."""
    return _WRITTEN[dtype.name, channels][srgb]


def descriptor(dtype: np.dtype[np.generic], channels: int, srgb: bool) -> bytes:
    """Give the Data Format Descriptor of what is written (Khronos Data Format 1.4, chapters 3 to 5).

    One basic block: the model RGBSDA with BT.709's primaries, a sample for each channel. The lowest and the highest
    value of floats are -1 and 1, of whole numbers 0 and the largest one. Alpha is linear, also beside sRGB colours.
    """
    bits = dtype.itemsize * 8
    is_float = dtype.kind == "f"
    low, high = (0xBF800000, 0x3F800000) if is_float else (0, (1 << bits) - 1)
    samples = b""
    for index in range(channels):
        kind = _CHANNEL_IDS[index] | (_FLOAT | _SIGNED if is_float else 0)
        if srgb and index == 3:
            kind |= _LINEAR
        samples += struct.pack("<HBB4x2I", index * bits, bits - 1, kind, low, high)
    size = 24 + len(samples)
    model, primaries, transfer, flags = 1, 1, 2 if srgb else 1, 0
    block = struct.pack("<I2H4B", 0, 2, size, model, primaries, transfer, flags)
    planes = struct.pack("<4x8B", channels * dtype.itemsize, *[0] * 7)
    return struct.pack("<I", 4 + size) + block + planes + samples
