"""A glTF document that is being written: lists of entries, one buffer, pictures, and the names of extensions."""

from __future__ import annotations

import json
import struct
from typing import Any

import numpy as np
import numpy.typing as npt

from ...._core import __version__

Array = npt.NDArray[Any]
Json = dict[str, Any]

_COMPONENTS = {"uint8": 5121, "uint16": 5123, "uint32": 5125, "float32": 5126}
_VECTORS = {2: "VEC2", 3: "VEC3", 4: "VEC4"}
#: What a buffer view is for (section 5.11.5 of glTF 2.0).
VERTICES, TRIANGLES = 34962, 34963
#: The length of a GLB stands in 32 bits (section 4.4.2).
_LONGEST = 2**32 - 1


class Document:
    """Entries of the lists of a glTF tree, and the bytes that they refer to. Equal bytes are stored once."""

    def __init__(self) -> None:
        self.lists: dict[str, list[Json]] = {}
        self.extensions: dict[str, Json] = {}
        self.used: set[str] = set()
        self.extras: Json = {}
        #: The bytes of each entry of `images`.
        self.pictures: list[bytes] = []
        self._chunks: list[bytes] = []
        self._length = 0
        self._views: dict[tuple[bytes, int | None, int | None], int] = {}
        self._accessors: dict[tuple[Any, ...], int] = {}
        self._pictures: dict[bytes, int] = {}

    def add(self, kind: str, entry: Json) -> int:
        """Append an entry to a list of the root, and return its index."""
        entries = self.lists.setdefault(kind, [])
        entries.append(entry)
        return len(entries) - 1

    def extend(self, entry: Json, extension: str, content: Json) -> None:
        """Give an entry an extension."""
        self.used.add(extension)
        entry.setdefault("extensions", {})[extension] = content

    def view(self, data: bytes, target: int | None = None, stride: int | None = None) -> int:
        """Store bytes, and return the index of their buffer view."""
        key = (data, target, stride)
        if key not in self._views:
            padding = -self._length % 4
            entry = {
                "buffer": 0,
                "byteOffset": self._length + padding,
                "byteLength": len(data),
            }
            if target is not None:
                entry["target"] = target
            if stride is not None:  # two accessors may show the same bytes, as on a sphere
                entry["byteStride"] = stride
            self._chunks += [b"\0" * padding, data]
            self._length += padding + len(data)
            self._views[key] = self.add("bufferViews", entry)
        return self._views[key]

    def accessor(
        self,
        array: Array,
        *,
        target: int | None = None,
        bounds: bool = False,
        owner: int | None = None,
    ) -> int:
        """Store an array, (N,) for scalars, (N, n) for vectors, (N, 4, 4) for matrices that act on column vectors.

        Equal arrays of one `owner` share an accessor.
        """
        if array.ndim == 3:
            kind = "MAT4"
            array = array.transpose(0, 2, 1)  # columns stand one after another
        else:
            kind = "SCALAR" if array.ndim == 1 else _VECTORS[array.shape[1]]
        array = np.ascontiguousarray(array)
        stride = array.strides[0] if target == VERTICES else None
        view = self.view(array.tobytes(), target, stride)
        key = (view, kind, array.dtype.name, bounds, owner)
        if key not in self._accessors:
            entry: Json = {
                "bufferView": view,
                "componentType": _COMPONENTS[array.dtype.name],
                "count": len(array),
                "type": kind,
            }
            if bounds:
                rows = array.reshape(len(array), -1)
                entry["min"], entry["max"] = rows.min(axis=0).tolist(), rows.max(axis=0).tolist()
            self._accessors[key] = self.add("accessors", entry)
        return self._accessors[key]

    def picture(self, data: bytes) -> int:
        """Store the bytes of a PNG file, and return the index of the image."""
        if data not in self._pictures:
            self.pictures.append(data)
            self._pictures[data] = self.add("images", {"mimeType": "image/png"})
        return self._pictures[data]

    def glb(self) -> bytes:
        """Return the bytes of a .glb file (section 4.4)."""
        for entry, data in zip(self.lists.get("images", []), self.pictures, strict=True):
            entry["bufferView"] = self.view(data)
        binary = self._binary()
        binary += b"\0" * (-len(binary) % 4)
        text = self._text({"byteLength": len(binary)} if binary else None)
        text += b" " * (-len(text) % 4)
        length = 12 + 8 + len(text) + (8 + len(binary) if binary else 0)
        if length > _LONGEST:
            raise ValueError(
                f"expected at most {_LONGEST} bytes in a .glb file, got {length}: save as .gltf"
            )
        parts = [b"glTF", struct.pack("<II", 2, length)]
        parts += [struct.pack("<I", len(text)), b"JSON", text]
        if binary:
            parts += [struct.pack("<I", len(binary)), b"BIN\0", binary]
        return b"".join(parts)

    def files(self, buffer: str, pictures: list[str]) -> tuple[bytes, bytes]:
        """Return the text of a .gltf file and the bytes of its buffer; the arguments are the URIs of its files."""
        for entry, uri in zip(self.lists.get("images", []), pictures, strict=True):
            entry["uri"] = uri
            entry.pop("mimeType")
        binary = self._binary()
        return self._text({"byteLength": len(binary), "uri": buffer} if binary else None), binary

    def _binary(self) -> bytes:
        return b"".join(self._chunks)

    def _text(self, buffer: Json | None) -> bytes:
        tree: Json = {"asset": {"version": "2.0", "generator": f"cubecam {__version__}"}}
        if self.used:
            tree["extensionsUsed"] = sorted(self.used)
        if self.extensions:
            tree["extensions"] = self.extensions
        if self.extras:
            tree["extras"] = self.extras
        tree["scene"] = 0
        tree.update(self.lists)
        if buffer is not None:
            tree["buffers"] = [buffer]
        return json.dumps(tree, ensure_ascii=False, allow_nan=False, separators=(",", ":")).encode(
            "utf-8"
        )
