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
READERS = {
    ".obj": ".obj",
    ".ply": ".ply",
    ".stl": ".stl",
    ".gltf": "..gltf",
    ".glb": "..gltf",
    ".off": ".off",
}


@checked_call
def load_mesh(path: PathLike, *, size: float | None = None) -> Mesh:
    """Read a mesh file.

    Parameters
    ----------
    path : str or os.PathLike
        Wavefront OBJ, PLY, STL, OFF or glTF 2 (.gltf, .glb). A file of several objects becomes one mesh, each placed by
        its transform. Materials and textures are not read. Files that a .gltf names must lie in its folder or below.
    size : float, optional
        The mesh is centred (the middle of its bounds goes to the origin) and scaled so that its largest extent is
        `size`, in world units. None: the mesh keeps its place and size.

    Returns
    -------
    Mesh
        Vertices are in the file's order, and split where a corner has its own texture coordinates, normal or colour.
        Polygons are cut into triangles inside them, also concave ones; strips and fans become triangles, lines and
        points are skipped. The mesh has uvs, with (0, 0) at a picture's bottom-left, and colours, with alpha, if the
        file has them. New positions (`Mesh.update`) keep all normals.

    Raises
    ------
    OSError
        If there is no file of that name (FileNotFoundError), or it may not be read.
    MeshError
        For another kind of file, broken contents, no triangles, counts that the bytes of the file cannot hold, or
        something else than a regular file.
    ValueError
        If size is not above 0.

    Notes
    -----
    Normals are those of the file; missing ones are computed smooth, also across two vertices at one place (a seam in
    the texture coordinates). glTF asks for flat normals then: `flat_shading` of a material draws them. Equal positions
    of an STL file, which lists three corners for each triangle, are merged, and its normals are not read.

    Colours are numbers from 0 to 1: whole numbers of 8 and 16 bits are divided by 255 and 65535, and floats of a PLY by
    255 if all are whole numbers and one is above 1. Those of glTF are linear; other formats do not say what theirs are.
    In an OBJ they stand after x y z, and are divided by 255 if one is above 1.5; vertices without one are white.
    Colours of faces (PLY, STL, OFF) become those of their corners, unless vertices have some.

    glTF: the default scene, with skins and morph targets at their default pose. Draco and meshopt data need the
    packages of ``pip install 'cubecam[gltf]'``; an extension that the file requires and that is not known is refused by
    name.

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
    if extension not in READERS:
        raise MeshError(
            f"{found}: expected a mesh file that ends in {', '.join(READERS)}; got {extension or 'none'}"
        )
    reader = import_module(READERS[extension], __package__)
    try:
        # Numbers of any size stand in files: what is not finite in the end is an error, or a normal to be computed.
        with np.errstate(all="ignore"):
            parts: list[Part] = reader.read(found, data)
            return joined(parts, size)
    except (MeshError, ValueError, IndexError) as error:
        # ValueError and IndexError are the core's own checks: an index out of range, a position that is not finite.
        raise MeshError(f"{found}: {error}") from error
