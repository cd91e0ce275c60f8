"""The kinds of picture files by their first bytes, and how many numbers a file of so many bytes may hold.

A header may claim any size, and libraries take the memory for it before they notice that the file ends early. So the
size is compared with the bytes that are there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from .._core import ImageError

#: Bytes of numbers that every file may claim.
FREE_BYTES = 64 << 20
#: Pixels that a kind may hold in a few bytes, where it has no bound: 8192 x 4096.
FREE_PIXELS = 1 << 25
#: Bytes of numbers that a byte of such a file may stand for beyond that.
_UNBOUNDED_RATIO = 2048
#: Deflate codes up to 258 bytes in 2 bits.
_DEFLATE = 1032


@dataclass(frozen=True)
class Kind:
    """A kind of file.

    `name` is OpenImageIO's. `ratio` bounds the bytes of numbers that a byte of the file stands for; None is no bound:
    a single block, or one bit, may stand for a whole constant picture.
    """

    name: str
    told: str
    ratio: int | None


DDS = Kind("dds", "DDS", 16)
_TARGA = Kind("targa", "TGA", 256)
# JPEG: a progressive file of 32 x 32 pixels to 18 bits. GIF: codes of 12 bits for 1 to 3837 indices, 4 channels.
_KINDS = (
    (b"\x76\x2f\x31\x01", Kind("openexr", "EXR", _DEFLATE)),
    (b"\x89PNG\r\n\x1a\n", Kind("png", "PNG", _DEFLATE)),
    (b"\xff\xd8\xff", Kind("jpeg", "JPEG", 1400)),
    (b"II*\0", Kind("tiff", "TIFF", 1400)),
    (b"MM\0*", Kind("tiff", "TIFF", 1400)),
    (b"II+\0", Kind("tiff", "TIFF", 1400)),
    (b"MM\0+", Kind("tiff", "TIFF", 1400)),
    (b"GIF8", Kind("gif", "GIF", 5500)),
    (b"BM", Kind("bmp", "BMP", 512)),
    (b"DDS ", DDS),
    (b"\0\0\0\x0cJXL \r\n\x87\n", Kind("jpegxl", "JPEG XL", None)),
    (b"\xff\x0a", Kind("jpegxl", "JPEG XL", None)),
    (b"\0\0\0\x0cjP  \r\n\x87\n", Kind("jpeg2000", "JPEG 2000", None)),
    (b"\xff\x4f\xff\x51", Kind("jpeg2000", "JPEG 2000", None)),
    (b"8BPS", Kind("psd", "PSD", _DEFLATE)),
    (b"\x01\xda", Kind("sgi", "SGI", 128)),
    (b"SDPX", Kind("dpx", "DPX", 16)),
    (b"XPDS", Kind("dpx", "DPX", 16)),
    (b"\x80\x2a\x5f\xd7", Kind("cineon", "Cineon", 16)),
    (b"\xd7\x5f\x2a\x80", Kind("cineon", "Cineon", 16)),
    (b"SIMPLE", Kind("fits", "FITS", 16)),
    (b"FOR4", Kind("iff", "IFF", 128)),
    (b"FORM", Kind("iff", "IFF", 128)),
    (b"\x53\x80\xf6\x34", Kind("softimage", "Softimage", 256)),
    (b"\0\0\x01\0", Kind("ico", "ICO", _DEFLATE)),
    *((b"P" + letter, Kind("pnm", "PNM", 16)) for letter in (b"1", b"2", b"3", b"4", b"5", b"6", b"F", b"f")),
)  # fmt: skip

# Files that hold pictures or cubemaps, and are not read.
_REFUSED = (
    (b"\xabKTX 11\xbb", "KTX"),
    (b"sB\x13\0", "Basis"),
    (b"\x86\x16\x87\x96\xf6\xd6\x96\x36", "Babylon.js .env"),
    (b"PVR\x03", "PVR"),
    (b"\x13\xab\xa1\x5c", "ASTC"),
)
# The names that may stand after "ftyp".
_BRANDS = {b"avif": "AVIF", b"avis": "AVIF", b"heic": "HEIC", b"heix": "HEIC", b"mif1": "HEIF"}


def find_kind(start: bytes, end: bytes, suffix: str) -> Kind | None:
    """Say what kind a file is by its first 32 and last 26 bytes; only Targa files may lack a mark of their own."""
    if start[:4] == b"RIFF" and start[8:12] == b"WEBP":
        return Kind("webp", "WebP", None)
    for magic, kind in _KINDS:
        if start.startswith(magic):
            return (
                replace(kind, ratio=_DEFLATE * _png_growth(start)) if kind.name == "png" else kind
            )
    if suffix.lower() in (".tga", ".tpic") or end[8:24] == b"TRUEVISION-XFILE":
        return _TARGA
    return None


def check_canvas(kind: Kind, start: bytes, length: int) -> None:
    """Compare the canvas of a GIF or WebP with the bytes of the file: memory for it is taken when the file is opened.

    Raises
    ------
    ImageError
        If the file claims more than its bytes can hold.
    """
    size = _canvas(kind, start)
    if size is None:
        return
    most = most_bytes(kind.ratio, length, size[0] * size[1], 4)
    if size[0] * size[1] * 4 > most:
        raise ImageError(
            f"expected at most {most} bytes of numbers in {length} bytes of {kind.told}, got a canvas of "
            f"{size[0]} x {size[1]}"
        )


def _canvas(kind: Kind, start: bytes) -> tuple[int, int] | None:
    def number(at: int, size: int) -> int:
        return int.from_bytes(start[at : at + size], "little")

    if kind.name == "gif":
        return number(6, 2), number(8, 2)
    if kind.name != "webp":
        return None
    if start[12:16] == b"VP8X":
        return number(24, 3) + 1, number(27, 3) + 1
    if start[12:16] == b"VP8L":
        return (number(21, 4) & 0x3FFF) + 1, (number(21, 4) >> 14 & 0x3FFF) + 1
    return number(26, 2) & 0x3FFF, number(28, 2) & 0x3FFF


def _png_growth(start: bytes) -> int:
    """How many bytes of numbers a byte of packed pixels becomes: 1 to 4 bits become 8, indices 4 channels."""
    depth, color = max(start[24:25], b"\x01")[0], start[25:26]
    return max(1, 8 // depth) * (4 if color == b"\x03" else 1)


def refused_kind(start: bytes) -> str:
    """Name a kind of file that holds pictures and is not read, or give ""."""
    for magic, told in _REFUSED:
        if start.startswith(magic):
            return told
    return _BRANDS.get(start[8:12], "") if start[4:8] == b"ftyp" else ""


def most_bytes(ratio: int | None, length: int, pixels: int, size: int) -> int:
    """Give the most bytes of numbers that a file of `length` bytes may claim.

    `pixels` of `size` bytes are what it does claim: where there is no bound, a picture of `FREE_PIXELS` is allowed.
    """
    if ratio is not None:
        return FREE_BYTES + ratio * length
    free = FREE_PIXELS * size if pixels <= FREE_PIXELS else FREE_BYTES
    return max(free, FREE_BYTES + _UNBOUNDED_RATIO * length)
