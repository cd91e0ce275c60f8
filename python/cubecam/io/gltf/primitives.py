"""Primitives of meshes: attributes, and triangles of every mode (section 3.7.2 of glTF 2.0)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import MeshError
from ..meshes.parts import LARGEST
from .accessors import Layout, decoded
from .compression import Draco
from .document import Gltf
from .entries import Entry
from .extensions import DRACO
from .limits import Limits

Floats = npt.NDArray[np.float64]
Faces = npt.NDArray[np.int64]

MODES = ("points", "lines", "line loops", "line strips", "triangles", "strips", "fans")


@dataclass
class Surface:
    """The triangles of one primitive in the space of its mesh: V vertices, T triangles.

    `positions` is (V, 3), `faces` (T, 3), `normals` (V, 3) of any length, or None if the file has none, `uvs` (V, 2) as
    in the file, from the top of a picture, `colors` (V, 4) linear, 0..1. `uvs1` is a second set of `uvs`, `tangents`
    (V, 4) are those of the file, which count only beside its normals. `attributes` reads what else there is.
    """

    positions: Floats
    faces: Faces
    normals: Floats | None
    uvs: Floats | None
    colors: Floats | None
    attributes: Attributes
    entry: Entry
    uvs1: Floats | None = None
    tangents: Floats | None = None


class Attributes:
    """The attributes of a primitive or of a morph target. All have as many elements as POSITION."""

    def __init__(
        self,
        document: Gltf,
        entry: Entry,
        count: int | None = None,
        draco: tuple[Draco, Entry] | None = None,
    ) -> None:
        """`draco` is decoded data with the entry that names the ids of attributes in it."""
        self._document = document
        self._count = count
        self._draco = draco
        self.entry = entry

    def __contains__(self, key: str) -> bool:
        return key in self.entry

    def read(self, key: str, *kinds: str) -> npt.NDArray[Any]:
        """Read an attribute such as TEXCOORD_1 or _CUSTOM with an accessor of one of the types (any, if none is given).

        Normalized integers become floats; other numbers are as in the file.
        """
        number = accessor_index(self._document, self.entry, key)
        form = self._document.layout(number)
        if kinds:
            check_type(self.entry, key, form, *kinds)
        if self._draco is not None and key in self._draco[1]:
            data, ids = self._draco
            values = decoded(*data.values(ids, key, form))
        else:
            values = self._document.accessor(number)
        if self._count is None:
            self._count = len(values)
        if len(values) != self._count:
            raise MeshError(
                f"{self.entry.path(key)}: expected {self._count} elements, as other attributes have, "
                f"got {len(values)}"
            )
        return values

    def floats(self, key: str, *kinds: str) -> Floats | None:
        """Read an attribute as float64; None if there is none."""
        return np.asarray(self.read(key, *kinds), np.float64) if key in self else None


def accessor_index(document: Gltf, entry: Entry, key: str) -> int:
    """Read the index of an accessor that must be there."""
    number = entry.index(key, document.count("accessors"))
    if number is None:
        raise entry.error(key, "the index of an accessor")
    return number


def check_type(entry: Entry, key: str, form: Layout, *kinds: str) -> None:
    if form.kind not in kinds:
        raise MeshError(
            f"{entry.path(key)}: expected an accessor of {' or '.join(kinds)}, got {form.kind}"
        )


def surface(
    document: Gltf, primitive: Entry, draco: Draco | None, limits: Limits
) -> Surface | None:
    """Read a primitive of triangles; None if it has none."""
    ids = primitive.needed("extensions").needed(DRACO).needed("attributes") if draco else None
    attributes = Attributes(
        document,
        primitive.needed("attributes"),
        count=None if draco is None else draco.count,
        draco=(draco, ids) if draco is not None and ids is not None else None,
    )
    positions = attributes.floats("POSITION", "VEC3")
    if positions is None:  # section 3.7.2.1: such a primitive is skipped
        return None
    faces = triangles(document, primitive, len(positions)) if draco is None else draco.faces
    limits.output(len(positions) + len(faces), primitive)
    if not len(faces):
        return None
    if not (np.abs(positions) <= LARGEST).all():
        raise MeshError(f"{attributes.entry.path('POSITION')}: expected finite numbers, got others")
    return Surface(
        positions,
        faces,
        attributes.floats("NORMAL", "VEC3"),
        attributes.floats("TEXCOORD_0", "VEC2"),
        colors(attributes, alpha=1.0),
        attributes,
        primitive,
        attributes.floats("TEXCOORD_1", "VEC2"),
        _tangents(attributes) if "NORMAL" in attributes else None,
    )


def _tangents(attributes: Attributes) -> Floats | None:
    """Read TANGENT; None where the file has none that can be used."""
    values = attributes.floats("TANGENT", "VEC4")
    if values is None or not (np.abs(values) <= LARGEST).all():
        return None
    values[:, 3] = np.where(values[:, 3] < 0, -1, 1)
    return values


def colors(attributes: Attributes, alpha: float) -> Floats | None:
    """Read COLOR_0 as (V, 4) floats, with `alpha` where the file has none; None if there are no colours.

    Colours of a mesh are clamped to 0..1, as the specification asks; those of morph targets, which are differences and
    have an alpha of 0, are not.
    """
    if "COLOR_0" not in attributes:
        return None
    values = attributes.read("COLOR_0", "VEC3", "VEC4")
    if values.dtype.kind == "u":  # integers must be normalized, so that the flag is missing
        values = decoded(values, True)
    result = np.asarray(values, np.float64)
    if result.shape[1] == 3:
        result = np.concatenate([result, np.full((len(result), 1), alpha)], axis=1)
    return np.clip(result, 0, 1) if alpha else result


def from_bottom(uvs: Floats) -> Floats:
    """Turn v, which glTF counts from the top of a picture, into cubecam's, from its bottom."""
    return np.stack([uvs[:, 0], 1 - uvs[:, 1]], axis=1)


