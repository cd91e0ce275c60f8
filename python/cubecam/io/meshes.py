"""Read mesh files (OBJ, PLY, STL, glTF, OFF) with trimesh, which is imported when the first file is read."""

from __future__ import annotations

import io
import math
import re
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import numpy.typing as npt

from .._calls import checked_call
from .._core import Mesh, MeshError
from .files import PathLike, existing_file

if TYPE_CHECKING:
    from pathlib import Path

__all__ = ["load_mesh"]

# Options of trimesh for each kind of file. An OBJ's materials are skipped, so that a missing picture is no error; those
# of glTF are read, because trimesh returns texture coordinates only together with materials.
_KINDS: dict[str, dict[str, Any]] = {
    ".obj": {"skip_materials": True},
    ".ply": {},
    ".stl": {},
    ".gltf": {},
    ".glb": {},
    ".off": {},
}


@dataclass
class _Part:
    """One geometry at its place: world positions, and the other data of the file."""

    positions: npt.NDArray[np.float64]
    faces: npt.NDArray[np.int64]
    normals: npt.NDArray[np.float64] | None
    uvs: npt.NDArray[np.float64] | None
    colors: npt.NDArray[np.float64] | None


@checked_call
def load_mesh(path: PathLike, *, size: float | None = None) -> Mesh:
    """Read a mesh file.

    Parameters
    ----------
    path : str or os.PathLike
        Wavefront OBJ, PLY, STL, glTF 2 (.gltf, .glb) or OFF; polygons are cut into triangles. A file of several
        objects becomes one mesh, each placed by its transform. Materials and textures are not read.
    size : float, optional
        The mesh is centred (the middle of its bounds goes to the origin) and scaled so that its largest extent is
        `size`, in world units. None: the mesh keeps its place and size.

    Returns
    -------
    Mesh
        Vertices are in the file's order; those of an OBJ are split where texture coordinates or normals differ.
        Normals are those of the file; if it has none they are computed smooth, also across two vertices at one place
        (a seam in the texture coordinates). Equal positions of an STL file, which lists three corners for each
        triangle, are merged. New positions (`Mesh.update`) keep all these normals. The mesh has uvs, with (0, 0) at a
        picture's bottom-left, and colours if the file has them.

    Raises
    ------
    OSError
        If there is no file of that name (FileNotFoundError), or it may not be read.
    MeshError
        For another kind of file, broken contents, or no triangles.
    ValueError
        If size is not above 0.

    Examples
    --------
    >>> import cubecam as cc
    >>> bunny = cc.load_mesh(cc.sample_data("bunny.obj"), size=1)
    >>> bunny.positions.shape, bunny.indices.shape
    ((1839, 3), (3674, 3))
    >>> extent = bunny.positions.max(axis=0) - bunny.positions.min(axis=0)
    >>> round(float(extent.max()), 4)
    1.0
    """
    if size is not None and not (
        isinstance(size, (int, float, np.number)) and math.isfinite(size) and size > 0
    ):
        raise ValueError(f"size: expected a number above 0 or None, got {size!r}")
    found = existing_file(path)
    extension = found.suffix.lower()
    if extension not in _KINDS:
        raise MeshError(
            f"{found}: expected a mesh file that ends in {', '.join(_KINDS)}; got {extension or 'none'}"
        )
    parts = _read(found, extension)
    if extension == ".stl":
        parts = [_merged(part) for part in parts]
    try:
        return _joined(parts, size)
    except (ValueError, IndexError) as error:
        # The core's own checks: an index out of range, a position that is not finite.
        raise MeshError(f"{found}: {error}") from error


def _from_trimesh(mesh: object) -> Mesh:
    """Make a mesh from a mesh or a scene of trimesh: `Mesh.from_trimesh`, which has the documentation."""
    # Whoever has an object of trimesh has imported it.
    trimesh = sys.modules.get("trimesh")
    if trimesh is None or not isinstance(mesh, (trimesh.Trimesh, trimesh.Scene)):
        raise TypeError(
            f"mesh: expected a trimesh.Trimesh or a trimesh.Scene, got {type(mesh).__name__}"
        )
    scene: Any = trimesh.Scene([mesh]) if isinstance(mesh, trimesh.Trimesh) else mesh
    for geometry in scene.geometry.values():
        if isinstance(geometry, trimesh.Trimesh) and len(geometry.faces):
            geometry.vertex_normals  # noqa: B018 - so that the cache of trimesh has them, as _placed expects
    parts = _parts(scene)
    if not parts:
        raise ValueError("mesh: expected triangles, got none")
    return _joined(parts, None)


