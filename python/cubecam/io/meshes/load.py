"""`load_mesh`: the kinds of mesh files and the modules that read them."""

from __future__ import annotations

import math
from importlib import import_module
from typing import TYPE_CHECKING

import numpy as np

from ..._calls import checked_call
from ..._core import Mesh, MeshError
from ..files import PathLike, as_path, read_file
from .parts import joined

if TYPE_CHECKING:
    from .parts import Part

__all__ = ["load_mesh"]

# The module that reads each kind of file with its function `read(path, data)`.
_READERS = {
    ".obj": ".trimesh_parts",
    ".ply": ".ply",
    ".stl": ".stl",
    ".gltf": ".trimesh_parts",
    ".glb": ".trimesh_parts",
    ".off": ".off",
}


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
    found = as_path(path)
    extension = found.suffix.lower()
    data = read_file(found, MeshError)
    if extension not in _READERS:
        raise MeshError(
            f"{found}: expected a mesh file that ends in {', '.join(_READERS)}; got {extension or 'none'}"
        )
    reader = import_module(_READERS[extension], __package__)
    try:
        # Numbers of a file may be too large or not finite: checks report those that matter, not warnings of numpy.
        with np.errstate(all="ignore"):
            parts: list[Part] = reader.read(found, data)
            return joined(parts, size)
    except (MeshError, ValueError, IndexError) as error:
        # ValueError and IndexError are the core's own checks: an index out of range, a position that is not finite.
        raise MeshError(f"{found}: {error}") from error
