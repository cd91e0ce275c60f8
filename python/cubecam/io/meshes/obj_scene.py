"""OBJ files as scenes: an object or group is a node; where it has several materials, each is a node below it."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from ..._core import FileError, Mesh, Scene, StandardMaterial
from ..left_out import LeftOut
from .mtl import Mtl, parsed
from .mtl_materials import MtlMaterials, read_named
from .obj import Obj, Run
from .obj import parsed as parsed_obj
from .parts import Part, check_indices, unit_normals

#: Nodes of a scene: a line of a few bytes may start one.
_MOST_NODES = 1 << 16


def read_scene(path: Path, data: bytes, left_out: LeftOut) -> Scene:
    """Read an OBJ file with the materials of its libraries."""
    obj = parsed_obj(data)
    check_indices(obj.part.faces, len(obj.part.positions))
    smooth = obj.part.normals is None
    obj.part.normals = unit_normals(obj.part)
    libraries = _libraries(obj, path.parent, left_out)
    makers = _Makers(libraries, MtlMaterials(path.parent, left_out), left_out)
    makers.prepare({run.material for run in obj.runs})
    scene = Scene()
    for name, runs in _groups(obj, path.stem, left_out).items():
        cut = [(part, key) for key, part in _cut(obj, runs, smooth=smooth).items()]
        holder = scene.add(name=name)
        for number, (mesh, (material, flat)) in enumerate(cut):
            node = holder
            if len(cut) > 1:
                node = scene.add(name=f"{name}.{number}", parent=holder)
            node.mesh = mesh
            node.material = makers.get(material, flat=flat)
    return scene


def _groups(obj: Obj, stem: str, left_out: LeftOut) -> dict[str, list[Run]]:
    """Sort runs by their object, or by their groups where the file has no objects."""
    found: dict[str, list[Run]] = {}
    for run in obj.runs:
        name = run.object or " ".join(run.groups) or stem
        if name not in found and len(found) >= _MOST_NODES:
            left_out.add(f"objects beyond the first {_MOST_NODES} are one")
            name = next(iter(found))
        found.setdefault(name, []).append(run)
    return found


def _cut(obj: Obj, runs: list[Run], *, smooth: bool) -> dict[tuple[str, bool], Mesh]:
    """Make a mesh of the triangles of each material; those that the file wants flat are apart."""
    found: dict[tuple[str, bool], list[Run]] = {}
    for run in runs:
        flat = smooth and run.smoothing in ("off", "0")
        found.setdefault((run.material, flat), []).append(run)
    result = {}
    for key, members in found.items():
        # The polygons of triangles are in order, so that a run is a range of triangles.
        bounds = np.searchsorted(obj.polygons, [[run.first, run.stop] for run in members])
        faces = np.concatenate([obj.part.faces[first:stop] for first, stop in bounds])
        if len(faces):
            result[key] = _mesh(obj.part, faces)
    return result


def _mesh(part: Part, faces: npt.NDArray[np.int64]) -> Mesh:
    used, indices = np.unique(faces, return_inverse=True)

    def taken(values: Any) -> Any:
        return None if values is None else values[used]

    return Mesh(
        part.positions[used],
        indices.reshape(-1, 3),
        normals=taken(part.normals),
        uvs=taken(part.uvs),
        colors=taken(part.colors),
    )


def _libraries(obj: Obj, folder: Path, left_out: LeftOut) -> dict[str, Mtl]:
    """Read the materials of all libraries; a line names one file, whose name may have blanks, or several."""
    found: dict[str, Mtl] = {}
    for line in dict.fromkeys(obj.libraries):
        for names in dict.fromkeys(((line,), tuple(line.split()))):
            try:
                texts = [read_named(name, folder) for name in names]
            except FileError as error:
                problem = error
                continue
            for text in texts:
                found = parsed(text) | found
            break
        else:
            left_out.add(f"a library of materials is left out: {problem}")
    return found


class _Makers:
    """Materials by their names, each made once; those that no library has are grey."""

    def __init__(self, libraries: dict[str, Mtl], maker: MtlMaterials, left_out: LeftOut) -> None:
        self._libraries = libraries
        self._maker = maker
        self._left_out = left_out
        self._made: dict[tuple[str, bool], StandardMaterial] = {}

    def prepare(self, names: set[str]) -> None:
        self._maker.prepare([self._libraries[n] for n in sorted(names) if n in self._libraries])

    def get(self, name: str, *, flat: bool) -> StandardMaterial:
        if (name, flat) not in self._made:
            if name in self._libraries:
                made = self._maker.make(self._libraries[name])
            else:
                if name and self._libraries:
                    self._left_out.add("a material is in no library", name)
                made = StandardMaterial(metallic=0, roughness=0.5, name=name)
            made.flat_shading = flat
            self._made[name, flat] = made
        return self._made[name, flat]
