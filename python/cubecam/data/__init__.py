"""Sample files that come with the package; CREDITS.md names their sources."""

from __future__ import annotations

from pathlib import Path

__all__ = ["sample_data"]

_FILES = ("studio.exr", "city.exr", "forest.exr", "workshop.exr", "bunny.obj", "teapot.obj")


def sample_data(name: str) -> Path:
    """Find a sample file.

    Parameters
    ----------
    name : str
        "studio.exr", "city.exr", "forest.exr" or "workshop.exr": equirectangular HDR photographs, 512 x 256,
        linear, half float. "bunny.obj", "teapot.obj": meshes without normals, some 10 and 32 units wide.

    Returns
    -------
    pathlib.Path
        The path of the file, which must not be changed.

    Raises
    ------
    ValueError
        For another name.

    Examples
    --------
    >>> import cubecam as cc
    >>> cc.sample_data("studio.exr").name
    'studio.exr'
    """
    if name not in _FILES:
        raise ValueError(f"expected one of {', '.join(_FILES)}; got {name!r}")
    return Path(__file__).with_name(name)
