"""Scenes of mesh files that know no materials: one node."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path

from ..._core import Scene, StandardMaterial
from ..left_out import LeftOut
from .load import READERS
from .parts import joined

#: A matt grey-white surface, as mesh viewers show what has no material.
_ROUGHNESS = 0.5


def read_scene(path: Path, data: bytes, left_out: LeftOut) -> Scene:
    """Read a PLY, STL or OFF file; vertex colours show."""
    reader = import_module(READERS[path.suffix.lower()], __package__)
    scene = Scene()
    material = StandardMaterial(metallic=0, roughness=_ROUGHNESS)
    scene.add(joined(reader.read(path, data), None), material, name=path.stem)
    return scene
