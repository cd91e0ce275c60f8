"""How much a document may become: nodes and instances repeat a mesh, so that a small file can stand for a lot."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..._core import MeshError
from .entries import Entry

if TYPE_CHECKING:
    from .document import Gltf

#: Vertices and triangles of the result: this many for any file, and 8 for each of its bytes. Draco needs about one byte
#: for a vertex. Four million are about 200 MiB of arrays.
_FREE_OUTPUT = 4 << 20

#: Numbers of morph targets that are added up, which takes time and no memory: this many, and 64 for each byte.
_FREE_MORPHS = 64 << 20

#: An instance counts as this many vertices: its matrix takes their memory.
_OF_INSTANCE = 4

#: Nodes of a scene: this many for any file, and one for each of its bytes.
_FREE_NODES = 1 << 16


class Limits:
    """Counts what a document becomes, before it is made, and raises `MeshError` where it is too much."""

    def __init__(self, document: Gltf) -> None:
        self._document = document
        self._output = 0
        self._morphs = 0
        self._nodes = 0
        self._motion = 0

    @property
    def left(self) -> int:
        """The vertices and triangles that may still be made."""
        return max(0, _FREE_OUTPUT + 8 * self._document.size - self._output)

    def output(self, count: int, entry: Entry) -> None:
        """Count vertices and triangles."""
        if count > self.left:
            most = self._output + self.left
            raise MeshError(
                f"{entry.where}: expected at most {most} vertices and triangles of a file of "
                f"{self._document.size} bytes, got {self._output + count} or more"
            )
        self._output += count

    def instances(self, count: int, entry: Entry) -> None:
        self.output(_OF_INSTANCE * count, entry)

    def nodes(self, count: int, entry: Entry) -> None:
        """Count nodes of a scene, which take a thousand bytes each."""
        self._nodes += count
        most = _FREE_NODES + self._document.size
        if self._nodes > most:
            raise MeshError(
                f"{entry.where or 'nodes'}: expected at most {most} nodes in a file of "
                f"{self._document.size} bytes, got {self._nodes} or more"
            )

    def motion(self, count: int, entry: Entry) -> None:
        """Count numbers of animations, since many channels may share an accessor."""
        self._motion += count
        most = _FREE_OUTPUT + 8 * self._document.size
        if self._motion > most:
            raise MeshError(
                f"{entry.where}: expected at most {most} numbers of animations in a file of "
                f"{self._document.size} bytes, got more"
            )

    def morphs(self, count: int, entry: Entry) -> None:
        """Count numbers of morph targets."""
        self._morphs += count
        most = _FREE_MORPHS + 64 * self._document.size
        if self._morphs > most:
            raise MeshError(
                f"{entry.where}: expected at most {most} numbers of morph targets in a file of "
                f"{self._document.size} bytes, got more"
            )
