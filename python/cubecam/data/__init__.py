"""Sample files that come with the package; CREDITS.md names their sources."""

from __future__ import annotations

import difflib
from pathlib import Path
from typing import overload

from .._calls import checked_call
from .._checks import text_of

__all__ = ["sample_data"]

_FILES = (
    "courtyard.exr",
    "forest.exr",
    "interior.exr",
    "studio.exr",
    "sunrise.exr",
    "sunset.exr",
    "bunny.obj",
    "gallery.glb",
    "suzanne.glb",
    "teapot.obj",
)


@overload
def sample_data() -> tuple[str, ...]: ...
@overload
def sample_data(name: str) -> Path: ...


@checked_call
def sample_data(name: str | None = None) -> tuple[str, ...] | Path:
    """Find a sample file, or list the names of all.

    Parameters
    ----------
    name : str, optional
        The name of a file, see below. None: the names of all files are returned.

    Returns
    -------
    pathlib.Path or tuple of str
        The path of the file, which must not be changed; without a name, the names: photographs first, then meshes.

    Raises
    ------
    ValueError
        For another name; the error says which names there are.

    Notes
    -----
    The photographs are equirectangular, (512, 1024, 3), half floats, linear, 0 or more; the lamps and the sun are not
    clipped. `load_environment` makes faces of 512 x 512 texels of them.

    =============  ==============================================================  ==================
    photograph     shows                                                           highest number
    =============  ==============================================================  ==================
    courtyard.exr  a yard under a roof, open to a sunny sky in the middle          54.8
    forest.exr     a path in a Japanese garden, the sun behind trees               1,437
    interior.exr   a hotel room with lamps and two bright windows                  35,744
    studio.exr     a dark photographer's studio with lamps                         616.5
    sunrise.exr    a meadow in the morning, the sun low                            34,560
    sunset.exr     a quay at the sea in the evening, the sun on the horizon        6,248
    =============  ==============================================================  ==================

    The meshes in this table have no texture coordinates; `load_mesh` computes smooth normals where a file has none.
    Sizes are those along x, y and z in the file's own units.

    ===========  ======================  ========  =========  ==================
    mesh         shows                   vertices  triangles  size
    ===========  ======================  ========  =========  ==================
    bunny.obj    Stanford bunny          1,839     3,674      9.9, 9.7, 7.5
    suzanne.glb  Blender's monkey head   2,012     3,936      2.7, 1.9, 1.6
    teapot.obj   Utah teapot             792       992        32.1, 15.8, 20.0
    ===========  ======================  ========  =========  ==================

    gallery.glb is a scene for `load_scene`: a room with a lamp, a mirror ball, a golden head that an animation turns,
    and a camera.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.sample_data("sunset.exr").name
    'sunset.exr'
    >>> cc.sample_data()[:3]
    ('courtyard.exr', 'forest.exr', 'interior.exr')
    """
    if name is None:
        return _FILES
    if name not in _FILES:
        near = difflib.get_close_matches(str(name), _FILES, n=1)
        hint = f"; did you mean {near[0]!r}?" if near else ""
        raise ValueError(f"expected one of {', '.join(_FILES)}; got {text_of(name)}{hint}")
    return Path(__file__).with_name(name)


def find_sample(name: str) -> Path | None:
    """Find the sample file of a name, which may lack its ending; None if there is no such sample."""
    for known in _FILES:
        if name in (known, Path(known).stem):
            return sample_data(known)
    return None
