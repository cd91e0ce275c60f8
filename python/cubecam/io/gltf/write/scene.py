"""A whole scene as a glTF document: nodes first, since everything else refers to them."""

from __future__ import annotations

from typing import Any

import numpy as np

from ...._core import Image, Material, Node, Scene
from ..extras.classes import FORMAT, KEY, NODE, SCENE, state_of
from .document import Array, Document, Json
from .materials import Materials
from .meshes import Meshes, Shown
from .motion import Skins, add_animation
from .pictures import Pictures
from .places import Places, is_placed, is_punctual, quaternion
from .values import Values, numbers

_VISIBILITY = "KHR_node_visibility"
_VARIANTS = "KHR_materials_variants"
#: How far the axes of a matrix may be from right angles for glTF (section 3.5.2).
_SQUARE = 1e-6


def document_of(scene: Scene) -> Document:
    """Return the glTF document of a scene.

    Raises
    ------
    ValueError
        For what a file cannot hold: a texture that shows another scene, a skin whose joints are not in the scene.
    """
    return _Writer(scene).document


class _Writer:
    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        self.document = Document()
        self.nodes = {node: index for index, node in enumerate(scene.nodes)}
        self.pictures = Pictures(self.document)
        self.materials = Materials(self.document, self.pictures)
        self.values = Values(
            self.document,
            {
                Node: self._node_reference,
                Material: lambda m: {"material": self.materials.index(m)},
                Image: lambda i: {"texture": self.pictures.texture(i)},
                Scene: self._scene_reference,
            },
        )
        self.variants = {name: i for i, name in enumerate(scene.variants)}
        self.meshes = Meshes(self.document, self.materials, self.values, self.variants)
        self.skins = Skins(self.document, self.nodes)
        self.places = Places(self.document, self.nodes)
        self._write()

    def _write(self) -> None:
        scene, document = self.scene, self.document
        cameras = list(scene.cameras)
        animations = list(scene.animations)
        document.lists["scenes"] = [{}]
        states = {record[0]: record[2] for record in state_of(scene)["nodes"]}
        moved = {c.node for a in animations for c in a.channels if c.node is not None}
        for node in scene.nodes:
            document.add("nodes", self._place(node, states[node.id], node in moved))
        for node in scene.nodes:
            parent = node.parent
            if parent is not None:
                above = document.lists["nodes"][self.nodes[parent]]
                above.setdefault("children", []).append(self.nodes[node])
        for light in scene.lights:
            if is_punctual(light):
                self.places.hold(light, "light")
        for camera in cameras:
            if is_placed(camera):
                self.places.hold(camera, "camera")
                self.values.know_camera(camera, self.places.holders[id(camera)])
        for node in scene.nodes:
            self._show(node, document.lists["nodes"][self.nodes[node]])
        if self.variants:
            names = [{"name": name} for name in self.variants]
            document.extensions[_VARIANTS] = {"variants": names}
            document.used.add(_VARIANTS)
        motions = [add_animation(document, self.nodes, a, self.values) for a in animations]
        self.places.finish(scene.lights, "light", self.values)
        self.places.finish(cameras, "camera", self.values)
        for node in scene.nodes:
            self._add_extras(node, document.lists["nodes"][self.nodes[node]], states[node.id])
        extras = self._scene_extras(cameras)
        if any(m is not None and "animation" not in m for m in motions):
            extras["animations"] = [m for m in motions if m is not None]
        self.materials.finish(self.values)
        self.pictures.finish(self.values)
        if extras:
            document.lists["scenes"][0]["extras"] = {KEY: extras}
        self._root()

    def _root(self) -> None:
        """Write the roots of the scene, and what stands in the extras of the root."""
        document = self.document
        roots = [self.nodes[n] for n in self.scene.nodes if n.parent is None]
        roots += self.places.roots()
        for tops in self._groups():
            carrier = {"children": tops, "extras": {KEY: {"carrier": True}}}
            roots = [i for i in roots if i not in tops] + [document.add("nodes", carrier)]
        if roots:
            document.lists["scenes"][0]["nodes"] = roots
        document.lists = {kind: entries for kind, entries in document.lists.items() if entries}
        found: Json = {"objects": self.values.objects} if self.values.objects else {}
        if found or _mentions(document.lists):
            document.extras[KEY] = {"format": FORMAT, **found}

    def _groups(self) -> list[list[int]]:
        """Return the roots that need a carrier above them, as the joints of a skin have one root (section 3.7.3)."""
        groups: list[set[int]] = []
        for skin in self.skins.all:
            tops = set()
            for joint in skin.joints:
                node = joint
                while node is not None and node.parent is not None:
                    node = node.parent
                if node is not None:
                    tops.add(self.nodes[node])
            # A root may belong to several skins.
            for group in [g for g in groups if g & tops]:
                tops |= group
                groups.remove(group)
            groups.append(tops)
        return [sorted(group) for group in groups if len(group) > 1]

    def _place(self, node: Node, state: Any, moved: bool) -> Json:
        """Return the entry of a node with its name and its place."""
        entry: Json = {"name": node.name} if node.name else {}
        matrix = state[5]
        if matrix is None:
            _add_parts(entry, state[2], state[3][[1, 2, 3, 0]], state[4])
            return entry
        position, turn, scale, square = parts_of(matrix)
        if square and not moved:
            entry["matrix"] = matrix.T.reshape(-1).tolist()
        else:
            _add_parts(entry, position, turn, scale)
        return entry

    def _show(self, node: Node, entry: Json) -> None:
        """Give the entry of a node its mesh, its skin and its weights."""
        if not node.visible:
            self.document.extend(entry, _VISIBILITY, {"visible": False})
        if node.mesh is None:
            return
        variants = node.variants
        material = node.own_material
        assert material is not None
        pairs = tuple((name, variants[name]) for name in self.variants if name in variants)
        entry["mesh"] = self.meshes.index(Shown(node.mesh, material, pairs))
        if node.skin is not None and node.mesh.joints is not None:
            entry["skin"] = self.skins.index(node.skin)
        if np.any(node.weights):
            entry["weights"] = numbers(np.asarray(node.weights))

    def _add_extras(self, node: Node, entry: Json, state: Any) -> None:
        """Write what glTF cannot say of a node."""
        plain = _PLAIN.nodes[0]
        extras = self.values.changed(node, plain, NODE)
        matrix = state[5]
        if matrix is not None and not parts_of(matrix)[3]:
            extras["matrix"] = self.values.array(matrix)
        if node.mesh is None:
            if node.own_material is not None:
                extras["material"] = self.values.value(node.own_material)
            if node.variants:
                extras["variants"] = self.values.value(node.variants)
        if extras:
            own = entry.setdefault("extras", {}).setdefault(KEY, {})
            own.update(extras)

    def _scene_extras(self, cameras: list[Any]) -> Json:
        extras = self.values.changed(self.scene, _PLAIN, SCENE)
        for word, things in (("lights", list(self.scene.lights)), ("cameras", cameras)):
            held = [self.places.holders.get(id(thing)) for thing in things]
            # The usual order is that of the nodes.
            if None in held or held != sorted(held):  # type: ignore[type-var]
                extras[word] = [
                    {"node": index}
                    if index is not None
                    else self.values.inline(thing)
                    if word == "lights"
                    else self.values.value(thing)
                    for index, thing in zip(held, things, strict=True)
                ]
        if self.scene.variant is not None:
            extras["variant"] = self.scene.variant
        return extras

    def _node_reference(self, node: Node) -> Json:
        return {"node": self.nodes.get(node)}

    def _scene_reference(self, scene: Scene) -> Json:
        if scene is not self.scene:
            raise ValueError(
                "expected a scene whose render textures show the scene itself, got one that shows another scene: "
                "a glTF file holds one scene"
            )
        return {"scene": 0}


