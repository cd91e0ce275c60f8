"""Batches as datasets of xarray: names for axes, faces and channels, and the conventions as attributes."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .._core import __version__
from ._outputs import MEANINGS

if TYPE_CHECKING:
    import xarray

    from .cubemaps import CubeMapBatch
    from .frames import FrameBatch

__all__ = ["cubes", "frames"]

_FACES = ("+x", "-x", "+y", "-y", "+z", "-z")
_CHANNELS = {1: ("luminance",), 3: ("r", "g", "b"), 4: ("r", "g", "b", "a")}
_AXES = ("x", "y", "z")
#: Outputs in units of the world; the others have none.
_LENGTHS = ("distance", "z", "position")


def cubes(batch: CubeMapBatch) -> xarray.Dataset:
    """Make the dataset of cubemaps; see `CubeMapBatch.to_xarray`."""
    coordinates: dict[str, Any] = {"face": list(_FACES)}
    if batch.positions is not None:
        for axis, name in enumerate(_AXES):
            place = ("probe", batch.positions[:, axis], {"units": "world units"})
            coordinates[name] = place
    if batch.rotations is not None:
        meaning = {"long_name": "quaternion w, x, y, z of the cube's axes"}
        coordinates["rotation"] = (("probe", "quaternion"), batch.rotations, meaning)
    attributes = {
        "faces": 'order +x -x +y -y +z -z of OpenGL ("gl" layout): row 0 is t = 0, seen from within',
        "axes": "right-handed, +y up",
    }
    return _dataset(batch, ("probe", "face", "row", "column"), coordinates, attributes)


def frames(batch: FrameBatch) -> xarray.Dataset:
    """Make the dataset of frames; see `FrameBatch.to_xarray`."""
    return _dataset(batch, ("frame", "row", "column"), {}, {"rows": "row 0 is on top"})


def _dataset(
    batch: CubeMapBatch | FrameBatch,
    axes: tuple[str, ...],
    coordinates: dict[str, Any],
    attributes: dict[str, str],
) -> xarray.Dataset:
    try:
        import xarray
    except ImportError as error:
        raise ImportError("to_xarray() needs xarray: pip install xarray") from error
    variables: dict[str, Any] = {}
    color = batch.faces if hasattr(batch, "faces") else batch.color
    if color is not None:
        coordinates["channel"] = list(_CHANNELS[color.shape[-1]])
        meaning = {"encoding": batch.encoding, "units": "1"}
        variables["color"] = ((*axes, "channel"), color, meaning)
    for name, values in batch.outputs.items():
        own: tuple[str, ...] = ()
        if values.ndim > len(axes):
            vector = values.shape[-1] == 3 and name in ("normal", "position")
            own = ("axis",) if vector else (f"{name}_channel",)
            if vector:
                coordinates["axis"] = list(_AXES)
        variables[name] = ((*axes, *own), values, _meaning(name))
    attributes = {**attributes, "source": f"cubecam {__version__}"}
    return xarray.Dataset(variables, coordinates, attributes)


def _meaning(name: str) -> dict[str, str]:
    if name not in MEANINGS:  # of a material's own
        return {}
    return {
        "units": "world units" if name in _LENGTHS else "1",
        "long_name": MEANINGS[name][2],
    }
