"""Compressed data: Draco (a whole primitive) and meshopt (a buffer view), by the packages DracoPy and meshopt.

Both packages were tried with mutated bytes, and neither crashed. Draco allocates what its header says: the header is
checked before anything is decoded.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from .accessors import Layout
from .entries import Entry
from .extensions import DRACO, MESHOPT
from .limits import Limits

if TYPE_CHECKING:
    from .document import Gltf

Array = npt.NDArray[Any]


def package(name: str, extension: str) -> Any:
    """Import the package that decodes an extension."""
    try:
        return import_module(name)
    except ImportError:
        raise MeshError(
            f"expected the package {name}, which reads {extension}, to be installed: "
            "pip install 'cubecam[gltf]'"
            + (" (it needs Python 3.11 or later)" if name == "meshopt" else "")
        ) from None


def unpacked(document: Gltf, view: Entry) -> bytes | memoryview | None:
    """Return the decoded bytes of a buffer view; None if it is not compressed, or if its plain bytes will do."""
    for name in MESHOPT:
        entry = view.extension(name)
        if entry is not None:
            try:
                meshopt = package("meshopt", name)
            except MeshError:
                if _has_fallback(document, view, name):
                    return None
                raise
            return _meshopt(document, view, entry, name, meshopt)
    return None


def _has_fallback(document: Gltf, view: Entry, name: str) -> bool:
    """Say whether the plain bytes of a compressed buffer view are in the file, too."""
    if name in document.required:
        return False
    buffer = document.entry("buffers", view.integer("buffer"))
    placeholder = buffer.extension(name)
    there = "uri" in buffer or (view.integer("buffer") == 0 and document.has_binary)
    return there and not (placeholder is not None and placeholder.flag("fallback"))


def _meshopt(document: Gltf, view: Entry, entry: Entry, name: str, meshopt: Any) -> memoryview:
    data = document.part(entry, entry.integer("byteLength"))
    count = entry.integer("count")
    stride = entry.integer("byteStride", low=1)
    mode, filtered = entry.text("mode"), entry.text("filter") or "NONE"
    # The shortest code of each mode, by the specification of the extension: two bits of header for each byte of 16
    # elements in version 0, and of a block of at most 256 in version 1; a byte for a triangle; a byte for an index.
    if mode == "ATTRIBUTES":
        if stride > 256 or stride % 4:
            raise entry.error("byteStride", "a multiple of 4, at most 256")
        shortest = 1 + max(24, stride) if count else 0
        if filtered not in ("NONE", "OCTAHEDRAL", "QUATERNION", "EXPONENTIAL", "COLOR"):
            raise entry.error("filter", "NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL or COLOR")
    elif mode in ("TRIANGLES", "INDICES"):
        if stride not in (2, 4):
            raise entry.error("byteStride", "2 or 4")
        if filtered != "NONE":
            raise entry.error("filter", "NONE")
        if mode == "TRIANGLES" and count % 3:
            raise entry.error("count", "a multiple of 3")
        shortest = 1 + (count // 3 if mode == "TRIANGLES" else count)
    else:
        raise entry.error("mode", "ATTRIBUTES, TRIANGLES or INDICES")
    if len(data) < shortest:
        raise entry.error("byteLength", f"at least {shortest} bytes of {name}")
    if count * stride > document.most_bytes:
        raise entry.error("count", f"at most {document.most_bytes // stride} elements of {name}")
    if view.integer("byteLength") != count * stride:
        raise view.error("byteLength", f"{count * stride}, as {name} says,")
    if count == 0:
        return memoryview(b"")
    try:
        rows = meshopt.decode_gltf_buffer(
            bytes(data), count, stride, mode, None if filtered == "NONE" else filtered
        )
    except (ValueError, RuntimeError) as error:
        raise MeshError(f"{entry.where}: expected bytes of {name}, got others: {error}") from None
    return memoryview(np.ascontiguousarray(rows).tobytes())


class Draco:
    """A decoded Draco mesh: `faces` (T, 3), `count` vertices, and `attributes`, (count, n) by unique id."""

    def __init__(self, entry: Entry, data: bytes, limits: Limits) -> None:
        """Decode the bytes that a primitive's extension, `entry`, refers to."""
        draco = package("DracoPy", DRACO)
        try:
            vertices, triangles = draco_counts(data)
        except (IndexError, ValueError) as error:
            raise self._error(entry, error) from None
        if vertices + triangles > limits.left:
            raise MeshError(
                f"{entry.where}: expected at most {limits.left} vertices and triangles in bytes of "
                f"{DRACO}, got {vertices} and {triangles}"
            )
        try:
            mesh = draco.decode(data)
            faces = np.asarray(mesh.faces, dtype=np.int64).reshape(-1, 3)
            self.attributes: dict[int, Array] = {
                int(a["unique_id"]): np.asarray(a["data"]) for a in mesh.attributes
            }
        except MemoryError:
            raise
        except Exception as error:  # the package has exceptions of its own
            raise self._error(entry, error) from None
        self.faces = faces
        counts = {len(values) for values in self.attributes.values()}
        self.count = counts.pop() if len(counts) == 1 else 0
        if counts or (faces.size and not 0 <= faces.min() <= faces.max() < self.count):
            raise self._error(entry, "its arrays do not fit together")

    def values(self, ids: Entry, key: str, form: Layout) -> tuple[Array, bool]:
        """Return the numbers of an attribute, and whether they are normalized: its accessor says so."""
        number = ids.integer(key)
        if number not in self.attributes:
            raise ids.error(
                key, f"one of the ids {sorted(self.attributes)} in the bytes of {DRACO}"
            )
        values = self.attributes[number]
        if values.shape[1:] != form.shape[1:]:
            raise ids.error(key, f"an attribute of {form.kind} in the bytes of {DRACO}")
        if form.component.kind in "iu" and values.dtype != form.component:
            values = values.astype(form.component)
        return values, form.normalized

    @staticmethod
    def _error(entry: Entry, error: object) -> MeshError:
        return MeshError(f"{entry.where}: expected bytes of {DRACO}, got others: {error}")