def triangles(document: Gltf, primitive: Entry, vertices: int) -> Faces:
    """Read the triangles, (T, 3), of a primitive that has some vertices."""
    corners = _corners(document, primitive, vertices)
    mode, count = primitive.integer("mode", 4), len(corners)
    if MODES[mode] == "triangles":
        if count % 3:
            raise MeshError(f"{primitive.where}: expected a multiple of 3 indices, got {count}")
        return corners.reshape(-1, 3)
    if count == 0:
        return corners.reshape(0, 3)
    if count < 3:
        raise MeshError(f"{primitive.where}: expected 3 indices or more, got {count}")
    first = np.arange(count - 2)
    if MODES[mode] == "strips":
        odd = first % 2
        return corners[np.stack([first, first + 1 + odd, first + 2 - odd], axis=1)]
    return corners[np.stack([first + 1, first + 2, np.zeros_like(first)], axis=1)]


def _corners(document: Gltf, primitive: Entry, vertices: int) -> Faces:
    """Read the vertices that a primitive uses, one after another."""
    if "indices" not in primitive:
        return np.arange(vertices, dtype=np.int64)
    number = accessor_index(document, primitive, "indices")
    form = document.layout(number)
    if form.kind != "SCALAR" or form.component.kind != "u" or form.normalized:
        raise primitive.error("indices", "an accessor of unsigned integers")
    stored = document.stored(number)
    if len(stored):
        largest = int(stored.max())
        if largest >= vertices or largest == np.iinfo(stored.dtype).max:
            # The largest number of a type would start a new primitive, so that it is no index.
            most = min(vertices, int(np.iinfo(stored.dtype).max))
            raise MeshError(
                f"{primitive.path('indices')}: expected indices below {most}, got {largest}"
            )
    return stored.astype(np.int64)
