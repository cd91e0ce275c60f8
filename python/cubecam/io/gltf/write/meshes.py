"""Meshes: one primitive each (section 3.7.2 of glTF 2.0). The arrays of a mesh are stored once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...._core import Material, Mesh
from ..extras.classes import KEY, arguments_of
from .document import TRIANGLES, VERTICES, Array, Document, Json
from .materials import Materials
from .values import Values

_VARIANTS = "KHR_materials_variants"
#: The attributes of a morph target, and the properties of MorphTarget.
_DIFFERENCES = {
    "POSITION": "positions",
    "NORMAL": "normals",
    "TANGENT": "tangents",
    "TEXCOORD_0": "uvs",
    "TEXCOORD_1": "uvs1",
    "COLOR_0": "colors",
}
#: How far the length of a normal may be from 1.
_UNIT = 1e-4
#: How far the sum of the weights of joints may be from 1, for each weight above 0 (section 3.7.3.3).
_WEIGHT = 2e-7


@dataclass(frozen=True)
class Shown:
    """What a node shows: a mesh, its material, and the materials of variants."""

    mesh: Mesh
    material: Material
    variants: tuple[tuple[str, Material], ...] = ()


class Meshes:
    """The meshes of a document: an entry for each mesh with the materials in which it is shown."""

    def __init__(
        self, document: Document, materials: Materials, values: Values, variants: Mapping[str, int]
    ) -> None:
        self._document = document
        self._materials = materials
        self._values = values
        self._variants = variants
        self._known: dict[tuple[int, ...], tuple[Shown, int]] = {}
        self._first: dict[int, int] = {}
        self._indices: dict[int, int] = {}

    def index(self, shown: Shown) -> int:
        """Return the index of the entry for a mesh in its materials."""
        key = [id(shown.mesh), id(shown.material)]
        for name, material in shown.variants:
            key += [self._variants[name], id(material)]
        if tuple(key) not in self._known:
            self._known[tuple(key)] = (shown, self._add(shown))
        return self._known[tuple(key)][1]

    def _add(self, shown: Shown) -> int:
        mesh, materials = shown.mesh, [shown.material, *(m for _, m in shown.variants)]
        uv_sets = set().union(*(self._materials.uv_sets(m) for m in materials))
        colors = all(self._materials.shows_colors(m) for m in materials)
        attributes, exact = self._attributes(mesh, uv_sets, colors)
        primitive: Json = {
            "attributes": attributes,
            "indices": self._triangles(mesh),
            "material": self._materials.index(shown.material),
        }
        entry: Json = {"primitives": [primitive]}
        extras: Json = {}
        targets = mesh.morph_targets
        if targets:
            primitive["targets"] = [self._target(target, attributes) for target in targets]
            if any(
                self._is_lacking(t, made)
                for t, made in zip(targets, primitive["targets"], strict=True)
            ):
                exact["morph_targets"] = self._values.value(targets)
            entry["weights"] = [0.0] * len(targets)
            if any(target.name for target in targets):
                extras["targetNames"] = [target.name for target in targets]
        self._add_variants(primitive, shown)
        index = self._document.add("meshes", entry)
        first = self._first.setdefault(id(mesh), index)
        if first != index:
            extras[KEY] = {"same": first}
        elif exact:
            extras[KEY] = exact
        if extras:
            entry["extras"] = extras
        return index

    def _add_variants(self, primitive: Json, shown: Shown) -> None:
        """Name the material of each variant; variants with the same material stand together."""
        mappings: dict[int, list[int]] = {}
        for name, material in shown.variants:
            mappings.setdefault(self._materials.index(material), []).append(self._variants[name])
        if mappings:
            content = [{"material": m, "variants": v} for m, v in mappings.items()]
            self._document.extend(primitive, _VARIANTS, {"mappings": content})

    def _attributes(self, mesh: Mesh, uv_sets: set[int], colors: bool) -> tuple[Json, Json]:
        """Return the attributes of a mesh, and what has to be said besides, for `extras`."""
        exact: Json = {}
        found: dict[str, Array] = {}
        positions = mesh.positions
        if arguments_of(mesh)["normals"] is None:  # smooth ones, which follow the positions
            exact["normals"] = None
        found["NORMAL"] = _unit(mesh.normals)
        if exact.get("normals", 0) is not None and not np.array_equal(
            found["NORMAL"], mesh.normals
        ):
            exact["normals"] = self._values.array(mesh.normals)
        if mesh.tangents is not None:
            lengths = np.linalg.norm(mesh.tangents[:, :3], axis=1)
            if (np.abs(lengths - 1) < _UNIT).all():
                found["TANGENT"] = mesh.tangents
            else:
                exact["tangents"] = self._values.array(mesh.tangents)
        sets = [mesh.uvs, mesh.uvs1]
        # A material that looks up uvs sees (0, 0) everywhere in a mesh without, and the sets have no gaps.
        most = max([-1, *uv_sets, *(n for n, uvs in enumerate(sets) if uvs is not None)])
        for number in range(most + 1):
            uvs = sets[number]
            if uvs is None:
                exact["uvs1" if number else "uvs"] = None
                uvs = np.zeros((len(positions), 2), np.float32)
            found[f"TEXCOORD_{number}"] = _from_top(uvs)
        if mesh.colors is not None:
            clipped = np.clip(mesh.colors, 0, 1)
            if colors:
                found["COLOR_0"] = clipped
            if not colors or not np.array_equal(clipped, mesh.colors):
                exact["colors"] = self._values.array(mesh.colors)
        found |= self._bones(mesh, exact)
        add = self._document.accessor
        # Readers take primitives of the same accessors for one mesh, which two equal meshes are not.
        attributes = {"POSITION": add(positions, target=VERTICES, bounds=True, owner=id(mesh))}
        for key, array in found.items():
            attributes[key] = add(array, target=VERTICES)
        return attributes, exact

    def _bones(self, mesh: Mesh, exact: Json) -> dict[str, Array]:
        """Return JOINTS_n and WEIGHTS_n (section 3.7.3.3)."""
        found: dict[str, Array] = {}
        if mesh.joints is None or mesh.joint_weights is None:
            return found
        joints, weights = _influences(mesh.joints, mesh.joint_weights)
        own = np.array_equal(joints, mesh.joints) and np.array_equal(weights, mesh.joint_weights)
        if not own:
            exact["joints"] = self._values.array(np.asarray(mesh.joints, np.uint16))
            exact["joint_weights"] = self._values.array(np.asarray(mesh.joint_weights))
        kind = np.uint8 if joints.max(initial=0) < 256 else np.uint16
        for level in range(joints.shape[1] // 4):
            part = slice(4 * level, 4 * level + 4)
            found[f"JOINTS_{level}"] = joints[:, part].astype(kind)
            found[f"WEIGHTS_{level}"] = weights[:, part]
        return found

    def _triangles(self, mesh: Mesh) -> int:
        """Return the accessor of the indices, of the smallest type: the largest number of a type is no index."""
        if id(mesh) not in self._indices:
            indices = mesh.indices.reshape(-1)
            most = int(indices.max())
            kind = np.uint8 if most < 255 else np.uint16 if most < 65535 else np.uint32
            number = self._document.accessor(indices.astype(kind), target=TRIANGLES)
            self._indices[id(mesh)] = number
        return self._indices[id(mesh)]

    def _target(self, target: Any, attributes: Json) -> Json:
        """Return the attributes of a morph target that the mesh has, too: they are differences (section 3.7.2.2)."""
        found = {
            key: np.asarray(getattr(target, name), np.float32)
            for key, name in _DIFFERENCES.items()
            if key in attributes and getattr(target, name) is not None
        }
        if not found:  # a target has an attribute at least
            found["POSITION"] = np.zeros((self._vertices(attributes), 3), np.float32)
        for key in ("TEXCOORD_0", "TEXCOORD_1"):
            if key in found:
                found[key] = found[key] * np.array([1, -1], np.float32)
        add = self._document.accessor
        return {k: add(v, target=VERTICES, bounds=k == "POSITION") for k, v in found.items()}

    def _vertices(self, attributes: Json) -> int:
        return int(self._document.lists["accessors"][attributes["POSITION"]]["count"])

    @staticmethod
    def _is_lacking(target: Any, made: Json) -> bool:
        """Say whether an attribute of a target is not in its entry, since the mesh has no such attribute."""
        return any(
            getattr(target, name) is not None and key not in made
            for key, name in _DIFFERENCES.items()
        )


def _unit(normals: Array) -> Array:
    """Return normals that all have a length; one without, of a vertex without area, points up."""
    lengths = np.linalg.norm(normals, axis=1)
    if (np.abs(lengths - 1) < _UNIT).all():
        return normals
    lost = ~(lengths > 0)
    made = normals / np.where(lost, 1, lengths)[:, None]
    made[lost] = (0, 1, 0)
    return made.astype(np.float32)


def _influences(joints: Array, weights: Array) -> tuple[Array, Array]:
    """Return joints and weights as section 3.7.3.3 asks: weights have a sum of 1, and no joint counts twice."""
    joints, weights = np.array(joints), np.array(weights)
    for column in range(1, joints.shape[1]):
        for earlier in range(column):
            both = (weights[:, column] > 0) & (weights[:, earlier] > 0)
            twice = both & (joints[:, column] == joints[:, earlier])
            weights[twice, earlier] += weights[twice, column]
            weights[twice, column] = 0
    sums = weights.sum(axis=1, dtype=np.float64)
    off = np.abs(sums - 1) > _WEIGHT * (weights > 0).sum(axis=1)
    lost = sums <= 0
    weights[off] /= np.where(lost, 1, sums)[off, None]
    weights[lost, 0] = 1
    # The rest of rounding goes to the largest weight.
    rows = np.flatnonzero(off)
    rest = 1 - weights[rows].sum(axis=1, dtype=np.float64)
    weights[rows, weights[rows].argmax(axis=1)] += rest
    return np.where(weights > 0, joints, 0), weights


def _from_top(uvs: Array) -> Array:
    """Turn v, which cubecam counts from the bottom of a picture, into glTF's, from its top."""
    return np.stack([uvs[:, 0], np.float32(1) - uvs[:, 1]], axis=1)
