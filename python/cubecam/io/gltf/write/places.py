"""Lights and cameras: each shines or looks along -Z of a node (KHR_lights_punctual, section 3.10 of glTF 2.0).

A light or camera that lies at the origin of its parent and along its -Z belongs to that node. Any other one gets a
node of its own, a carrier, which is marked in its extras: loading gives the same object back, without the carrier.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ...._core import (
    AmbientLight,
    Camera,
    DirectionalLight,
    Light,
    Node,
    OrthographicCamera,
    PerspectiveCamera,
    PointLight,
    SpotLight,
)
from ..extras.classes import KEY, PLANS
from .document import Array, Document, Json
from .values import Values, number, numbers, same

_LIGHTS = "KHR_lights_punctual"
#: The least penumbra that glTF can say, where the inner angle is less than the outer one.
_SHARPEST = 1e-6
_FORWARD = np.array([0.0, 0.0, -1.0])


class Places:
    """The nodes of a document that hold lights and cameras."""

    def __init__(self, document: Document, nodes: dict[Node, int]) -> None:
        self._document = document
        self._nodes = nodes
        #: The node of each light and camera, by `id`.
        self.holders: dict[int, int] = {}
        self._kept: list[Any] = []
        self._carried: list[tuple[Any, int]] = []

    def hold(self, thing: Any, word: str) -> None:
        """Find a node for a light or a camera: its parent if it lies there as glTF has it, else a carrier."""
        parent = _parent_of(thing)
        above = None if parent is None else self._nodes.get(parent)
        if parent is not None and above is None:
            raise ValueError(
                f"{word}: expected a parent that is a node of the scene, got {parent!r}, which is not"
            )
        if above is not None and _is_plain(thing) and not self._holds(above, word):
            index = above
        else:
            index = self._document.add("nodes", self._carrier(thing))
            self._carried.append((thing, index))
            if above is not None:
                self._document.lists["nodes"][above].setdefault("children", []).append(index)
        self.holders[id(thing)] = index
        self._kept.append(thing)  # no other object may get its id
        entry = self._document.lists["nodes"][index]
        if word == "camera":
            entry["camera"] = self._document.add("cameras", _camera_entry(thing))
        else:
            content = self._document.extensions.setdefault(_LIGHTS, {"lights": []})
            content["lights"].append(_light_entry(thing))
            self._document.extend(entry, _LIGHTS, {"light": len(content["lights"]) - 1})

    def _holds(self, index: int, word: str) -> bool:
        entry = self._document.lists["nodes"][index]
        return "camera" in entry if word == "camera" else _LIGHTS in entry.get("extensions", {})

    @staticmethod
    def _carrier(thing: Any) -> Json:
        """Return the entry of a node of its own, which lies as the light or the camera does."""
        entry: Json = {}
        position = np.asarray(getattr(thing, "position", np.zeros(3)))
        if position.any():
            entry["translation"] = position.tolist()
        if isinstance(thing, Camera):
            turned = _look(thing)
        else:
            turned = turn_to(np.asarray(getattr(thing, "direction", _FORWARD)))
        if not np.array_equal(turned, (0, 0, 0, 1)):
            entry["rotation"] = turned.tolist()
        return entry

    def finish(self, things: Any, word: str, values: Values) -> None:
        """Write what glTF cannot say of lights or cameras into the extras of their nodes."""
        for thing in things:
            index = self.holders.get(id(thing))
            if index is None:
                continue
            carried = any(thing is other for other, _ in self._carried)
            extras = _extras(thing, carried, values)
            if extras or carried:
                entry = self._document.lists["nodes"][index]
                own = entry.setdefault("extras", {}).setdefault(KEY, {})
                own[word] = extras
                if carried:
                    own["carrier"] = True

    def roots(self) -> list[int]:
        """Return the carriers that have no node above them."""
        return [index for thing, index in self._carried if _parent_of(thing) is None]


def is_placed(camera: Camera) -> bool:
    """Say whether glTF has such a camera; one given by its matrices stands in extras alone."""
    return isinstance(camera, (PerspectiveCamera, OrthographicCamera))


def is_punctual(light: Light) -> bool:
    """Say whether glTF has such a light; an ambient light stands in extras alone."""
    return not isinstance(light, AmbientLight)


def _parent_of(thing: Any) -> Node | None:
    found: Node | None = getattr(thing, "parent", None)
    return found


def _is_plain(thing: Any) -> bool:
    """Say whether a light or a camera lies at the origin of its node and looks along -Z."""
    if np.asarray(getattr(thing, "position", np.zeros(3))).any():
        return False
    if isinstance(thing, Camera):
        return thing.target is None and np.array_equal(thing.up, (0, 1, 0))  # type: ignore[attr-defined]
    return np.array_equal(getattr(thing, "direction", _FORWARD), _FORWARD)


def _light_entry(light: Any) -> Json:
    color, strength = np.asarray(light.color), float(light.intensity)
    greatest = float(color.max(initial=0))
    if greatest > 1:  # a colour is at most 1
        color, strength = np.minimum(color / greatest, 1).astype(np.float32), strength * greatest
    entry: Json = {"type": _TYPES[_kind(light)]}
    if (color != 1).any():
        entry["color"] = numbers(color)
    if strength != 1:
        entry["intensity"] = number(strength)
    if math.isfinite(getattr(light, "range", math.inf)):
        entry["range"] = light.range
    if isinstance(light, SpotLight):
        outer = math.radians(light.angle)
        # The inner angle is less than the outer one (KHR_lights_punctual, "Spot").
        inner = outer * (1 - max(light.penumbra, _SHARPEST))
        entry["spot"] = {"innerConeAngle": inner, "outerConeAngle": outer}
    return entry


_TYPES = {PointLight: "point", SpotLight: "spot", DirectionalLight: "directional"}


def _kind(thing: Any) -> type[Any]:
    return next(k for k in type(thing).__mro__ if k.__name__ in PLANS)


def _camera_entry(camera: Any) -> Json:
    near = max(float(camera.near), 0.0)
    if isinstance(camera, PerspectiveCamera):
        lens: Json = {"yfov": math.radians(camera.fov), "znear": camera.near, "zfar": camera.far}
        return {"type": "perspective", "perspective": lens}
    half = camera.height / 2
    far = max(camera.far, near + max(camera.far - camera.near, 1e-3))
    lens = {"xmag": half, "ymag": half, "znear": near, "zfar": far}
    return {"type": "orthographic", "orthographic": lens}


def _extras(thing: Any, carried: bool, values: Values) -> Json:
    """Return the properties that the entry does not give, or not exactly."""
    kind = _kind(thing)
    names = [n for n in PLANS[kind.__name__].made if hasattr(thing, n)]
    if carried:
        placed = [n for n in ("position", "direction", "target", "up") if n in names]
        found = values.properties(thing, placed)
    else:
        found = {}
    if isinstance(thing, Camera):
        found |= values.changed(thing, kind(), [n for n in ("shift", "pixel_aspect") if n in names])
        if isinstance(thing, OrthographicCamera) and thing.near < 0:
            found |= values.properties(thing, ("near", "far"))
        return found
    if getattr(thing, "decay", 2) != 2:
        found["decay"] = values.value(thing.decay)
    if getattr(thing, "penumbra", 1) < _SHARPEST:
        found["penumbra"] = thing.penumbra
    if np.asarray(thing.color).max(initial=0) > 1:
        found |= values.properties(thing, ("color", "intensity"))
    if not same(thing.shadow, None):
        found["shadow"] = values.value(thing.shadow)
    return found


def turn_to(direction: Array) -> Array:
    """Return the shortest turn of -Z to a direction, as a quaternion (x, y, z, w)."""
    direction = direction / np.linalg.norm(direction)
    half = _FORWARD + direction
    if np.linalg.norm(half) < 1e-9:
        return np.array([0.0, 1.0, 0.0, 0.0])
    half /= np.linalg.norm(half)
    return np.array([*np.cross(_FORWARD, half), _FORWARD @ half])


def _look(camera: Any) -> Array:
    """Return the turn of a camera that looks from its position at its target, as a quaternion (x, y, z, w)."""
    if camera.target is None:
        back = np.array([0.0, 0.0, 1.0])
    else:
        back = np.asarray(camera.position) - np.asarray(camera.target)
        back = back / np.linalg.norm(back)
    right = np.cross(camera.up, back)
    right = right / np.linalg.norm(right)
    return quaternion(np.stack([right, np.cross(back, right), back], axis=1))


def quaternion(turn: Array) -> Array:
    """Return a rotation matrix as a quaternion (x, y, z, w): the eigenvector of I. Bar-Itzhack, JGCD 23(6), 2000."""
    (a, b, c), (d, e, f), (g, h, i) = turn
    form = np.array(
        [
            [a - e - i, 0, 0, 0],
            [d + b, e - a - i, 0, 0],
            [g + c, h + f, i - a - e, 0],
            [h - f, c - g, d - b, a + e + i],
        ]
    )
    values, vectors = np.linalg.eigh(form / 3)
    found = vectors[:, np.argmax(values)]
    result: Array = found if found[3] >= 0 else -found
    return result
