"""The triangles of a scene, each mesh at the places where nodes show it (sections 3.5 and 3.7.4 of glTF 2.0)."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from ..._core import MeshError
from ..meshes.parts import Part, unit_normals
from ..meshes.placing import Matrices, placed
from .compression import Draco, package
from .deformation import morph, skin
from .document import Gltf
from .entries import Entry
from .extensions import DRACO, INSTANCING
from .limits import Limits
from .matrices import composed, rotations
from .nodes import hidden
from .primitives import MODES, Attributes, Surface, accessor_index, from_bottom, surface


def read(path: Path, data: bytes) -> list[Part]:
    """Read the triangles of the default scene: a part for each primitive, with all nodes that show it alike."""
    return Geometry(Gltf(path, data)).parts()


@dataclass(frozen=True)
class Shape:
    """What a node shows: a mesh, with the skin and the morph weights that the node has."""

    mesh: int
    skin: int | None = None
    weights: tuple[float, ...] | None = None


class Geometry:
    """The triangles of a document."""

    def __init__(self, document: Gltf, limits: Limits | None = None) -> None:
        self.document = document
        self._limits = Limits(document) if limits is None else limits
        self._draco: dict[int, Draco] = {}
        self._skipped: set[str] = set()

    def parts(self) -> list[Part]:
        """Return the parts of the default scene, in the order in which its nodes first show them."""
        with np.errstate(all="ignore"):  # what becomes infinite or NaN is refused
            parts = [
                self._placed(found, np.concatenate(matrices))
                for shape, matrices in self.shown().items()
                for found in self.surfaces(shape)
            ]
        if not parts:
            got = " and ".join(sorted(self._skipped)) or "no mesh"
            raise MeshError(f"expected triangles in the default scene, got {got}")
        return parts

    def scene_nodes(self) -> list[int]:
        """Return the nodes of the default scene that are visible, parents before children, in the file's order.

        The scene is the one that `scene` names, else the first; without scenes, all nodes are in it (section 3.5.1).
        """
        document, tree = self.document, self.document.nodes
        number = document.tree.index("scene", document.count("scenes"))
        roots = tree.roots
        if document.count("scenes"):
            roots = document.entry("scenes", number or 0).indices("nodes", document.count("nodes"))
        return tree.below(roots, hidden(document.all("nodes")))

    def shown(self) -> dict[Shape, list[Matrices]]:
        """Return the matrices, in arrays of (N, 4, 4), with which the default scene shows each mesh."""
        document = self.document
        meshes = document.count("meshes")
        if not document.count("nodes"):  # a library of meshes, each where it is
            return {Shape(index): [np.eye(4)[None]] for index in range(meshes)}
        found: dict[Shape, list[Matrices]] = {}
        for index in self.scene_nodes():
            node = document.entry("nodes", index)
            mesh = node.index("mesh", meshes)
            if mesh is None:
                continue
            bones = node.index("skin", document.count("skins"))
            weights = node.numbers("weights")
            # The joints alone place a skinned mesh (section 3.7.3.1), so that instances have no meaning.
            matrices = np.eye(4)[None]
            if bones is None:
                matrices = document.nodes.worlds[index] @ instances(document, node, self._limits)
            shape = Shape(mesh, bones, None if weights is None else tuple(weights))
            found.setdefault(shape, []).append(matrices)
        return found

    def surfaces(self, shape: Shape) -> list[Surface]:
        """Return the primitives of a mesh that have triangles, in the space of the mesh; with a skin, in the world."""
        mesh = self.document.entry("meshes", shape.mesh)
        weights = mesh.numbers("weights") if shape.weights is None else list(shape.weights)
        found = []
        for index in range(len(mesh.entries("primitives"))):
            result = self.surface(mesh.member("primitives", index))
            if result is None:
                continue
            morph(self.document, result, weights, self._limits)
            if shape.skin is not None:
                skin(self.document, result, self.document.entry("skins", shape.skin))
            found.append(result)
        return found

    def surface(self, primitive: Entry) -> Surface | None:
        """Read a primitive, in the space of its mesh; None if it has no triangles."""
        mode = primitive.integer("mode", 4)
        if mode >= len(MODES):
            raise primitive.error("mode", "an integer from 0 to 6")
        if mode < 4:
            self._skipped.add(MODES[mode])
            return None
        result = surface(self.document, primitive, self._decompressed(primitive), self._limits)
        if result is None:
            self._skipped.add("primitives without vertices")
        return result

    def _decompressed(self, primitive: Entry) -> Draco | None:
        """Decode KHR_draco_mesh_compression; None without it, or where plain data can take its place."""
        entry = primitive.extension(DRACO)
        if entry is None:
            return None
        if MODES[primitive.integer("mode", 4)] == "fans":
            raise primitive.error("mode", f"4 or 5 with {DRACO}")
        try:
            package("DracoPy", DRACO)
        except MeshError:
            attributes = primitive.needed("attributes")
            position = accessor_index(self.document, attributes, "POSITION")
            plain = "bufferView" in self.document.entry("accessors", position)
            if DRACO in self.document.required or not plain:
                raise
            return None
        view = entry.index("bufferView", self.document.count("bufferViews"))
        if view is None:
            raise entry.error("bufferView", "an index")
        if view not in self._draco:
            self._draco[view] = Draco(entry, bytes(self.document.view(view).data), self._limits)
        return self._draco[view]

    def _placed(self, shape: Surface, matrices: Matrices) -> Part:
        """Repeat a primitive for each matrix."""
        times, vertices = len(matrices), len(shape.positions)
        self._limits.output((vertices + len(shape.faces)) * (times - 1), shape.entry)
        # The specification asks for flat normals where a file has none. load_mesh promises smooth ones for every kind
        # of file; `flat_shading` of a material draws any mesh flat.
        uvs, uvs1 = (
            None if given is None else from_bottom(given) for given in (shape.uvs, shape.uvs1)
        )
        try:
            part = Part(
                shape.positions, shape.faces, shape.normals, uvs, shape.colors, uvs1, shape.tangents
            )
            part.normals = unit_normals(part)
            return placed(part, matrices)
        except ValueError as error:
            raise MeshError(f"{shape.entry.where}: {error}") from None


def instances(document: Gltf, node: Entry, limits: Limits) -> Matrices:
    """Read the matrices of EXT_mesh_gpu_instancing, (N, 4, 4); without it, one that changes nothing."""
    extension = node.extension(INSTANCING)
    entry = None if extension is None else extension.needed("attributes")
    if entry is None or not entry.raw:
        return np.eye(4)[None]
    count = document.layout(accessor_index(document, entry, next(iter(entry.raw)))).count
    limits.instances(count, entry)
    attributes = Attributes(document, entry, count)
    place = attributes.floats("TRANSLATION", "VEC3")
    scale = attributes.floats("SCALE", "VEC3")
    quaternions = attributes.floats("ROTATION", "VEC4")
    turn = np.broadcast_to(np.eye(3), (count, 3, 3))
    if quaternions is not None:
        turn = rotations(quaternions, lambda index: f"{entry.path('ROTATION')}: {index}")
    return composed(
        np.zeros((count, 3)) if place is None else place,
        turn,
        np.ones((count, 3)) if scale is None else scale,
    )
