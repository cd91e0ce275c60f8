"""Supercompression of levels: Zstandard (scheme 2) and zlib (scheme 3), each level by itself."""

from __future__ import annotations

import sys
import zlib
from importlib import import_module
from typing import Any

from ..._core import ImageError
from ..picture_kinds import most_bytes

NONE, BASIS_LZ, ZSTD, ZLIB = 0, 1, 2, 3
SCHEMES = {None: NONE, "zstd": ZSTD, "zlib": ZLIB}
#: Deflate codes up to 258 bytes in 2 bits.
_DEFLATE = 1032
#: Zstandard may refer to so many bytes before; files whose levels are smaller have no use for more.
_WINDOW_BITS = 27


def scheme_name(scheme: int) -> str:
    """Name a scheme for messages."""
    return {BASIS_LZ: "BasisLZ", ZSTD: "Zstandard", ZLIB: "zlib"}.get(scheme, f"scheme {scheme}")


def check_size(scheme: int, packed: int, pixels: int, size: int) -> None:
    """Compare the bytes that a level claims with those that its packed bytes may hold, before memory is taken."""
    most = most_bytes(_DEFLATE if scheme == ZLIB else None, packed, pixels, max(1, size // pixels))
    if size > most:
        raise ImageError(
            f"expected at most {most} bytes of numbers in {packed} bytes of {scheme_name(scheme)}, got {size}"
        )


def unpack(scheme: int, data: memoryview, size: int) -> memoryview:
    """Decode a level of `size` bytes; no more memory is taken, whatever the data says.

    Raises
    ------
    ImageError
        For data that are broken or have another length, or if the package that decodes Zstandard is missing.
    """
    try:
        if scheme == ZLIB:
            inflater = zlib.decompressobj()
            found = inflater.decompress(data, size)
            more = inflater.unconsumed_tail or not inflater.eof
            if more and len(found) == size:  # the end of the stream may still be to read
                more = bool(inflater.decompress(inflater.unconsumed_tail, 1))
        else:
            zstd = _zstd("reads")
            options = {zstd.DecompressionParameter.window_log_max: _WINDOW_BITS}
            decoder = zstd.ZstdDecompressor(options=options)
            found = decoder.decompress(data, size)
            more = bool(
                len(found) == size and not decoder.eof and decoder.decompress(b"", max_length=1)
            )
    except (zlib.error, ValueError, EOFError) as error:
        raise ImageError(
            f"expected a level packed by {scheme_name(scheme)}, got: {error}"
        ) from None
    except ImageError:
        raise
    except Exception as error:
        if type(error).__name__ != "ZstdError":
            raise
        raise ImageError(
            f"expected a level packed by {scheme_name(scheme)}, got: {error}"
        ) from None
    if len(found) != size or more:
        length = "more" if more else str(len(found))
        raise ImageError(
            f"expected {size} bytes in a level packed by {scheme_name(scheme)}, got {length}"
        )
    return memoryview(found)


def pack(scheme: int, data: bytes) -> bytes:
    """Encode a level."""
    if scheme == ZLIB:
        return zlib.compress(data, 9)
    if scheme == ZSTD:
        packed: bytes = _zstd("writes").compress(data, 15)
        return packed
    return data


def _zstd(does: str) -> Any:
    """Import the module of Zstandard: of Python from 3.14 on, else its backport."""
    name = "compression.zstd" if sys.version_info >= (3, 14) else "backports.zstd"
    try:
        return import_module(name)
    except ImportError:
        raise ImageError(
            f"expected the package backports.zstd, which {does} KTX2 of Zstandard, to be installed: "
            "pip install 'cubecam[ktx2]'"
        ) from None