def _read(path: Path, extension: str) -> list[_Part]:
    import trimesh

    try:
        # process=False: no vertex is merged, dropped or moved.
        if extension == ".obj":
            text = io.StringIO(_obj_text(path))
            scene = trimesh.load_scene(text, "obj", process=False, **_KINDS[extension])
        else:
            scene = trimesh.load_scene(str(path), process=False, **_KINDS[extension])
    except MemoryError:
        raise
    except (
        Exception
    ) as error:  # trimesh reports broken files with whatever its parsers stumble over
        raise MeshError(
            f"{path}: cannot be read as {extension[1:]}: {type(error).__name__}: {error}"
        ) from error
    try:
        parts = _parts(scene)
    except ValueError as error:
        raise MeshError(f"{path}: {error}") from error
    if not parts:
        kinds = sorted({type(geometry).__name__ for geometry in scene.geometry.values()})
        raise MeshError(
            f"{path}: expected triangles, got {', '.join(kinds) or 'nothing'} without any"
        )
    return parts


def _parts(scene: Any) -> list[_Part]:
    """Read each mesh of a trimesh scene that has triangles."""
    import trimesh

    parts = []
    for name in scene.graph.nodes_geometry:
        matrix, key = scene.graph[name]
        geometry = scene.geometry[key]
        if isinstance(geometry, trimesh.Trimesh) and len(geometry.faces):
            if geometry.vertices.shape[1] != 3:
                got = geometry.vertices.shape[1]
                raise ValueError(f"expected vertices of three numbers, got {got}")
            parts.append(_placed(geometry, np.asarray(matrix, dtype=np.float64)))
    return parts


def _obj_text(path: Path) -> str:
    """Read an OBJ file as trimesh needs it: as text, and without comments after numbers."""
    data = path.read_bytes()
    try:
        text = data.decode("utf-8")
    except UnicodeDecodeError:
        text = data.decode("latin-1")  # names and comments of older exporters
    text = re.sub(r"^([ \t]*(?:v|vt|vn|f)[ \t][^#\r\n]*)#.*$", r"\1", text, flags=re.MULTILINE)
    zero = re.search(r"^[ \t]*f(?:[ \t].*?)?[ \t]0(?:[/ \t\r]|$)", text, flags=re.MULTILINE)
    if zero:
        raise ValueError(
            f"expected indices from 1 (or negative ones), got {zero.group().strip()!r}"
        )
    return text


def _placed(geometry: Any, matrix: npt.NDArray[np.float64]) -> _Part:
    """Read the file's data from a trimesh object, and move them to their place."""
    linear = matrix[:3, :3]
    positions = np.asarray(geometry.vertices, dtype=np.float64) @ linear.T + matrix[:3, 3]
    faces = np.asarray(geometry.faces, dtype=np.int64)
    normals = None
    # The property would compute missing normals; only the cache shows whether the file has normals.
    if "vertex_normals" in geometry._cache:
        # Normals are transformed by the inverse transpose. The matrix of cofactors equals it up to a factor, and exists
        # for a singular matrix, too.
        cofactors = np.stack(
            [
                np.cross(linear[1], linear[2]),
                np.cross(linear[2], linear[0]),
                np.cross(linear[0], linear[1]),
            ]
        )
        normals = np.asarray(geometry.vertex_normals, dtype=np.float64) @ cofactors.T
    if np.linalg.det(linear) < 0:
        normals = None if normals is None else -normals
        faces = faces[:, ::-1]  # a mirror turns counter-clockwise into clockwise
    uvs = getattr(geometry.visual, "uv", None)
    colors = None
    if geometry.visual.kind == "vertex":
        colors = _unit_colors(geometry.visual.vertex_colors)
    elif "color" in getattr(geometry.visual, "vertex_attributes", {}):
        colors = _unit_colors(
            geometry.visual.vertex_attributes["color"]
        )  # beside a texture, in glTF
    count = len(positions)
    return _Part(
        positions,
        faces,
        _of_length(normals, count),
        _of_length(uvs, count),
        _of_length(colors, count),
    )


