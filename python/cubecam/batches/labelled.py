"""Names for the axes, faces and channels of batches, and their conventions as attributes: for xarray and for Zarr."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from .._core import __version__
from ._outputs import MEANINGS
from .cubemaps import CubeMapBatch

if TYPE_CHECKING:
    import xarray

    from .frames import FrameBatch

__all__ = [
    "CUBES",
    "FRAMES",
    "Labels",
    "Named",
    "dataset",
    "labelled_dataset",
    "labels_of",
    "names_of_places",
]

#: The axes of the numbers of cubemaps and of frames, before those of one texel or pixel.
CUBES = ("probe", "face", "row", "column")
FRAMES = ("frame", "row", "column")

_FACES = ("+x", "-x", "+y", "-y", "+z", "-z")
_CHANNELS = {1: ("luminance",), 3: ("r", "g", "b"), 4: ("r", "g", "b", "a")}
_AXES = ("x", "y", "z")
#: Outputs in units of the world; the others have none.
_LENGTHS = ("distance", "z", "position")


@dataclass
class Named:
    """An array with names for its axes and with attributes; `values` may be a list of texts."""

    axes: tuple[str, ...]
    values: Any
    attributes: dict[str, Any] = field(default_factory=dict)


@dataclass
class Labels:
    """All that a batch holds: what was drawn, where and of what, and what these numbers are."""

    variables: dict[str, Named]
    coordinates: dict[str, Named]
    attributes: dict[str, Any]


def labels_of(batch: CubeMapBatch | FrameBatch, scene_hash: str | None) -> Labels:
    """Name what a batch holds; its arrays stay what they are."""
    made = _cubes(batch) if isinstance(batch, CubeMapBatch) else _frames(batch)
    made.attributes |= {"encoding": batch.encoding, "source": f"cubecam {__version__}"}
    if scene_hash is not None:
        made.attributes["scene_hash"] = scene_hash
    axes = {axis for row in made.variables.values() for axis in row.axes}
    taken = made.variables.keys() & (made.coordinates.keys() | axes | {"drawn"})
    if taken or "color" in batch.outputs:
        name = min(taken, default="color")
        raise ValueError(f"outputs: expected no name of a coordinate or an axis, got {name!r}")
    return made


def names_of_places(outputs: Iterable[str]) -> tuple[str, str, str]:
    """Name the coordinates of the places: x, y and z, unless an output has one of these names, as "z" does."""
    names = ("x", "y", "z")
    taken = not set(names).isdisjoint(outputs)
    return ("place_x", "place_y", "place_z") if taken else names


def _cubes(batch: CubeMapBatch) -> Labels:
    made = Labels({}, {"face": Named(("face",), list(_FACES))}, {})
    if batch.positions is not None:
        for axis, name in enumerate(names_of_places(batch.outputs)):
            what = f"{_AXES[axis]} of the place of the capture"
            meaning = {"units": "world units", "long_name": what}
            made.coordinates[name] = Named(("probe",), batch.positions[:, axis], meaning)
    if batch.rotations is not None:
        meaning = {"long_name": "quaternion w, x, y, z of the cube's axes"}
        made.coordinates["rotation"] = Named(("probe", "quaternion"), batch.rotations, meaning)
    made.attributes = {
        "convention": "gl",
        "faces": 'order +x -x +y -y +z -z of OpenGL ("gl" layout): row 0 is t = 0, seen from within',
        "axes": "right-handed, +y up",
    }
    _add_variables(made, CUBES, batch.faces, batch)
    return made


def _frames(batch: FrameBatch) -> Labels:
    made = Labels({}, {}, {"rows": "row 0 is on top"})
    if batch.format is not None:
        made.attributes["format"] = batch.format
    _add_variables(made, FRAMES, batch.color, batch)
    return made


def _add_variables(
    made: Labels, axes: tuple[str, ...], color: Any, batch: CubeMapBatch | FrameBatch
) -> None:
    if color is not None:
        made.coordinates["channel"] = Named(("channel",), list(_CHANNELS[color.shape[-1]]))
        meaning = {"encoding": batch.encoding, "units": "1"}
        made.variables["color"] = Named((*axes, "channel"), color, meaning)
    for name, values in batch.outputs.items():
        own: tuple[str, ...] = ()
        if values.ndim > len(axes):
            vector = values.shape[-1] == 3 and name in ("normal", "position")
            own = ("axis",) if vector else (f"{name}_channel",)
            if vector:
                made.coordinates["axis"] = Named(("axis",), list(_AXES))
        made.variables[name] = Named((*axes, *own), values, _meaning(name))


def _meaning(name: str) -> dict[str, Any]:
    if name not in MEANINGS:  # of a material's own
        return {}
    return {
        "units": "world units" if name in _LENGTHS else "1",
        "long_name": MEANINGS[name][2],
    }


def dataset(batch: CubeMapBatch | FrameBatch, scene_hash: str | None) -> xarray.Dataset:
    """Make the dataset of a batch; see `CubeMapBatch.to_xarray`."""
    try:
        import xarray  # noqa: F401
    except ImportError as error:
        raise ImportError("to_xarray() needs xarray: pip install xarray") from error
    return labelled_dataset(labels_of(batch, scene_hash))


def labelled_dataset(labels: Labels) -> xarray.Dataset:
    """Make a dataset of what the labels name."""
    import xarray

    return xarray.Dataset(
        {name: (row.axes, row.values, row.attributes) for name, row in labels.variables.items()},
        {name: (row.axes, row.values, row.attributes) for name, row in labels.coordinates.items()},
        labels.attributes,
    )
