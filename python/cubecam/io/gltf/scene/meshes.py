"""Meshes of a scene: each primitive of triangles becomes one Mesh (section 3.7.2 of glTF 2.0)."""

from __future__ import annotations

import json
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...._core import Mesh
from ...left_out import LeftOut
from ..document import Gltf
from ..entries import Entry
from ..geometry import Geometry
from ..limits import Limits
from ..primitives import MODES, Floats, Surface, from_bottom
from .skins import influences, morph_targets
from .values import at


@dataclass
class Primitive:
    """A primitive of triangles: its mesh, its entry, whether the file has no normals for it."""

    mesh: Mesh
    entry: Entry
    flat: bool


class Meshes:
    """The meshes of a document. Two primitives that show the same data are one Mesh, whatever their materials are."""

    def __init__(
        self, document: Gltf, sets: dict[int, int], limits: Limits, left_out: LeftOut
    ) -> None:
        self._document = document
        self._sets = sets
        self._geometry = Geometry(document, limits)
        self._limits = limits
        self._left_out = left_out
        self._made: dict[str, tuple[Mesh, bool] | None] = {}
        self.primitives: dict[int, list[Primitive]] = {}

    def get(self, index: int) -> list[Primitive]:
        """Return the primitives of a mesh that have triangles."""
        if index not in self.primitives:
            entry = self._document.entry("meshes", index)
            found = []
            for number in range(len(entry.entries("primitives"))):
                primitive = entry.member("primitives", number)
                made = self._primitive(entry, primitive)
                if made is not None:
                    found.append(Primitive(made[0], primitive, made[1]))
            self.primitives[index] = found
        return self.primitives[index]

    def _primitive(self, mesh: Entry, primitive: Entry) -> tuple[Mesh, bool] | None:
        mode = primitive.integer("mode", 4)
        if mode < 4:
            self._left_out.add(f"{MODES[mode]} are left out", primitive.where)
            return None
        data = {key: primitive.raw.get(key) for key in ("attributes", "indices", "targets")}
        extensions = primitive.raw.get("extensions", {})
        if isinstance(extensions, dict):
            data["draco"] = extensions.get("KHR_draco_mesh_compression")
        names = target_names(mesh) if data["targets"] else []
        key = json.dumps([data, mode, names], sort_keys=True)
        if key not in self._made:
            self._made[key] = self._mesh(mesh, primitive)
        return self._made[key]

    def _mesh(self, mesh: Entry, primitive: Entry) -> tuple[Mesh, bool] | None:
        surface = self._geometry.surface(primitive)
        if surface is None:
            self._left_out.add("primitives without triangles are left out", primitive.where)
            return None
        joints, joint_weights = influences(surface)
        targets = morph_targets(
            self._document, surface, target_names(mesh), self._sets, self._limits
        )
        with at(primitive):
            made = Mesh(
                surface.positions,
                surface.faces,
                normals=_finite(surface.normals),
                uvs=self._uvs(surface, 0),
                colors=_finite(surface.colors),
                uvs1=self._uvs(surface, 1),
                tangents=surface.tangents,
                joints=joints,
                joint_weights=joint_weights,
                morph_targets=targets,
            )
        return made, surface.normals is None

    def _uvs(self, surface: Surface, place: int) -> Floats | None:
        """Return the texture coordinates that become the first or the second ones, with v from the bottom."""
        for number, where in self._sets.items():
            if where == place:
                uvs = _finite(surface.attributes.floats(f"TEXCOORD_{number}", "VEC2"))
                return None if uvs is None else from_bottom(uvs)
        return None


def target_names(mesh: Entry) -> list[str]:
    """Return the names of morph targets, which stand in `extras` by a custom that all programs follow."""
    extras = mesh.raw.get("extras")
    names = extras.get("targetNames") if isinstance(extras, dict) else None
    if not isinstance(names, list):
        return []
    return [name if isinstance(name, str) else "" for name in names]


def _finite(values: Any) -> Any:
    """Put 0 where a number of a file is none: a normal of length 0 is computed."""
    if values is None or np.isfinite(values).all():
        return values
    return np.nan_to_num(values, nan=0.0, posinf=0.0, neginf=0.0)