def _unit_colors(values: Any) -> npt.NDArray[np.float64]:
    """Turn vertex colours of any type into 0..1, with an alpha of 1 where there is none."""
    given = np.asarray(values)
    scale = np.iinfo(given.dtype).max if given.dtype.kind == "u" else 1
    colors: npt.NDArray[np.float64] = given.astype(np.float64) / scale
    if colors.shape[1] == 3:
        colors = np.concatenate([colors, np.ones((len(colors), 1))], axis=1)
    return colors


def _of_length(values: Any, count: int) -> npt.NDArray[np.float64] | None:
    if values is None or len(values) != count:
        return None
    return np.asarray(values, dtype=np.float64)


def _unique_positions(part: _Part) -> tuple[npt.NDArray[np.float64], npt.NDArray[np.int64]]:
    """Give each distinct position once, in the order of first use, and each vertex's index among them."""
    # + 0.0 makes -0.0 equal to 0.0 bit for bit.
    _, first, inverse = np.unique(
        part.positions.astype(np.float32) + np.float32(0),
        axis=0,
        return_index=True,
        return_inverse=True,
    )
    order = np.argsort(first, kind="stable")
    rank = np.empty_like(order)
    rank[order] = np.arange(len(order))
    return part.positions[first[order]], rank[inverse.reshape(-1)]


def _merged(part: _Part) -> _Part:
    positions, index = _unique_positions(part)
    return _Part(positions, index[part.faces], None, None, None)


def _normals(part: _Part) -> npt.NDArray[np.float64]:
    """Return the file's normals, of length 1, and smooth ones where the file has none or vectors of length 0."""
    given = part.normals
    if given is not None:
        lengths = np.linalg.norm(given, axis=1, keepdims=True)
        sound = np.isfinite(lengths[:, 0]) & (lengths[:, 0] > 0)
        if sound.all():
            unit: npt.NDArray[np.float64] = given / lengths
            return unit
    positions, index = _unique_positions(part)
    computed = np.asarray(Mesh(positions, index[part.faces]).normals, dtype=np.float64)
    smooth: npt.NDArray[np.float64] = computed[index]
    if given is not None:
        smooth[sound] = given[sound] / lengths[sound]
    return smooth


def _joined(parts: list[_Part], size: float | None) -> Mesh:
    positions = np.concatenate([part.positions for part in parts])
    starts = np.cumsum([0] + [len(part.positions) for part in parts[:-1]])
    indices = np.concatenate(
        [part.faces + start for part, start in zip(parts, starts, strict=True)]
    )
    if indices.min() < 0 or indices.max() >= len(positions):
        raise IndexError(
            f"expected indices 0 to {len(positions) - 1}, got {indices.min()} to {indices.max()}"
        )
    if not np.isfinite(positions).all():
        raise ValueError("expected finite positions, got NaN or infinity")
    low, high = positions.min(axis=0), positions.max(axis=0)
    extent = float((high - low).max())
    if (
        extent == 0
    ):  # trimesh returns such triangles for glTF with a compression that it cannot decode
        raise ValueError("expected triangles of some extent, got all vertices in one place")
    if size is not None:
        positions = (positions - (low + high) / 2) * (size / extent)
    return Mesh(
        positions,
        indices,
        normals=np.concatenate([_normals(part) for part in parts]),
        uvs=_column([part.uvs for part in parts], parts, 2, 0.0),
        colors=_column([part.colors for part in parts], parts, 4, 1.0),
    )


def _column(
    values: list[npt.NDArray[np.float64] | None], parts: list[_Part], width: int, missing: float
) -> npt.NDArray[np.float64] | None:
    """Join what some parts have; the others get a constant. None if no part has any."""
    if all(value is None for value in values):
        return None
    return np.concatenate(
        [
            np.full((len(part.positions), width), missing) if value is None else value[:, :width]
            for part, value in zip(parts, values, strict=True)
        ]
    )
