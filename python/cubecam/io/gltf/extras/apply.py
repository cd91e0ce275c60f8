"""Sets what stands in `extras.cubecam` on the objects that the loader made."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .... import _core
from ...._core import Material, Mesh, MeshError, Node, Scene, ShaderMaterial
from ..document import Gltf
from ..entries import Entry
from .classes import MESH, NODE, PLANS, SCENE, arguments_of, material_names
from .values import Parts, Reader, made_of

_MESH_WORDS = ("same", *MESH, "joint_weights", "morph_targets")


class Application:
    """One scene that gets its extras."""

    def __init__(
        self,
        document: Gltf,
        reader: Reader,
        scene: Scene,
        parts: Parts,
        entry: Callable[[str, int], Entry | None],
    ) -> None:
        self._document = document
        self._reader = reader
        self._scene = scene
        self._parts = parts
        self._entry = entry

    def apply(self) -> None:
        """Set everything; carriers go last, since lights and cameras belong to them until then."""
        for index, meshes in self._parts.meshes.items():
            self._mesh(index, meshes)
        for index, material in self._parts.materials.items():
            self._material(index, material)
        for index, node in self._parts.nodes.items():
            self._node(index, node)
        for index, animation in enumerate(self._parts.animations):
            if animation is not None:
                self._animation(index, animation)
        self._scene_properties()
        self._reader.finish()
        for index in self._carriers():
            self._remove(self._parts.nodes[index])

    def _set(self, made: Any, entry: Entry, names: tuple[str, ...]) -> None:
        for name in names:
            if name in entry:
                where = entry.path(name)
                self._reader.set(made, name, self._reader.value(entry.raw[name], where), where)

    def _mesh(self, index: int, meshes: list[Any]) -> None:
        """Set arrays of a mesh, or show the same mesh as an earlier entry."""
        entry = self._entry("meshes", index)
        if entry is None or len(meshes) != 1:
            return
        self._reader.check_names(entry, _MESH_WORDS)
        if "same" in entry:
            other = entry.index("same", index)
            if other is None or len(self._parts.meshes.get(other, ())) != 1:
                # The other entry may be in no node that is left.
                return
            self._replace(meshes, self._parts.meshes[other][0])
            return
        if any(name in entry for name in ("joint_weights", "morph_targets")):
            self._replace(meshes, self._rebuilt(entry, meshes[0]))
        else:
            self._set(meshes[0], entry, MESH)

    def _rebuilt(self, entry: Entry, mesh: Any) -> Mesh:
        """Return a mesh with other arrays, some of which no setter changes."""
        arguments = dict(arguments_of(mesh))
        for name in entry.raw:
            arguments[name] = self._reader.value(entry.raw[name], entry.path(name))
        made: Mesh = made_of(Mesh, arguments, entry.where)
        return made

    def _replace(self, meshes: list[Any], mesh: Any) -> None:
        """Show a mesh where the loader's own one is."""
        old, meshes[0] = meshes[0], mesh
        if old is mesh:
            return
        for node in self._parts.nodes.values():
            if node.mesh is old:
                weights = getattr(node, "weights", None)
                node.mesh = mesh
                if weights is not None and len(weights):
                    node.weights = weights  # type: ignore[attr-defined]

    def _material(self, index: int, material: Material) -> None:
        entry = self._entry("materials", index)
        if entry is None:
            return
        kind: Any = type(material)
        names = material_names(kind)
        self._reader.check_names(entry, ("class", *names))
        if isinstance(material, ShaderMaterial):
            # A probe among the textures may lead back to the material.
            self._set(material, entry, tuple(n for n in names if n not in ("fragment", "name")))
        else:
            self._set(material, entry, tuple(n for n in names if n != "name"))

    def _node(self, index: int, node: Node) -> None:
        entry = self._entry("nodes", index)
        if entry is None:
            return
        self._reader.check_names(
            entry, (*NODE, "matrix", "material", "variants", "light", "camera", "carrier")
        )
        self._set(node, entry, (*NODE, "matrix", "material", "variants"))
        carried = entry.flag("carrier")
        for word, things in (("light", self._parts.lights), ("camera", self._parts.cameras)):
            thing = things.get(index)
            own = entry.entry(word)
            if own is None or thing is None:
                continue
            plan = PLANS[type(thing).__name__]
            self._reader.check_names(own, plan.made)
            if carried:
                thing.parent = node.parent
            self._placed(thing, own, plan.made)

    def _placed(self, thing: Any, entry: Entry, names: tuple[str, ...]) -> None:
        """Set properties of a light or a camera, together where one alone would be refused."""
        found = {n: self._reader.value(entry.raw[n], entry.path(n)) for n in names if n in entry}
        steps = _steps(thing, found) if isinstance(thing, _core.Camera) else found.items()
        for name, value in steps:
            self._reader.set(thing, name, value, entry.path(name))

    def _animation(self, index: int, animation: Any) -> None:
        """Add the channels that glTF does not have."""
        entry = self._entry("animations", index)
        if entry is None:
            return
        self._reader.check_names(entry, ("channels",))
        names = ("node", "path", "times", "values", "interpolation")
        channels = list(animation.channels)
        for place in range(len(entry.entries("channels"))):
            channel = entry.member("channels", place)
            self._reader.check_names(channel, names)
            given = {n: channel.raw.get(n) for n in names}
            values = {
                n: self._reader.value(v, channel.path(n)) for n, v in given.items() if n != "node"
            }
            values["node"] = self._reader.value({"node": given["node"]}, channel.path("node"))
            channels.append(made_of(_core.AnimationChannel, values, channel.where))  # type: ignore[attr-defined]
        made = made_of(
            _core.Animation,  # type: ignore[attr-defined]
            {"channels": channels, "name": animation.name},
            entry.where,
        )
        self._scene.remove(animation)
        self._scene.add(made)
        self._parts.animations[index] = made

    def _scene_properties(self) -> None:
        number = self._document.tree.index("scene", self._document.count("scenes"))
        if not self._document.count("scenes"):
            return
        entry = self._entry("scenes", number or 0)
        if entry is None:
            return
        self._reader.check_names(entry, (*SCENE, "lights", "cameras", "variant"))
        self._set(self._scene, entry, SCENE)
        for word, things in (("lights", self._parts.lights), ("cameras", self._parts.cameras)):
            if word in entry:
                self._order(entry, word, things)
        self._set(self._scene, entry, ("variant",))

    def _order(self, entry: Entry, word: str, things: dict[int, Any]) -> None:
        """Add lights or cameras in an order of their own, some of which are in extras alone."""
        found = []
        for place in range(len(entry.entries(word))):
            member = entry.member(word, place)
            if "node" in member:
                index = member.index("node", self._document.count("nodes"))
                if index in things:
                    found.append(things[index])
            else:
                thing = self._reader.value(member.raw, member.where)
                expected = _core.Light if word == "lights" else _core.Camera
                if not isinstance(thing, expected):
                    raise MeshError(
                        f"{member.where}: expected a {expected.__name__}, got {type(thing).__name__}"
                    )
                found.append(thing)
        for thing in getattr(self._scene, word):
            self._scene.remove(thing)
        for thing in found:
            self._scene.add(thing)

    def _carriers(self) -> list[int]:
        entries = ((index, self._entry("nodes", index)) for index in self._parts.nodes)
        return [index for index, entry in entries if entry is not None and entry.flag("carrier")]

    def _remove(self, carrier: Node) -> None:
        """Remove a node that is in the file only; what lies below it moves up."""
        for child in carrier.children:
            child.parent = carrier.parent
        self._scene.remove(carrier)


