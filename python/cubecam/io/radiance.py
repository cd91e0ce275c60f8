"""Read Radiance pictures (.hdr, .pic): every orientation, every coding, RGBE and XYZE.

G. Ward, "Real Pixels", Graphics Gems II, 1991; "The RADIANCE Picture File Format"; the source of Radiance (color.c,
resolu.c, spec_rgb.c). The core decodes the pixels.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from .._core import ImageError, _read_radiance

if TYPE_CHECKING:
    from .pixels import FloatArray

#: The first bytes; the name of a program follows.
MAGIC = b"#?"
#: Bytes before the line with the size; programs add a line for each step of work.
_LONGEST_HEADER = 1 << 20
_SIZE = re.compile(rb"\s*([+-])([XY])\s+([0-9]{1,9})\s+([+-])([XY])\s+([0-9]{1,9})\s*")
_NUMBER = re.compile(r"[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?")
#: Pixels that run lengths may make of few bytes: 8192 x 4096.
_ALWAYS_ALLOWED = 1 << 25
#: Pixels that a byte may stand for beyond that: 127 of each component take 8 bytes.
_PIXELS_PER_BYTE = 16

# Chromaticities (x, y) of red, green, blue and white of Radiance's RGB (color.h).
_PRIMARIES = ((0.64, 0.33), (0.29, 0.6), (0.15, 0.06))
_WHITE = (1 / 3, 1 / 3)


@dataclass
class Header:
    """What stands before the pixels."""

    start: int = 0  # of the pixels
    scanlines: int = 0
    length: int = 0
    transposed: bool = False  # a scanline is a column
    flipped: tuple[bool, bool] = (False, False)  # rows, columns, after turning
    xyz: bool = False
    exposure: float = 1.0
    correction: list[float] = field(default_factory=lambda: [1.0, 1.0, 1.0])


def read(data: bytes) -> FloatArray:
    """Turn the bytes of a file into (H, W, 3) float32, row 0 on top.

    The numbers are component / 256 * 2**(exponent - 128), as most programs read them (Radiance adds half a step),
    divided by the exposure and the colour correction that the header names. XYZ becomes RGB of Radiance's primaries
    and equal-energy white, without a change of white; colours outside the primaries have numbers below 0.

    Raises
    ------
    ImageError
        For a header or pixels that are broken, or a kind of numbers other than RGBE and XYZE.
    """
    header = read_header(data)
    count = header.scanlines * header.length
    if count > max(_ALWAYS_ALLOWED, _PIXELS_PER_BYTE * len(data)):
        raise ImageError(
            f"expected at most {max(_ALWAYS_ALLOWED, _PIXELS_PER_BYTE * len(data))} pixels in {len(data)} bytes, "
            f"got {header.scanlines} scanlines of {header.length}"
        )
    try:
        pixels = _read_radiance(data, header.start, header.scanlines, header.length)
    except ValueError as error:
        raise ImageError(str(error)) from None
    divisors = header.exposure * np.array(header.correction)
    with np.errstate(over="ignore", invalid="ignore"):  # what is not finite is refused below
        if (divisors != 1).any():
            np.divide(pixels, divisors.astype(np.float32), out=pixels)
        if header.xyz:
            pixels = pixels @ _rgb_from_xyz().T.astype(np.float32)
    if (header.xyz or (divisors != 1).any()) and not np.isfinite(pixels).all():
        raise ImageError(
            f"expected numbers that float32 holds, got larger ones after the division by EXPOSURE {header.exposure:g} "
            f"and COLORCORR {' '.join(f'{c:g}' for c in header.correction)}"
        )
    if header.transposed:
        pixels = pixels.transpose(1, 0, 2)
    if header.flipped[0]:
        pixels = pixels[::-1]
    if header.flipped[1]:
        pixels = pixels[:, ::-1]
    return np.ascontiguousarray(pixels)


def read_header(data: bytes) -> Header:
    """Read the lines up to the size, such as "-Y 512 +X 1024"."""
    header = Header()
    at = 0
    while True:
        end = data.find(b"\n", at, _LONGEST_HEADER)
        if end < 0:
            raise ImageError("expected a Radiance header with a line such as -Y 512 +X 1024")
        line, at = data[at:end].rstrip(b"\r"), end + 1
        size = _SIZE.fullmatch(line)
        if size:
            break
        # A line that starts with white space is the header of another picture that this one was made from.
        _read_variable(header, line.decode("latin-1"))
    header.start = at
    sign, axis, scanlines, other_sign, other_axis, length = size.groups()
    header.scanlines, header.length = int(scanlines), int(length)
    if axis == other_axis or 0 in (header.scanlines, header.length):
        raise ImageError(
            f"expected a size such as -Y 512 +X 1024, got {line.decode('latin-1').strip()}"
        )
    header.transposed = axis == b"X"
    signs = {axis: sign, other_axis: other_sign}
    header.flipped = (signs[b"Y"] == b"+", signs[b"X"] == b"-")
    return header


def _read_variable(header: Header, line: str) -> None:
    name, equals, text = line.partition("=")
    if not equals:
        return
    if name == "FORMAT":
        kind = text.strip()
        if kind not in ("32-bit_rle_rgbe", "32-bit_rle_xyze"):
            raise ImageError(f"expected FORMAT=32-bit_rle_rgbe or 32-bit_rle_xyze, got {kind[:80]}")
        header.xyz = kind.endswith("xyze")
    elif name == "NCOMP" and text.strip() != "3":
        raise ImageError(f"expected NCOMP=3, got {text.strip()[:80]}")
    elif name == "EXPOSURE":
        header.exposure *= _numbers(name, text, 1)[0]
        _check(name, [header.exposure])
    elif name == "COLORCORR":
        factors = _numbers(name, text, 3)
        header.correction = [old * new for old, new in zip(header.correction, factors, strict=True)]
        _check(name, header.correction)


def _numbers(name: str, text: str, count: int) -> list[float]:
    words = text.split()[:count]
    if len(words) < count or not all(_NUMBER.match(word) for word in words):
        raise ImageError(f"expected {count} number(s) after {name}=, got {text.strip()[:80]!r}")
    return [float(found.group()) for word in words if (found := _NUMBER.match(word))]


def _check(name: str, values: list[float]) -> None:
    """Several lines of a name multiply; the product must divide a float32."""
    if not all(math.isfinite(value) and 1e-38 <= value <= 1e38 for value in values):
        raise ImageError(
            f"expected {name} above 0 and at most 1e38, got {' '.join(f'{v:g}' for v in values)}"
        )


def _rgb_from_xyz() -> FloatArray:
    """The matrix from XYZ to RGB: its inverse takes unit red, green and blue to their chromaticities, and their sum to
    white of luminance 1.
    """
    primaries = np.array([(x, y, 1 - x - y) for x, y in _PRIMARIES]).T
    x, y = _WHITE
    white = np.array([x / y, 1, (1 - x - y) / y])
    to_xyz = primaries * np.linalg.solve(primaries, white)
    return np.linalg.inv(to_xyz)
