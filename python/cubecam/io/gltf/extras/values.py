"""The JSON of `extras.cubecam` as values of properties; `write/values.py` is the inverse and describes the forms.

Nothing here runs code of a file: classes and properties come from the table in `classes.py`, and each value goes
through the constructor or the setter that users call.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np
import numpy.typing as npt

from ...._core import CubeMap, Image, Material, MeshError, Node, Scene
from ..document import Gltf
from ..entries import Entry, shown
from .classes import CUBE, PLANS, Plan

#: A list of more axes is no array of cubecam.
_MOST_AXES = 5
_DTYPES = ("uint8", "uint16", "int32", "float16", "float32", "float64")
#: Above this, lists are nested too deep to be a value.
_DEEP = 16


class Parts(Protocol):
    """The objects that the loader made, by indices of glTF; lights and cameras by the index of their node."""

    @property
    def texture(self) -> Callable[[int], Image | None]:
        """The image of a texture; None if it cannot be read."""

    nodes: dict[int, Node]
    meshes: dict[int, list[Any]]
    materials: dict[int, Material]
    lights: dict[int, Any]
    cameras: dict[int, Any]
    animations: list[Any]


class Reader:
    """Reads values; `parts` and `scene` are None before the loader has made them, when no value may refer to them."""

    def __init__(self, document: Gltf, objects: list[Any], where: str) -> None:
        self._document = document
        self._raw = objects
        self._where = where
        self._made: dict[int, Any] = {}
        self._later: list[tuple[Any, str, Any, str]] = []
        self.parts: Parts | None = None
        self.scene: Scene | None = None

    def value(self, raw: Any, where: str, depth: int = 0) -> Any:
        """Return what a JSON value stands for."""
        if depth > _DEEP:
            raise MeshError(f"{where}: expected a value of moderate depth, got a deeper one")
        if raw is None or isinstance(raw, (bool, str, int, float)):
            return raw
        if isinstance(raw, list):
            items = [self.value(item, f"{where}[{i}]", depth + 1) for i, item in enumerate(raw)]
            # A node that was not in the saved scene.
            return [v for v, item in zip(items, raw, strict=True) if item != {"node": None}]
        entry = Entry(where, raw)
        if "class" in raw:
            return self.inline(entry, depth)
        if "array" in raw:
            return self.array(entry)
        if len(raw) == 1:
            (word, content), *_ = raw.items()
            read = getattr(self, f"_{word}", None) if word in _FORMS else None
            if read is not None:
                return read(entry, content, depth)
        raise MeshError(f"{where}: expected a value of cubecam's extras, got {shown(raw)}")

    def _float(self, entry: Entry, content: Any, depth: int) -> float:
        if content not in ("inf", "-inf", "nan"):
            raise entry.error("float", '"inf", "-inf" or "nan"')
        return float(content)

    def _dict(self, entry: Entry, content: Any, depth: int) -> dict[str, Any]:
        found = entry.needed("dict")
        return {k: self.value(v, found.path(k), depth + 1) for k, v in found.raw.items()}

    def _node(self, entry: Entry, content: Any, depth: int) -> Node | None:
        return None if content is None else self._part(entry, "node", self._parts(entry).nodes)

    def _material(self, entry: Entry, content: Any, depth: int) -> Material:
        made: Material = self._part(entry, "material", self._parts(entry).materials)
        return made

    def _camera(self, entry: Entry, content: Any, depth: int) -> Any:
        return self._part(entry, "camera", self._parts(entry).cameras)

    def _texture(self, entry: Entry, content: Any, depth: int) -> Image:
        index = entry.index("texture", self._document.count("textures"))
        assert index is not None
        image = self._parts(entry).texture(index)
        if image is None:
            raise entry.error("texture", "a texture whose picture can be read")
        return image

    def _scene(self, entry: Entry, content: Any, depth: int) -> Scene:
        entry.index("scene", 1)
        if self.scene is None:
            raise entry.error("scene", "no scene here")
        return self.scene

    def _object(self, entry: Entry, content: Any, depth: int) -> Any:
        """Return a shared object; it is made at its first use."""
        index = entry.index("object", len(self._raw))
        assert index is not None
        if index not in self._made:
            raw, where = self._raw[index], f"{self._where}[{index}]"
            if not isinstance(raw, dict):
                raise MeshError(f"{where}: expected an object, got {shown(raw)}")
            self._made[index] = None
            self._made[index] = self.inline(Entry(where, raw), depth)
        if self._made[index] is None:
            raise entry.error("object", "an object that does not contain itself")
        return self._made[index]

    def _parts(self, entry: Entry) -> Parts:
        if self.parts is None:
            raise MeshError(
                f"{entry.where}: expected a value without references, got {shown(entry.raw)}"
            )
        return self.parts

    @staticmethod
    def _part(entry: Entry, word: str, known: dict[int, Any]) -> Any:
        raw = entry.raw[word]
        if type(raw) is not int or raw not in known:
            raise entry.error(word, f"the index of a {word} of the scene")
        return known[raw]

    def array(self, entry: Entry) -> npt.NDArray[Any]:
        """Return the array whose bytes are those of a buffer view."""
        index = entry.index("array", self._document.count("bufferViews"))
        assert index is not None
        dtype, shape = entry.text("dtype"), entry.indices("shape", 2**31)
        if dtype not in _DTYPES:
            raise entry.error("dtype", f"one of {', '.join(_DTYPES)}")
        if not 1 <= len(shape) <= _MOST_AXES:
            raise entry.error("shape", f"1 to {_MOST_AXES} numbers")
        data = self._document.view(index).data
        form = np.dtype(dtype).newbyteorder("<")
        size = form.itemsize * math.prod(shape)
        if size != len(data):
            raise MeshError(
                f"{entry.where}: expected {size} bytes in bufferViews[{index}], got {len(data)}"
            )
        return np.frombuffer(data, form).reshape(shape).astype(dtype)

    def inline(self, entry: Entry, depth: int = 0) -> Any:
        """Return an object of the class that an entry names."""
        name = entry.text("class")
        plan = PLANS.get(name or "")
        if plan is None:
            raise entry.error("class", f"one of {', '.join(PLANS)}")
        self.check_names(entry, ("class", *plan.names))
        if plan.kind is CubeMap:
            return self._cube(entry)
        arguments = {
            name: self.value(entry.raw[name], entry.path(name), depth + 1)
            for name in plan.made
            if name in entry
        }
        made = made_of(plan.kind, arguments, entry.where)
        self.set_later(made, entry, plan)
        return made

    def set_later(self, made: Any, entry: Entry, plan: Plan) -> None:
        """Remember the properties that may lead back to an object."""
        for name in plan.later:
            if name in entry:
                self._later.append((made, name, entry.raw[name], entry.path(name)))

    def finish(self) -> None:
        """Set the properties that were left for later, also those of objects that this makes."""
        while self._later:
            made, name, raw, where = self._later.pop()
            self.set(made, name, self.value(raw, where), where)

    @staticmethod
    def set(made: Any, name: str, value: Any, where: str) -> None:
        """Set a property; what its setter refuses is an error of the file."""
        try:
            setattr(made, name, value)
        except (TypeError, ValueError, IndexError, OverflowError, AttributeError) as error:
            raise MeshError(f"{where}: {error}") from None

    @staticmethod
    def check_names(entry: Entry, names: tuple[str, ...]) -> None:
        """Refuse properties that are not in the table."""
        for name in entry.raw:
            if name not in names:
                raise MeshError(
                    f"{entry.path(name)}: expected one of {', '.join(names)}, got {name!a}"
                )

    def _cube(self, entry: Entry) -> CubeMap:
        """Return a cubemap with its outputs and its filtered levels."""
        found = {
            name: self.value(entry.raw[name], entry.path(name)) for name in CUBE if name in entry
        }
        faces = found.pop("faces", None)
        outputs, levels = found.pop("outputs", {}), found.pop("levels", None)
        made = made_of(CubeMap, {"faces": faces, **found}, entry.where)
        if not outputs and levels is None:
            cube: CubeMap = made
            return cube
        if not isinstance(outputs, dict) or not all(
            isinstance(v, np.ndarray) for v in outputs.values()
        ):
            raise entry.error("outputs", "arrays by name")
        if levels is not None and not _are_levels(levels, made.faces):
            raise MeshError(
                f"{entry.path('levels')}: expected pairs of a roughness and faces like those of the cubemap, "
                "got others"
            )
        number, state = made.__reduce__()[2]
        state = (*state[:2], outputs, state[3])
        if levels is not None:
            state = (*state, [tuple(level) for level in levels])
        cube = CubeMap.__new__(CubeMap)
        try:
            cube.__setstate__((number, state))
        except (TypeError, ValueError) as error:
            raise MeshError(f"{entry.where}: {error}") from None
        return cube


_FORMS = frozenset({"float", "dict", "node", "material", "camera", "texture", "scene", "object"})


def made_of(kind: type[Any], arguments: dict[str, Any], where: str) -> Any:
    """Call a constructor; what it refuses is an error of the file."""
    try:
        return kind(**arguments)
    except (TypeError, ValueError, IndexError, OverflowError) as error:
        raise MeshError(f"{where}: {error}") from None


def _are_levels(levels: Any, faces: npt.NDArray[Any]) -> bool:
    """Say whether levels have the dtype and channels of a cubemap, and no level is larger than the one before."""
    if not isinstance(levels, list) or not levels:
        return False
    size, roughness = faces.shape[1], 0.0
    for level in levels:
        if not (isinstance(level, list) and len(level) == 2):
            return False
        rough, array = level
        if isinstance(rough, bool) or not isinstance(rough, (int, float)):
            return False
        if not isinstance(array, np.ndarray) or array.dtype != faces.dtype or array.ndim != 4:
            return False
        edge = array.shape[1]
        if array.shape != (6, edge, edge, faces.shape[3]) or not 1 <= edge <= size:
            return False
        if not roughness < rough <= 1 or np.isnan(array).any():
            return False
        size, roughness = edge, rough
    return True
