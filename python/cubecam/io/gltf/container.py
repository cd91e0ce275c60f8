"""From the bytes of a file to the JSON tree: .glb and .gltf, told apart by content (section 4 of glTF 2.0)."""

from __future__ import annotations

import json
import struct
from typing import Any

from ..._core import MeshError
from .entries import Entry, shown

_JSON, _BIN = 0x4E4F534A, 0x004E4942


def parse(data: bytes) -> tuple[dict[str, Any], memoryview | None]:
    """Return the JSON tree, and the bytes of the binary chunk if there is one."""
    text, binary = _chunks(data) if data[:4] == b"glTF" else (memoryview(data), None)
    tree = _tree(bytes(text))
    _check_version(Entry("", tree))
    return tree, binary


def _chunks(data: bytes) -> tuple[memoryview, memoryview | None]:
    """Read the container of section 4.4: the chunk of JSON, and the first one of binary data."""
    if len(data) < 12:
        raise MeshError(f"expected a GLB header of 12 bytes, got {len(data)} bytes")
    version, length = struct.unpack_from("<II", data, 4)
    if version != 2:
        raise MeshError(f"expected glTF 2.0, got a GLB file of version {version}")
    if length != len(data):
        raise MeshError(f"expected the {length} bytes that the GLB header says, got {len(data)}")
    view = memoryview(data)
    text: memoryview | None = None
    binary: memoryview | None = None
    place = 12
    while place < length:
        if length - place < 8:
            raise MeshError(
                f"expected a chunk header of 8 bytes at byte {place}, got {length - place}"
            )
        size, kind = struct.unpack_from("<II", data, place)
        chunk = view[place + 8 : place + 8 + size]
        if len(chunk) < size:
            raise MeshError(f"expected a chunk of {size} bytes at byte {place}, got {len(chunk)}")
        if text is None:
            if kind != _JSON:
                raise MeshError(f"expected a first chunk of JSON, got one of type {kind:#010x}")
            text = chunk
        elif kind == _BIN and binary is None:
            binary = chunk
        place += 8 + size
    if text is None:
        raise MeshError("expected a chunk of JSON, got no chunk")
    return text, binary


def _tree(text: bytes) -> dict[str, Any]:
    # Section 2.7 asks for UTF-8 without a byte order mark, section 4.4.3.2 for blanks at the end of the chunk; some
    # programs write a mark, and zeros.
    try:
        tree = json.loads(text.rstrip(b"\0").decode("utf-8-sig"), parse_constant=_no_constant)
    except RecursionError:
        raise MeshError(
            "expected a JSON tree of moderate depth, got one too deep to read"
        ) from None
    except UnicodeDecodeError as error:
        raise MeshError(f"expected JSON in UTF-8, got other bytes at {error.start}") from None
    except json.JSONDecodeError as error:
        raise MeshError(f"expected JSON, got an error: {error}") from None
    if not isinstance(tree, dict):
        raise MeshError(f"expected an object of JSON, got {shown(tree)}")
    return tree


def _no_constant(name: str) -> float:
    raise MeshError(f"expected JSON, got the word {name}, which JSON does not have")


def _check_version(tree: Entry) -> None:
    asset = tree.needed("asset")
    version = asset.text("version")
    if version is None:
        raise asset.error("version", 'a string such as "2.0"')
    if _numbers(version)[:1] != [2]:
        raise MeshError(f"expected glTF 2.0, got asset.version {shown(version)}")
    least = asset.text("minVersion")
    if least is not None and _numbers(least) > [2, 0]:
        raise MeshError(f"expected a file for readers of glTF 2.0, got minVersion {shown(least)}")


def _numbers(version: str) -> list[int]:
    parts = version.split(".")
    return [int(p) if p.isascii() and p.isdigit() and len(p) < 9 else 10**9 for p in parts]