def draco_counts(data: bytes) -> tuple[int, int]:
    """Read how many vertices and triangles a Draco mesh says it has (Draco bitstream 2.2, sections 4 and 5)."""
    if data[:5] != b"DRACO" or len(data) < 11:
        raise ValueError("no Draco header")
    if data[5] != 2:
        raise ValueError(f"version {data[5]}.{data[6]}, expected 2.2")
    if data[7] != 1:  # a point cloud, whose decoder allocates without limits
        raise ValueError("not a mesh")
    place = 11
    if data[10] & 0x80:
        place = _skip_metadata(data, place)
    if data[8] == 1:  # edgebreaker: one byte says how it walks over the mesh
        vertices, place = _varint(data, place + 1)
        triangles, place = _varint(data, place)
        symbols, place = _varint(data, place + 1)
        splits, place = _varint(data, place)
        return max(vertices, splits), max(triangles, symbols)
    triangles, place = _varint(data, place)
    vertices, place = _varint(data, place)
    return vertices, triangles


def _varint(data: bytes, place: int) -> tuple[int, int]:
    """Read a number of seven bits a byte, the lowest first; return it and the place behind it."""
    value = shift = 0
    while shift < 35:
        byte = data[place]
        value |= (byte & 0x7F) << shift
        place, shift = place + 1, shift + 7
        if byte < 0x80:
            return value, place
    raise ValueError("a number of more than 32 bits")


def _skip_metadata(data: bytes, place: int) -> int:
    """Return the place behind the metadata: those of some attributes, then those of the mesh. Each may be nested."""
    attributes, place = _varint(data, place)
    for _ in range(attributes):  # ends with an IndexError if there is less
        _, place = _varint(data, place)
        place = _skip_element(data, place)
    return _skip_element(data, place)


def _skip_element(data: bytes, place: int) -> int:
    nested, named = 1, False
    while nested:
        nested -= 1
        if named:
            place += 1 + data[place]
        named = True
        entries, place = _varint(data, place)
        for _ in range(entries):
            place += 1 + data[place]
            size, place = _varint(data, place)
            place += size
            data[place - 1]
        more, place = _varint(data, place)
        nested += more
    return place
