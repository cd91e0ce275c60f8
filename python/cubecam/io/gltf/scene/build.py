"""The steps from a document to a scene."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from ...._core import Material, Node, Scene
from ...left_out import LeftOut
from ..deformation import joints_of
from ..document import Gltf
from ..entries import Entry
from ..extensions import INSTANCING, unread
from ..extras import Extras
from ..geometry import instances
from ..limits import Limits
from ..nodes import hidden
from .animations import Animations
from .cameras import camera_of
from .environment import add_environment
from .lights import light_of
from .materials import Materials
from .meshes import Meshes, Primitive
from .skins import Skins
from .textures import Textures
from .values import at
from .variants import variant_materials, variant_names

#: What takes the place of a scale of 0: a node's matrix must have an inverse.
_SMALLEST = 1e-6


def read_scene(path: Path, data: bytes, left_out: LeftOut) -> Scene:
    """Read the default scene of a glTF file, else its first one; without scenes, all nodes (section 3.5.1)."""
    document = Gltf(path, data)
    for name in unread(document.tree):
        left_out.add(f"the extension {name} is not read")
    return _Builder(document, left_out).scene()


@dataclass
class Parts:
    """The objects that were made of the entries of a document, by their indices there."""

    #: The image of a texture.
    texture: Any
    nodes: dict[int, Node] = field(default_factory=dict)
    #: The nodes that show a glTF node's mesh: itself, or those below it.
    shown: dict[int, list[Node]] = field(default_factory=dict)
    meshes: dict[int, list[Any]] = field(default_factory=dict)
    materials: dict[int, Material] = field(default_factory=dict)
    #: By the index of the node.
    lights: dict[int, Any] = field(default_factory=dict)
    cameras: dict[int, Any] = field(default_factory=dict)
    animations: list[Any] = field(default_factory=list)


class _Builder:
    def __init__(self, document: Gltf, left_out: LeftOut) -> None:
        self.document = document
        self.left_out = left_out
        self.limits = Limits(document)
        self.extras = Extras(document)
        self.textures = Textures(document, self.extras, left_out)
        self.materials = Materials(document, self.textures, self.extras, left_out)
        self.parts = Parts(self.textures.image)
        self.variants = variant_names(document)

    def scene(self) -> Scene:
        document = self.document
        scene = Scene()
        order = self._order()
        entries = {index: document.entry("nodes", index) for index in order}
        self.textures.prepare(self._used_materials(entries.values()))
        self.meshes = Meshes(document, self.textures.sets, self.limits, self.left_out)
        unseen = hidden(document.all("nodes"))
        for index, entry in entries.items():
            with at(entry):
                self.parts.nodes[index] = _placed(scene, entry, index not in unseen)
        for index in order:
            parent = document.nodes.parents[index]
            if parent in self.parts.nodes:
                self.parts.nodes[index].parent = self.parts.nodes[parent]
        scene.variants = self.variants
        skins = Skins(document, self.parts.nodes)
        for index, entry in entries.items():
            self._show(scene, index, entry)
            self._bend(index, entry, skins)
        self._add_lights_and_cameras(scene, entries)
        motion = Animations(
            document, self.parts.nodes, self.parts.shown, self.limits, self.left_out
        )
        self.parts.animations = motion.all()
        for animation in self.parts.animations:
            if animation is not None:
                scene.add(animation)
        add_environment(document, scene, self.textures, self.left_out)
        self.parts.meshes = {
            index: [primitive.mesh for primitive in found]
            for index, found in self.meshes.primitives.items()
        }
        if self.extras:  # they may name any material
            for index in range(document.count("materials")):
                self.materials.get(index)
        self.parts.materials = {
            index: material for index, material in self.materials.made.items() if index is not None
        }
        self.extras.finish(scene, self.parts)
        return scene

    def _bend(self, index: int, entry: Entry, skins: Skins) -> None:
        """Give the nodes that show a mesh its skin and the weights of its morph targets."""
        document = self.document
        number = entry.index("skin", document.count("skins"))
        mesh = entry.index("mesh", document.count("meshes"))
        weights = entry.numbers("weights")
        if weights is None and mesh is not None:
            weights = document.entry("meshes", mesh).numbers("weights")
        with at(entry):
            for node in self.parts.shown.get(index, []):
                if weights is not None and len(node.weights):
                    node.weights = weights
                if number is not None and node.mesh is not None and node.mesh.joints is not None:
                    node.skin = skins.get(number)

    def _add_lights_and_cameras(self, scene: Scene, entries: dict[int, Entry]) -> None:
        for index, entry in entries.items():
            node = self.parts.nodes[index]
            light = light_of(self.document, entry, node, self.left_out)
            if light is not None:
                self.parts.lights[index] = scene.add(light)
            camera = camera_of(self.document, entry, node, self.left_out)
            if camera is not None:
                self.parts.cameras[index] = scene.add(camera)

    def _order(self) -> list[int]:
        """Return the nodes of the scene in the order of the file."""
        document, tree = self.document, self.document.nodes
        number = document.tree.index("scene", document.count("scenes"))
        roots = tree.roots
        if document.count("scenes"):
            roots = document.entry("scenes", number or 0).indices("nodes", document.count("nodes"))
        # Joints move meshes also where they lie outside of the scene.
        joints = {joint for skin in document.all("skins") for joint in joints_of(document, skin)}
        shown = set(tree.below(roots))
        for joint in sorted(joints - shown):
            while tree.parents[joint] >= 0:
                joint = tree.parents[joint]
            roots = [*roots, joint]
        found = sorted(tree.below(roots))
        self.limits.nodes(len(found), document.tree)
        return found

    def _used_materials(self, nodes: Any) -> list[Entry]:
        """Return the materials of the meshes that nodes show, those of variants included."""
        document = self.document
        used: set[int] = set()
        for node in nodes:
            mesh = node.index("mesh", document.count("meshes"))
            if mesh is None:
                continue
            entry = document.entry("meshes", mesh)
            for number in range(len(entry.entries("primitives"))):
                primitive = entry.member("primitives", number)
                index = primitive.index("material", document.count("materials"))
                if index is not None:
                    used.add(index)
                used |= set(variant_materials(document, primitive, len(self.variants)).values())
        return [document.entry("materials", index) for index in sorted(used)]

    def _show(self, scene: Scene, index: int, entry: Entry) -> None:
        """Show the mesh of a node: on itself, or on nodes below it if it has several primitives or instances."""
        mesh = entry.index("mesh", self.document.count("meshes"))
        if mesh is None:
            return
        node = self.parts.nodes[index]
        primitives = self.meshes.get(mesh)
        name = self.document.entry("meshes", mesh).text("name") or node.name
        holders = [node]
        # The joints alone place a skinned mesh (section 3.7.3.1), so that instances have no meaning.
        if entry.extension(INSTANCING) is not None and "skin" not in entry:
            matrices = instances(self.document, entry, self.limits)
            self.limits.nodes(len(matrices) * (1 + len(primitives)), entry)
            with at(entry):
                holders = [
                    _add(scene, matrix, name=f"{name}.{number}", parent=node)
                    for number, matrix in enumerate(matrices)
                ]
        self.limits.nodes(len(holders) * len(primitives), entry)
        self.parts.shown[index] = [
            self._shown(scene, holder, primitive, name, number if len(primitives) > 1 else None)
            for holder in holders
            for number, primitive in enumerate(primitives)
        ]

    def _shown(
        self, scene: Scene, holder: Node, primitive: Primitive, name: str, number: int | None
    ) -> Node:
        index = primitive.entry.index("material", self.document.count("materials"))
        material = self.materials.get(index, flat=primitive.flat)
        if number is not None:
            holder = scene.add(primitive.mesh, material, name=f"{name}.{number}", parent=holder)
        else:
            holder.mesh = primitive.mesh
            holder.material = material
        found = variant_materials(self.document, primitive.entry, len(self.variants))
        if found:
            holder.variants = {
                self.variants[variant]: self.materials.get(other, flat=primitive.flat)
                for variant, other in found.items()
            }
        return holder


def _placed(scene: Scene, entry: Entry, visible: bool) -> Node:
    """Make the node of an entry, without its parent."""
    name = entry.text("name") or ""
    matrix = entry.numbers("matrix", 16)
    if matrix is not None:
        columns = np.array(matrix).reshape(4, 4)
        columns[:, 3] = (0, 0, 0, 1)
        return _add(scene, columns.T, name=name, visible=visible)
    x, y, z, w = entry.numbers("rotation", 4) or (0.0, 0.0, 0.0, 1.0)
    return scene.add(
        position=entry.numbers("translation", 3),
        rotation=(w, x, y, z),
        scale=[s if s else _SMALLEST for s in entry.numbers("scale", 3) or (1.0, 1.0, 1.0)],
        name=name,
        visible=visible,
    )


def _add(scene: Scene, matrix: Any, **options: Any) -> Node:
    """Add a group with a matrix; one that has no inverse gets one that is close to it."""
    try:
        return scene.add(matrix=matrix, **options)
    except ValueError:
        if not np.isfinite(matrix).all():
            raise
        u, sizes, v = np.linalg.svd(matrix[:3, :3])
        changed = np.array(matrix)
        changed[:3, :3] = u @ np.diag(np.maximum(sizes, _SMALLEST)) @ v
        return scene.add(matrix=changed, **options)
