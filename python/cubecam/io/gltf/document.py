"""A glTF document: the JSON tree as the file has it, and the arrays that its entries stand for."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

import numpy.typing as npt

from ..._core import MeshError
from ..files import PathLike, as_path, read_file
from . import accessors, compression, container, extensions
from .entries import Entry
from .nodes import NodeTree
from .references import read_uri

#: What any file may use up, however small it is: bytes of one decoded buffer view, elements of an accessor without one.
_FREE_BYTES = 8 << 20
_FREE_ELEMENTS = 1 << 16


def read_gltf(path: PathLike) -> Gltf:
    """Read a .gltf or .glb file as a document.

    Raises
    ------
    OSError
        If the file is missing or cannot be read.
    MeshError
        If it is no glTF 2.0, or requires an extension that is not known.
    """
    found = as_path(path)
    data = read_file(found, MeshError)
    try:
        return Gltf(found, data)
    except MeshError as error:
        raise MeshError(f"{found}: {error}") from error


class Gltf:
    """A glTF 2.0 document.

    Attributes
    ----------
    path : Path
        The file. What it refers to must lie in its folder or below.
    tree : Entry
        The JSON tree; `tree.raw` is the object as the file has it, materials, cameras and animations included.
    required : frozenset of str
        The names in `extensionsRequired`, all of them known.
    size : int
        The bytes that were read so far: of the file, and of the files that it refers to. What the document may
        allocate depends on it.

    Methods raise `MeshError` with the place in the tree, such as `accessors[3].count`, and what was expected there.
    Nothing that the tree refers to is read before it is needed.
    """

    def __init__(self, path: Path, data: bytes) -> None:
        raw, self._binary = container.parse(data)
        self.path = path
        self.tree = Entry("", raw)
        self.size = len(data)
        self.required = extensions.required(self.tree)
        self._buffers: dict[int, bytes | memoryview] = {}
        self._files: dict[str, bytes] = {}
        self._views: dict[int, accessors.View] = {}

    def count(self, kind: str) -> int:
        """Return how many entries a list of the root has: "nodes", "meshes", "accessors", ...; 0 without the list."""
        return len(self.tree.entries(kind))

    def entry(self, kind: str, index: int) -> Entry:
        """Return one entry of a list of the root."""
        count = self.count(kind)
        if not 0 <= index < count:
            raise MeshError(f"{kind}: expected an index below {count}, got {index}")
        return self.tree.member(kind, index)

    def all(self, kind: str) -> list[Entry]:
        """Return all entries of a list of the root."""
        return [self.tree.member(kind, index) for index in range(self.count(kind))]

    @functools.cached_property
    def nodes(self) -> NodeTree:
        """The tree of nodes with the matrix of each node in the world."""
        return NodeTree(self.all("nodes"))

    @property
    def has_binary(self) -> bool:
        """Whether the file is a GLB with a chunk of binary data, which is the first buffer."""
        return self._binary is not None

    @property
    def most_bytes(self) -> int:
        """How many bytes one compressed buffer view may become: 8 MiB, and 64 for each byte of the file."""
        return _FREE_BYTES + 64 * self.size

    def layout(self, index: int) -> accessors.Layout:
        """Return count, type and component type of an accessor, without its numbers."""
        return accessors.layout(self.entry("accessors", index))

    def stored(self, index: int) -> npt.NDArray[Any]:
        """Return the numbers of an accessor as they are stored, without `normalized`.

        Returns
        -------
        ndarray
            (count,) for scalars, (count, n) for vectors, (count, n, n) for matrices, which act on column vectors; the
            dtype is that of the file. Read-only, except where `sparse` made a copy.
        """
        entry = self.entry("accessors", index)
        return accessors.stored(entry, self._view_of, lambda: _FREE_ELEMENTS + 2 * self.size)

    def accessor(self, index: int) -> npt.NDArray[Any]:
        """Return the numbers that an accessor stands for: those of `stored`, with `normalized` integers as float64."""
        return accessors.decoded(self.stored(index), self.layout(index).normalized)

    def _view_of(self, entry: Entry) -> accessors.View | None:
        index = entry.index("bufferView", self.count("bufferViews"))
        return None if index is None else self.view(index)

    def view(self, index: int) -> accessors.View:
        """Return the bytes of a buffer view, without compression, and its stride."""
        entry = self.entry("bufferViews", index)
        if index in self._views:
            return self._views[index]
        length = entry.integer("byteLength")
        stride = entry.integer("byteStride", 0)
        unpacked = compression.unpacked(self, entry)
        if unpacked is None:
            return accessors.View(self.part(entry, length), stride)
        # Decoding takes time, so the result is kept.
        return self._views.setdefault(index, accessors.View(unpacked, stride))

    def part(self, entry: Entry, length: int) -> memoryview:
        """Return the bytes of a buffer that an entry names by `buffer`, `byteOffset` and `byteLength`."""
        number = entry.index("buffer", self.count("buffers"))
        if number is None:
            raise entry.error("buffer", "an index")
        data = self.buffer(number)
        offset = entry.integer("byteOffset", 0)
        if offset + length > len(data):
            raise MeshError(
                f"{entry.where}: expected {offset + length} bytes in buffers[{number}], got {len(data)}"
            )
        return memoryview(data)[offset : offset + length]

    def buffer(self, index: int) -> bytes | memoryview:
        """Return the bytes of a buffer."""
        if index not in self._buffers:
            entry = self.entry("buffers", index)
            length = entry.integer("byteLength")
            data = self._buffer_source(entry, index)
            if len(data) < length:
                raise entry.error("byteLength", f"at most the {len(data)} bytes that are there")
            self._buffers[index] = memoryview(data)[:length]
        return self._buffers[index]

    def _buffer_source(self, entry: Entry, index: int) -> bytes | memoryview:
        uri = entry.text("uri")
        if uri is None:
            if index == 0 and self._binary is not None:
                return self._binary
            raise entry.error("uri", "a URI, because the file has no binary chunk for this buffer")
        if uri not in self._files:
            try:
                self._files[uri] = read_uri(uri, self.path.parent)
            except MeshError as error:
                raise MeshError(f"{entry.path('uri')}: {error}") from None
            self.size += len(self._files[uri])
        return self._files[uri]