def _steps(camera: Any, found: dict[str, Any]) -> list[tuple[str, Any]]:
    """Return properties to set, in an order in which none is refused because of one that comes later."""
    steps: list[tuple[str, Any]] = []
    rest = dict(found)
    position, target, up = (
        rest.pop(name, getattr(camera, name)) for name in ("position", "target", "up")
    )
    if len(rest) < len(found):
        steps = [("target", None), ("up", (0, 1, 0)), ("position", position)]
        if target is not None:
            steps += [("up", _beside(position, target)), ("target", target)]
        steps.append(("up", up))
    # near is always less than far.
    names = sorted(rest, key=lambda name: name == "near")
    if "near" in rest and "far" in rest and _number(rest["near"]) < camera.near:
        names = sorted(rest, key=lambda name: name == "far")
    return steps + [(name, rest[name]) for name in names]


def _beside(position: Any, target: Any) -> tuple[float, ...]:
    """Return the axis of x or y that is less along a line of sight."""
    try:
        x, y, _ = np.abs(np.subtract(target, position))
    except (TypeError, ValueError):  # the setter of the target says so
        return (0, 1, 0)
    return (1, 0, 0) if x < y else (0, 1, 0)


def _number(value: Any) -> float:
    return float(value) if isinstance(value, (int, float)) else 0.0
