"""Properties of objects as JSON, for `extras.cubecam`; `extras/values.py` reads them back.

Numbers, words, lists and None are JSON. All other values are objects with one key that says what they are: `array`
(bytes of a buffer view), `float` (infinity), `dict`, `class` (an object that belongs to one place), or a reference:
`node`, `material`, `texture` and `scene` are indices of glTF, `camera` is the node of a camera, `object` is an index
into `extras.cubecam.objects` of the root.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from ...._core import (
    Camera,
    CubeMap,
    Image,
    ImageEffect,
    Material,
    Node,
    PlanarMirror,
    Probe,
    ProbeBlend,
    ProbeGrid,
    RenderTexture,
    Scene,
)
from ..extras.classes import CUBE, PLANS, state_of
from .document import Array, Document, Json

#: Larger arrays become bytes of a buffer view.
_FEW = 64
#: Objects that several others may share stand in one list.
_SHARED = (CubeMap, Probe, ProbeBlend, ProbeGrid, PlanarMirror, RenderTexture, ImageEffect, Camera)


def number(value: float) -> float:
    """Return the shortest decimal number that is the same float32: 0.2 and not 0.200000003."""
    return float(str(np.float32(value)))


def numbers(values: Array) -> list[Any]:
    """Return nested lists of an array's numbers, float32 as `number` does."""
    if values.dtype == np.float32:
        return [number(v) if v.ndim == 0 else numbers(v) for v in values]
    return list(values.tolist())


def same(a: Any, b: Any) -> bool:
    """Say whether two values of a property are equal; objects that are shared must be the same one."""
    if isinstance(a, np.ndarray) or isinstance(b, np.ndarray):
        return np.array_equal(a, b)
    if isinstance(a, (*_SHARED, Image, Node, Material, Scene)):
        return a is b
    return type(a) is type(b) and bool(a == b)


#: What stands for a node that is not in the scene.
_NOWHERE = {"node": None}


class Values:
    """Turns properties into JSON. `references` gives the JSON of nodes, materials, images and scenes."""

    def __init__(
        self, document: Document, references: Mapping[type[Any], Callable[[Any], Json]]
    ) -> None:
        self._document = document
        self._references = references
        #: What `extras.cubecam.objects` becomes.
        self.objects: list[Json] = []
        self._known: dict[int, tuple[Any, int]] = {}
        self._cameras: dict[int, int] = {}

    def know_camera(self, camera: Camera, node: int) -> None:
        """Refer to a camera by its node from now on."""
        self._cameras[id(camera)] = node

    def properties(self, thing: object, names: Iterable[str]) -> Json:
        """Return properties of an object by name."""
        return {name: self.value(getattr(thing, name)) for name in names}

    def changed(self, thing: object, plain: object, names: Iterable[str]) -> Json:
        """Return the properties in which an object differs from another one of its class."""
        return self.properties(
            thing, [n for n in names if not same(getattr(thing, n), getattr(plain, n))]
        )

    def value(self, value: Any) -> Any:
        """Return what stands for a value in JSON."""
        if isinstance(value, (np.bool_, np.number)):
            value = value.item()
        if value is None or isinstance(value, (bool, str, int)):
            return value
        if isinstance(value, float):
            return value if math.isfinite(value) else {"float": str(value)}
        if isinstance(value, np.ndarray):
            return self.array(value)
        if isinstance(value, (tuple, list)):
            return [self.value(item) for item in value]
        if isinstance(value, Mapping):
            return {"dict": {key: self.value(item) for key, item in value.items()}}
        for kind, reference in self._references.items():
            if isinstance(value, kind):
                return reference(value)
        if id(value) in self._cameras:
            return {"camera": self._cameras[id(value)]}
        if isinstance(value, _SHARED):
            return {"object": self.shared(value)}
        return self.inline(value)

    def array(self, values: Array) -> Any:
        """Return a list of numbers, or bytes of a buffer view for a large array or one of another dtype."""
        plain = values.dtype in (np.float32, np.float64)
        if plain and values.size <= _FEW and np.isfinite(values).all():
            return numbers(values)
        data = np.ascontiguousarray(values)
        if data.dtype.byteorder == ">":
            data = data.astype(data.dtype.newbyteorder("<"))
        view = self._document.view(data.tobytes())
        return {"array": view, "dtype": data.dtype.name, "shape": list(data.shape)}

    def shared(self, thing: Any) -> int:
        """Return the index of an object in the list of objects."""
        if id(thing) not in self._known:
            self._known[id(thing)] = (thing, len(self.objects))
            self.objects.append({})  # first, since its properties may lead back to it
            self.objects[self._known[id(thing)][1]] = self.inline(thing)
        return self._known[id(thing)][1]

    def inline(self, thing: Any) -> Json:
        """Return the class of an object and its properties."""
        plan = next((PLANS[k.__name__] for k in type(thing).__mro__ if k.__name__ in PLANS), None)
        if plan is None:
            raise TypeError(f"expected one of {', '.join(PLANS)}, got {type(thing).__name__}")
        if isinstance(thing, CubeMap):
            return {"class": "CubeMap", **self._cube(thing)}
        names = [n for n in plan.names if hasattr(thing, n)]
        found = self.properties(thing, [n for n in names if not callable(getattr(thing, n))])
        if type(thing) is Camera:
            found["projection"] = self.value(thing.projection())
        if found.get("parent") == _NOWHERE:
            raise ValueError(
                f"{plan.kind.__name__}: expected a parent that is a node of the scene, got one that is not"
            )
        return {"class": plan.kind.__name__, **found}

    def _cube(self, cube: CubeMap) -> Json:
        """Return the parts of a cubemap, with captured outputs and filtered levels."""
        parts: Any = dict(zip(CUBE, state_of(cube), strict=False))
        found = {name: self.value(parts[name]) for name in ("mipmaps", "encoding")}
        found["faces"] = self.array(parts["faces"])
        if parts["outputs"]:
            found["outputs"] = self.value(parts["outputs"])
        if parts.get("levels"):
            found["levels"] = [[number(r), self.array(faces)] for r, faces in parts["levels"]]
        return found
