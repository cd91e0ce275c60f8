"""`load_scene`: files of whole scenes, and the modules that read them."""

from __future__ import annotations

from importlib import import_module

import numpy as np

from .._calls import checked_call
from .._core import MeshError, Scene
from .files import PathLike, as_path, read_file
from .left_out import LeftOut

__all__ = ["ENDINGS", "load_scene"]

# The module that reads each kind of file with its function `read_scene(path, data, left_out)`.
_READERS = {
    ".glb": ".gltf.scene",
    ".gltf": ".gltf.scene",
    ".obj": ".meshes.obj_scene",
    ".ply": ".meshes.plain_scene",
    ".stl": ".meshes.plain_scene",
    ".off": ".meshes.plain_scene",
}
#: The extensions of files of scenes.
ENDINGS = tuple(_READERS)


@checked_call
def load_scene(path: PathLike) -> Scene:
    """Read a file as a scene.

    Parameters
    ----------
    path : str or os.PathLike
        glTF 2 (.glb, .gltf), Wavefront OBJ with its MTL; PLY, STL or OFF, which become one node. Files that a model
        names must lie in its folder or below.

    Returns
    -------
    Scene
        Nodes with their names, in the file's order, with `StandardMaterial`. A mesh of several materials is a group
        with a node for each. What a file uses twice is one object.

    Raises
    ------
    OSError
        If there is no file of that name (FileNotFoundError), or it may not be read.
    MeshError
        For another kind of file, broken contents, counts that the bytes of the file cannot hold, or an extension that
        the file requires and that cubecam does not have, by its name.

    Warns
    -----
    SceneWarning
        If a part is left out that only decorates: a picture that cannot be read, points and lines, an extension that
        is not known and not required. One warning for each kind of part.

    Notes
    -----
    glTF: the default scene, or else the first.

    - Where a primitive has no normals, its surface is flat, as glTF asks: `flat_shading` of its material is True.
    - Lights and cameras lie at the origin of the node that is their parent, and point along its -Z. Lights have
      ``decay=2``, in candela, or lux. A camera without `zfar` ends at 1e9. The aspect ratio of a camera is not read;
      that of each picture counts.
    - A scale of 0 becomes 1e-6, since matrices of nodes have inverses.
    - KHR_materials_pbrSpecularGlossiness becomes a dielectric of the same reflectance, ``ior=0``.
    - EXT_lights_image_based: level 0 is the environment; cubecam filters it itself, diffuse light included.

    OBJ: an object, or a group in a file without objects, is a node, and each of its materials a node below it. An MTL
    is converted as Blender's importer converts it; docs/howto/load_scene.md has the table.

    Examples
    --------
    >>> import cubecam as cc
    >>> scene = cc.load_scene(cc.sample_data("bunny.obj"))
    >>> scene
    Scene(1 node, 0 lights)
    >>> scene.nodes[0].material.roughness
    0.5
    """
    found = as_path(path)
    extension = found.suffix.lower()
    data = read_file(found, MeshError)
    if extension not in _READERS:
        raise MeshError(
            f"{found}: expected a file of a scene that ends in {', '.join(_READERS)}; got {extension or 'none'}"
        )
    reader = import_module(_READERS[extension], __package__)
    left_out = LeftOut()
    try:
        # Numbers of any size stand in files: what is not finite in the end is an error, or a normal to be computed.
        with np.errstate(all="ignore"):
            scene: Scene = reader.read_scene(found, data, left_out)
    except (MeshError, ValueError, IndexError) as error:
        # ValueError and IndexError are the core's own checks: an index out of range, a position that is not finite.
        raise MeshError(f"{found}: {error}") from error
    left_out.warn(found)
    return scene
