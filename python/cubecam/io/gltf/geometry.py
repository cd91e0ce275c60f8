"""From meshes, skins, morph targets and instances to triangles in the world (sections 3.7 and 3.8 of glTF 2.0)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from ..meshes.parts import Part, unit_normals
from .accessors import Layout, decoded
from .compression import Draco, package
from .document import Gltf, as_floats
from .entries import Entry
from .extensions import DRACO, INSTANCING
from .nodes import Matrices, composed, hidden, rotations

Floats = npt.NDArray[np.float64]
Faces = npt.NDArray[np.int64]

#: Vertices and triangles that a file may become: this many, and 8 for each of its bytes. Nodes and instances repeat a
#: mesh, so that a small file can stand for any number of vertices.
_FREE_OUTPUT = 4 << 20

#: Numbers of morph targets that are added up, in the same way.
_FREE_MORPHS = 64 << 20

_LARGEST = float(np.finfo(np.float32).max)


def read(path: Path, data: bytes) -> list[Part]:
    """Read the triangles of the default scene: a part for each primitive, with all nodes that show it alike."""
    with np.errstate(all="ignore"):  # what becomes infinite or NaN is refused below
        return Geometry(Gltf(path, data)).parts()


@dataclass(frozen=True)
class _Shape:
    """What a node shows: a mesh with the skin and the morph weights of the node."""

    mesh: int
    skin: int | None
    weights: tuple[float, ...] | None


@dataclass
class _Surface:
    """The triangles of one primitive in the space of its mesh. Normals may have any length, and may be missing."""

    positions: Floats
    faces: Faces
    normals: Floats | None
    uvs: Floats | None
    colors: Floats | None
    entry: Entry
    attribute: Callable[[str], npt.NDArray[Any] | None] = field(repr=False)


class Geometry:
    """The triangles of a document."""

    def __init__(self, document: Gltf) -> None:
        self.document = document
        self._draco: dict[int, Draco] = {}
        self._spent = 0
        self._morphed = 0
        self._skipped: set[str] = set()

    def parts(self) -> list[Part]:
        """Return the parts of the default scene, in the order in which its nodes first show them."""
        parts = []
        for shape, matrices in self._shown().items():
            for surface in self._surfaces(shape):
                parts.append(self._placed(surface, np.concatenate(matrices)))
        if not parts:
            got = ", ".join(sorted(self._skipped)) or "no mesh"
            raise MeshError(f"expected triangles in the default scene, got {got}")
        return parts

    # Nodes

    def shown_nodes(self) -> list[int]:
        """Return the nodes of the default scene that are visible, parents before children, in the file's order.

        That is the scene that `scene` names, else the first one; without scenes it is all nodes (section 3.5.1).
        """
        document, tree = self.document, self.document.nodes
        scenes = document.count("scenes")
        number = document.tree.index("scene", scenes)
        roots = tree.roots
        if scenes:
            scene = document.entry("scenes", number or 0)
            roots = scene.indices("nodes", document.count("nodes"))
        return tree.below(roots, hidden(document.all("nodes")))

    def _shown(self) -> dict[_Shape, list[Matrices]]:
        """Return the matrices, (N, 4, 4) arrays, with which each mesh is shown."""
        document = self.document
        shown: dict[_Shape, list[Matrices]] = {}
        meshes = document.count("meshes")
        if not document.count("nodes"):  # a library of meshes: each one where it is
            return {_Shape(index, None, None): [np.eye(4)[None]] for index in range(meshes)}
        for index in self.shown_nodes():
            node = document.entry("nodes", index)
            mesh = node.index("mesh", meshes)
            if mesh is None:
                continue
            skin = node.index("skin", document.count("skins"))
            weights = node.numbers("weights")
            shape = _Shape(mesh, skin, None if weights is None else tuple(weights))
            # The joints alone place a skinned mesh (section 3.7.3.1), so that instances have no meaning.
            matrices = np.eye(4)[None]
            if skin is None:
                matrices = document.nodes.worlds[index] @ self._instances(node)
            shown.setdefault(shape, []).append(matrices)
        return shown

    def _instances(self, node: Entry) -> Matrices:
        """Read the matrices of EXT_mesh_gpu_instancing, (N, 4, 4); one that changes nothing without it."""
        extension = node.extension(INSTANCING)
        attributes = None if extension is None else extension.needed("attributes")
        if attributes is None or not attributes.raw:
            return np.eye(4)[None]
        numbers = {key: self._index(attributes, key) for key in attributes.raw}
        counts = {self.document.layout(number).count for number in numbers.values()}
        if len(counts) > 1:
            raise MeshError(
                f"{attributes.where}: expected accessors of one count, got {sorted(counts)}"
            )
        count = counts.pop()
        self._spend(count, attributes)
        place = self._column(attributes, "TRANSLATION", ["VEC3"], count, 0.0)
        scale = self._column(attributes, "SCALE", ["VEC3"], count, 1.0)
        turn = np.broadcast_to(np.eye(3), (count, 3, 3))
        if "ROTATION" in attributes:
            quaternions = self._column(attributes, "ROTATION", ["VEC4"], count, 0.0)
            turn = rotations(quaternions, lambda index: f"{attributes.path('ROTATION')} {index}")
        return composed(place, turn, scale)

    def _column(
        self, attributes: Entry, key: str, kinds: list[str], count: int, missing: float
    ) -> Floats:
        if key not in attributes:
            return np.full((count, 3), missing)
        number = self._index(attributes, key)
        self._check_kind(attributes, key, self.document.layout(number), kinds)
        return as_floats(self.document.accessor(number))

    # Primitives

    def _surfaces(self, shape: _Shape) -> list[_Surface]:
        mesh = self.document.entry("meshes", shape.mesh)
        surfaces = []
        for index in range(len(mesh.entries("primitives"))):
            surface = self._surface(mesh.member("primitives", index))
            if surface is None:
                continue
            self._morph(surface, mesh, shape.weights)
            if shape.skin is not None:
                self._skin(surface, self.document.entry("skins", shape.skin))
            surfaces.append(surface)
        return surfaces

    def _surface(self, primitive: Entry) -> _Surface | None:
        """Read one primitive; None if it has no triangles."""
        mode = primitive.integer("mode", 4)
        if mode > 6:
            raise primitive.error("mode", "an integer from 0 to 6")
        if mode < 4:
            self._skipped.add("points" if mode == 0 else "lines")
            return None
        attributes = primitive.needed("attributes")
        if "POSITION" not in attributes:
            self._skipped.add("primitives without POSITION")
            return None
        draco = self._decompressed(primitive, attributes)
        ids = None if draco is None else primitive.needed("extensions").needed(DRACO)
        read = _Attributes(self, attributes, draco, ids and ids.needed("attributes"))
        positions = as_floats(read.floats("POSITION", ["VEC3"]))
        faces = draco.faces if draco is not None else self._faces(primitive, len(positions), mode)
        self._spend(len(positions) + len(faces), primitive)
        if not len(faces):
            self._skipped.add("primitives without indices")
            return None
        if not (np.abs(positions) <= _LARGEST).all():
            raise MeshError(f"{attributes.path('POSITION')}: expected finite numbers, got others")
        normals = uvs = colors = None
        if "NORMAL" in attributes:
            normals = as_floats(read.floats("NORMAL", ["VEC3"]))
        if "TEXCOORD_0" in attributes:
            uvs = as_floats(read.floats("TEXCOORD_0", ["VEC2"])).copy()
        if "COLOR_0" in attributes:
            colors = _colors(read.floats("COLOR_0", ["VEC3", "VEC4"]), 1.0)
        return _Surface(positions, faces, normals, uvs, colors, primitive, read.any)

    def _faces(self, primitive: Entry, vertices: int, mode: int) -> Faces:
        """Read the triangles, (T, 3), of a primitive (section 3.7.2.1)."""
        number = primitive.index("indices", self.document.count("accessors"))
        if number is None:
            corners: Faces = np.arange(vertices, dtype=np.int64)
        else:
            form = self.document.layout(number)
            if form.kind != "SCALAR" or form.component.kind != "u" or form.normalized:
                raise primitive.error("indices", "an accessor of unsigned integer scalars")
            stored = self.document.stored(number)
            if len(stored):
                largest = int(stored.max())
                if largest == np.iinfo(stored.dtype).max:
                    raise primitive.error(
                        "indices",
                        f"no index {largest}, which starts a new primitive, in the accessor",
                    )
                if largest >= vertices:
                    raise MeshError(
                        f"{primitive.path('indices')}: expected indices below {vertices}, got {largest}"
                    )
            corners = stored.astype(np.int64)
        count = len(corners)
        if mode == 4:
            if count % 3:
                raise MeshError(
                    f"{primitive.where}: expected a number of vertices that 3 divides, got {count}"
                )
            return corners.reshape(-1, 3)
        if count < 3:
            if count == 0:
                return corners.reshape(-1, 3)
            raise MeshError(f"{primitive.where}: expected 3 vertices or more, got {count}")
        first = np.arange(count - 2)
        if mode == 5:
            odd = first % 2
            return corners[np.stack([first, first + 1 + odd, first + 2 - odd], axis=1)]
        return corners[np.stack([first + 1, first + 2, np.zeros_like(first)], axis=1)]

    def _decompressed(self, primitive: Entry, attributes: Entry) -> Draco | None:
        """Decode KHR_draco_mesh_compression; None without it, or where plain data can take its place."""
        entry = primitive.extension(DRACO)
        if entry is None:
            return None
        if primitive.integer("mode", 4) == 6:
            raise primitive.error("mode", f"triangles or a strip with {DRACO}")
        try:
            package("DracoPy", DRACO)
        except MeshError:
            position = self.document.entry("accessors", self._index(attributes, "POSITION"))
            if DRACO not in self.document.required and "bufferView" in position:
                return None
            raise
        view = entry.index("bufferView", self.document.count("bufferViews"))
        if view is None:
            raise entry.error("bufferView", "an index")
        if view not in self._draco:
            self._draco[view] = Draco(self.document, entry, self._most() - self._spent)
        return self._draco[view]

    def _index(self, attributes: Entry, key: str) -> int:
        number = attributes.index(key, self.document.count("accessors"))
        if number is None:
            raise attributes.error(key, "an index")
        return number

    @staticmethod
    def _check_kind(attributes: Entry, key: str, form: Layout, kinds: list[str]) -> None:
        if form.kind not in kinds:
            raise MeshError(
                f"{attributes.path(key)}: expected an accessor of {' or '.join(kinds)}, got {form.kind}"
            )

    # Morph targets and skins

    def _morph(self, surface: _Surface, mesh: Entry, own: tuple[float, ...] | None) -> None:
        """Add the morph targets with the default weights: the node's, else the mesh's, else 0 (section 3.7.2.2)."""
        primitive = surface.entry
        count = len(primitive.entries("targets"))
        weights = list(own) if own is not None else mesh.numbers("weights")
        if not count or weights is None:
            return
        if len(weights) != count:
            raise MeshError(
                f"{primitive.path('targets')}: expected {len(weights)} targets, one a weight, got {count}"
            )
        for index, weight in enumerate(weights):
            if weight:
                self._add_target(surface, primitive.member("targets", index), weight)
        if surface.colors is not None:
            surface.colors = np.clip(surface.colors, 0, 1)

    def _add_target(self, surface: _Surface, target: Entry, weight: float) -> None:
        read = _Attributes(self, target, count=len(surface.positions))
        self._morphed += len(surface.positions) * max(1, len(target.raw))
        if self._morphed > _FREE_MORPHS + 64 * self.document.size:
            raise MeshError(
                f"{target.where}: expected fewer numbers of morph targets in a file of "
                f"{self.document.size} bytes"
            )
        if "POSITION" in target:
            surface.positions = surface.positions + weight * read.floats("POSITION", ["VEC3"])
        if "NORMAL" in target and surface.normals is not None:
            surface.normals = surface.normals + weight * read.floats("NORMAL", ["VEC3"])
        if "TEXCOORD_0" in target and surface.uvs is not None:
            surface.uvs = surface.uvs + weight * read.floats("TEXCOORD_0", ["VEC2"])
        if "COLOR_0" in target and surface.colors is not None:
            change = _colors(read.floats("COLOR_0", ["VEC3", "VEC4"]), 0.0)
            surface.colors = surface.colors + weight * change

    def _skin(self, surface: _Surface, skin: Entry) -> None:
        """Move the vertices by the joints at their default pose (section 3.7.3.3)."""
        joints = self._joint_matrices(skin)
        positions, normals = surface.positions, surface.normals
        blended = np.zeros((len(positions), 3, 4))
        total = np.zeros(len(positions))
        level = 0
        for level in range(len(surface.entry.needed("attributes").raw)):
            if not self._add_joints(surface, level, joints, blended, total):
                break
        lost = total == 0  # a vertex without weights goes with the first joint
        blended[lost], total[lost] = joints[0, :3], 1
        blended /= total[:, None, None]
        linear = blended[:, :, :3]
        surface.positions = (linear @ positions[:, :, None])[:, :, 0] + blended[:, :, 3]
        sides = np.sign(np.linalg.det(linear))
        if normals is not None:
            surface.normals = (_cofactors(linear) @ normals[:, :, None])[:, :, 0]
            surface.normals *= np.where(sides < 0, -1.0, 1.0)[:, None]
        mirrored = sides[surface.faces].sum(axis=1) < 0
        surface.faces = np.where(mirrored[:, None], surface.faces[:, ::-1], surface.faces)

    def _joint_matrices(self, skin: Entry) -> Matrices:
        numbers = skin.indices("joints", self.document.count("nodes"))
        if not numbers:
            raise skin.error("joints", "a list of indices")
        matrices = self.document.nodes.worlds[numbers]
        inverse = skin.index("inverseBindMatrices", self.document.count("accessors"))
        if inverse is None:
            return matrices
        self._check_kind(skin, "inverseBindMatrices", self.document.layout(inverse), ["MAT4"])
        bind = as_floats(self.document.accessor(inverse))
        if len(bind) < len(numbers):
            raise skin.error("inverseBindMatrices", f"an accessor of {len(numbers)} matrices")
        return matrices @ bind[: len(numbers)]

    def _add_joints(
        self, surface: _Surface, level: int, joints: Matrices, blended: Floats, total: Floats
    ) -> bool:
        """Add the weighted matrices of JOINTS_n and WEIGHTS_n; return whether there are such attributes."""
        entry = surface.entry.needed("attributes")
        names = f"JOINTS_{level}", f"WEIGHTS_{level}"
        if level and names[0] not in entry and names[1] not in entry:
            return False
        which, weights = (surface.attribute(name) for name in names)
        for name, values in zip(names, (which, weights), strict=True):
            if values is None or values.ndim != 2 or values.shape[1] != 4:
                raise entry.error(name, "an accessor of VEC4")
        assert which is not None
        assert weights is not None
        weights = as_floats(weights)
        if not (np.isfinite(weights).all() and (weights >= 0).all()):
            raise MeshError(f"{entry.path(names[1])}: expected weights of 0 or more, got others")
        which = np.where(weights > 0, which, 0).astype(np.int64)
        if which.size and not 0 <= which.min() <= which.max() < len(joints):
            raise MeshError(
                f"{entry.path(names[0])}: expected joints below {len(joints)}, got {which.max()}"
            )
        for column in range(4):
            blended += weights[:, column, None, None] * joints[which[:, column], :3]
        total += weights.sum(axis=1)
        return True

    # The world

    def _placed(self, surface: _Surface, matrices: Matrices) -> Part:
        """Repeat a primitive for each matrix."""
        where = surface.entry
        self._spend((len(surface.positions) + len(surface.faces)) * (len(matrices) - 1), where)
        local = Part(surface.positions, surface.faces, surface.normals, None, None)
        # Section 3.7.2.1 asks for flat normals where a file has none. load_mesh promises smooth ones for every kind of
        # file; a material draws flat faces of any mesh (flat_shading).
        normals = unit_normals(local)
        times, vertices = len(matrices), len(surface.positions)
        linear = matrices[:, :3, :3]
        positions = surface.positions @ linear.transpose(0, 2, 1) + matrices[:, None, :3, 3]
        if not (np.abs(positions) <= _LARGEST).all():
            raise MeshError(f"{where.where}: expected positions that float32 can hold, got others")
        sides = np.where(np.linalg.det(_scaled(linear)) < 0, -1.0, 1.0)
        turned = normals @ (_cofactors(_scaled(linear)) * sides[:, None, None]).transpose(0, 2, 1)
        faces = np.where(sides[:, None, None] < 0, surface.faces[:, ::-1], surface.faces)
        faces = faces + np.arange(times)[:, None, None] * vertices
        uvs = surface.uvs
        if uvs is not None:
            # glTF counts v from the top of a picture, cubecam from its bottom.
            uvs = np.tile(np.stack([uvs[:, 0], 1 - uvs[:, 1]], axis=1), (times, 1))
        colors = None if surface.colors is None else np.tile(surface.colors, (times, 1))
        return Part(
            positions.reshape(-1, 3), faces.reshape(-1, 3), turned.reshape(-1, 3), uvs, colors
        )

    def _most(self) -> int:
        return _FREE_OUTPUT + 8 * self.document.size

    def _spend(self, count: int, entry: Entry) -> None:
        """Count vertices and triangles of the result, before they are made."""
        self._spent += count
        if self._spent > self._most():
            raise MeshError(
                f"{entry.where}: expected at most {self._most()} vertices and triangles of a file of "
                f"{self.document.size} bytes, got {self._spent}"
            )


class _Attributes:
    """The attributes of a primitive, or of a morph target: all of them have as many elements as POSITION."""

    def __init__(
        self,
        geometry: Geometry,
        entry: Entry,
        draco: Draco | None = None,
        ids: Entry | None = None,
        count: int | None = None,
    ) -> None:
        self._geometry = geometry
        self._entry = entry
        self._draco = draco
        self._ids = ids
        self._count = count

    def any(self, key: str) -> npt.NDArray[Any] | None:
        """Read an attribute of any kind, such as TEXCOORD_1 or _CUSTOM; None if there is none."""
        if key not in self._entry:
            return None
        number = self._geometry._index(self._entry, key)
        document = self._geometry.document
        form = document.layout(number)
        if self._draco is not None and self._ids is not None and key in self._ids:
            values = decoded(*self._draco.values(self._ids, key, form))
        else:
            values = document.accessor(number)
        if self._count is None:
            self._count = len(values)
        if len(values) != self._count:
            raise MeshError(
                f"{self._entry.path(key)}: expected {self._count} elements as in POSITION, got {len(values)}"
            )
        return values

    def floats(self, key: str, kinds: list[str]) -> npt.NDArray[Any]:
        form = self._geometry.document.layout(self._geometry._index(self._entry, key))
        self._geometry._check_kind(self._entry, key, form, kinds)
        values = self.any(key)
        assert values is not None
        return values


def _colors(values: npt.NDArray[Any], alpha: float) -> Floats:
    """Turn COLOR_0, or what a target adds to it, into (V, 4) floats."""
    if values.dtype.kind == "u":  # without the flag `normalized`, which the specification wants
        values = decoded(values, True)
    colors = as_floats(values)
    if colors.shape[1] == 3:
        colors = np.concatenate([colors, np.full((len(colors), 1), alpha)], axis=1)
    return np.clip(colors, 0, 1) if alpha else colors


def _scaled(linear: Floats) -> Floats:
    """Scale (N, 3, 3) matrices so that their largest number is 1: their cofactors do not overflow then."""
    largest = np.abs(linear).max(axis=(1, 2), keepdims=True)
    return np.where(largest > 0, linear / np.where(largest > 0, largest, 1), 0.0)


def _cofactors(linear: Floats) -> Floats:
    """Return the cofactors of (N, 3, 3) matrices: the inverse transpose up to a factor, also of a singular matrix."""
    a, b, c = linear[:, 0], linear[:, 1], linear[:, 2]
    return np.stack([np.cross(b, c), np.cross(c, a), np.cross(a, b)], axis=1)
