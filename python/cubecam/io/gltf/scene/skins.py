"""Skins (section 3.7.3 of glTF 2.0), and what a mesh has for them and for morph targets."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...._core import MorphTarget, Node, Skin
from ..deformation import inverse_bind_matrices, joints_of
from ..document import Gltf
from ..entries import Entry
from ..limits import Limits
from ..primitives import Attributes, Floats, Surface, colors
from .values import at


class Skins:
    """The skins of a document, each made once."""

    def __init__(self, document: Gltf, nodes: Mapping[int, Node]) -> None:
        self._document = document
        self._nodes = nodes
        self._made: dict[int, Skin] = {}

    def get(self, index: int) -> Skin:
        if index not in self._made:
            self._made[index] = self._skin(self._document.entry("skins", index))
        return self._made[index]

    def _skin(self, entry: Entry) -> Skin:
        document = self._document
        numbers = joints_of(document, entry)
        bind = inverse_bind_matrices(document, entry, len(numbers))
        if bind is not None:
            bind = bind.copy()
            bind[:, 3] = (0, 0, 0, 1)  # programs write numbers close to these
        skeleton = entry.index("skeleton", document.count("nodes"))
        with at(entry):
            return Skin(
                [self._nodes[number] for number in numbers],
                bind,
                skeleton=None if skeleton is None else self._nodes.get(skeleton),
            )


def influences(surface: Surface) -> tuple[Any, Floats | None]:
    """Read all JOINTS_n and WEIGHTS_n of a primitive: (V, 4k) each, or None without any."""
    which: list[Any] = []
    weights: list[Floats] = []
    while f"JOINTS_{len(which)}" in surface.attributes:
        key = f"JOINTS_{len(which)}"
        joints = surface.attributes.read(key, "VEC4")
        if joints.dtype.kind != "u":
            raise surface.attributes.entry.error(key, "an accessor of unsigned integers")
        key = f"WEIGHTS_{len(which)}"
        if key not in surface.attributes:
            raise surface.attributes.entry.error(key, "the index of an accessor")
        which.append(joints)
        weights.append(np.asarray(surface.attributes.read(key, "VEC4"), np.float64))
    if not which:
        return None, None
    found = np.concatenate(weights, axis=1)
    return np.where(found > 0, np.concatenate(which, axis=1), 0), found


def morph_targets(
    document: Gltf, surface: Surface, names: list[str], sets: Mapping[int, int], limits: Limits
) -> list[MorphTarget]:
    """Read the morph targets of a primitive (section 3.7.2.2)."""
    found = []
    vertices = len(surface.positions)
    places = {place: number for number, place in sets.items()}
    for index in range(len(surface.entry.entries("targets"))):
        target = surface.entry.member("targets", index)
        limits.output(vertices * max(1, len(target.raw)), target)
        attributes = Attributes(document, target, vertices)
        uvs = [
            attributes.floats(f"TEXCOORD_{places[place]}", "VEC2") if place in places else None
            for place in (0, 1)
        ]
        arrays = {
            "positions": attributes.floats("POSITION", "VEC3"),
            "normals": attributes.floats("NORMAL", "VEC3"),
            "tangents": attributes.floats("TANGENT", "VEC3"),
            "uvs": None if uvs[0] is None else uvs[0] * (1, -1),  # v counts from the bottom here
            "uvs1": None if uvs[1] is None else uvs[1] * (1, -1),
            "colors": colors(attributes, alpha=0.0),
        }
        if all(values is None for values in arrays.values()):
            arrays["positions"] = np.zeros((vertices, 3))
        with at(target):
            name = names[index] if index < len(names) else ""
            found.append(MorphTarget(**arrays, name=name))
    return found
