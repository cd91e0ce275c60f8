"""Sets what stands in `extras.cubecam` on the objects that the loader made."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from .... import _core
from ...._core import (
    Animation,
    AnimationChannel,
    Material,
    MeshError,
    Node,
    Scene,
    ShaderMaterial,
    Skin,
)
from ..document import Gltf
from ..entries import Entry
from .classes import MESH, NODE, PLANS, SCENE, material_names
from .values import Parts, Reader, made_of

_MESH_WORDS = ("same", *MESH, "joints", "joint_weights", "morph_targets")


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
        self._skins()
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
        self._set(meshes[0], entry, (*MESH, "morph_targets"))
        bones = {
            name: self._reader.value(entry.raw[name], entry.path(name))
            for name in ("joints", "joint_weights")
            if name in entry
        }
        if bones:
            try:
                meshes[0].update(**bones)
            except (TypeError, ValueError, IndexError, OverflowError) as error:
                raise MeshError(f"{entry.path('joints')}: {error}") from None

    def _replace(self, meshes: list[Any], mesh: Any) -> None:
        """Show a mesh where the loader's own one is."""
        old, meshes[0] = meshes[0], mesh
        if old is mesh:
            return
        for node in self._parts.nodes.values():
            if node.mesh is old:
                weights = node.weights
                node.mesh = mesh
                if len(weights):
                    node.weights = weights

    def _skins(self) -> None:
        """Give skins a skeleton that is no root of all their joints."""
        made: dict[int, Skin] = {}
        for index, node in self._parts.nodes.items():
            number = self._document.entry("nodes", index).index(
                "skin", self._document.count("skins")
            )
            entry = None if number is None else self._entry("skins", number)
            if number is None or entry is None or node.skin is None:
                continue
            self._reader.check_names(entry, ("skeleton",))
            if number not in made:
                skeleton = self._reader.value(entry.raw.get("skeleton"), entry.path("skeleton"))
                made[number] = made_of(
                    Skin,
                    {
                        "joints": node.skin.joints,
                        "inverse_bind_matrices": node.skin.inverse_bind_matrices,
                        "skeleton": skeleton,
                    },
                    entry.where,
                )
            self._reader.set(node, "skin", made[number], entry.where)

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

    def _animation(self, index: int, animation: Animation) -> None:
        """Add the channels that glTF does not have."""
        entry = self._entry("animations", index)
        if entry is None:
            return
        self._reader.check_names(entry, ("channels",))
        made = self._with_channels(entry, animation.name, list(animation.channels))
        # In its place among the others.
        others = list(self._scene.animations)
        for other in others:
            self._scene.remove(other)
        for other in others:
            self._scene.add(made if other is animation else other)
        self._parts.animations[index] = made

    def _with_channels(
        self, entry: Entry, name: str, channels: list[AnimationChannel]
    ) -> Animation:
        """Make an animation of channels, and of those that stand in an entry."""
        names = ("node", "path", "times", "values", "interpolation")
        for number in range(len(entry.entries("channels"))):
            channel = entry.member("channels", number)
            self._reader.check_names(channel, ("place", *names))
            place = channel.integer("place")
            node = self._reader.value({"node": channel.raw.get("node")}, channel.path("node"))
            rest = {n: self._reader.value(channel.raw.get(n), channel.path(n)) for n in names[1:]}
            made = made_of(AnimationChannel, {"node": node, **rest}, channel.where)
            channels.insert(place, made)
        result: Animation = made_of(Animation, {"channels": channels, "name": name}, entry.where)
        return result

    def _order_animations(self, entry: Entry) -> None:
        """Add animations of which some stand in extras alone."""
        found = []
        for place in range(len(entry.entries("animations"))):
            member = entry.member("animations", place)
            if "animation" in member:
                index = member.index("animation", len(self._parts.animations))
                if index is not None and self._parts.animations[index] is not None:
                    found.append(self._parts.animations[index])
            else:
                self._reader.check_names(member, ("name", "channels"))
                found.append(self._with_channels(member, member.text("name") or "", []))
        for animation in self._scene.animations:
            self._scene.remove(animation)
        for animation in found:
            try:
                self._scene.add(animation)
            except ValueError as error:
                raise MeshError(f"{entry.path('animations')}: {error}") from None

    def _scene_properties(self) -> None:
        number = self._document.tree.index("scene", self._document.count("scenes"))
        if not self._document.count("scenes"):
            return
        entry = self._entry("scenes", number or 0)
        if entry is None:
            return
        self._reader.check_names(entry, (*SCENE, "lights", "cameras", "animations", "variant"))
        self._set(self._scene, entry, SCENE)
        for word, things in (("lights", self._parts.lights), ("cameras", self._parts.cameras)):
            if word in entry:
                self._order(entry, word, things)
        if "animations" in entry:
            self._order_animations(entry)
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