def _mentions(lists: dict[str, list[Json]]) -> bool:
    """Say whether any entry has extras of cubecam."""
    return any(KEY in entry.get("extras", {}) for entries in lists.values() for entry in entries)


def _add_parts(entry: Json, position: Any, turn: Any, scale: Any) -> None:
    """Give an entry those of translation, rotation (x, y, z, w) and scale that change something."""
    for word, values, plain in (
        ("translation", position, (0, 0, 0)),
        ("rotation", turn, (0, 0, 0, 1)),
        ("scale", scale, (1, 1, 1)),
    ):
        if not np.array_equal(values, plain):
            entry[word] = np.asarray(values).tolist()


def parts_of(matrix: Array) -> tuple[Array, Array, Array, bool]:
    """Split a matrix into translation, rotation (x, y, z, w) and scale, and say whether these are all of it."""
    linear = matrix[:3, :3]
    scale = np.linalg.norm(linear, axis=0)
    turn = linear / scale
    if np.linalg.det(turn) < 0:
        scale = scale * (-1, 1, 1)
        turn = turn * (-1, 1, 1)
    square = bool((np.abs(turn.T @ turn - np.eye(3)) < _SQUARE).all())
    if not square:
        left, _, right = np.linalg.svd(turn)
        turn = left @ right  # the rotation nearest to it
    return matrix[:3, 3], quaternion(turn), scale, square


_PLAIN = Scene()
_PLAIN.add()
