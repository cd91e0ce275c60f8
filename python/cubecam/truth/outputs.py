"""What the first opaque surface along each ray is: the outputs of a renderer, by exact rays."""

from __future__ import annotations

from typing import Any

import numpy as np
import numpy.typing as npt

from .arrays import Ints
from .eyes import Eye
from .paths.state import first_paths
from .paths.tracer import Tracer, taken
from .surfaces.colors import surface_points
from .work import PATHS

#: The outputs that exist, with their types and their numbers where nothing is met.
OUTPUTS: dict[str, tuple[type, Any]] = {
    "distance": (np.float32, np.inf),
    "z": (np.float32, np.inf),
    "normal": (np.float32, (0.0, 0.0, 0.0)),
    "position": (np.float32, (np.nan, np.nan, np.nan)),
    "id": (np.int32, 0),
    "label": (np.int32, 0),
}


def outputs_of(tracer: Tracer, eye: Eye, names: tuple[str, ...]) -> dict[str, npt.NDArray[Any]]:
    """Cast a ray through the middle of each pixel and give the named outputs, each of the picture's shape."""
    count = int(np.prod(eye.shape))
    found = {}
    for name in names:
        kind, nothing = OUTPUTS[name]
        found[name] = np.full((count, *np.shape(nothing)), nothing, kind)
    for first in range(0, count if names else 0, PATHS):
        _fill(tracer, eye, np.arange(first, min(first + PATHS, count)), found)
    return {name: values.reshape(*eye.shape, *values.shape[1:]) for name, values in found.items()}


def _fill(tracer: Tracer, eye: Eye, pixel: Ints, found: dict[str, npt.NDArray[Any]]) -> None:
    nodes = tracer.snapshot.nodes
    blended = np.array([n.blend is not None for n in nodes], np.bool_)
    ids = np.array([n.id for n in nodes], np.int64)
    labels = np.array([n.label for n in nodes], np.int64)
    rays = eye.rays(pixel, (0.5, 0.5))
    paths = first_paths(rays.origin, rays.direction, rays.reach, pixel, pixel * 0, pixel)
    while len(paths):
        hits = tracer.hits(paths)
        met = np.flatnonzero(hits.triangle >= 0)
        paths, hits = paths.rows(met), taken(hits, met)
        points = surface_points(tracer.snapshot, hits, paths.direction)
        translucent = blended[points.node]
        solid, at = points.take(~translucent), paths.slot[~translucent]
        distance, z = eye.depth(at, solid.position)
        values = {
            "distance": distance,
            "z": z,
            "normal": solid.normal,
            "position": solid.position,
            "id": ids[solid.node],
            "label": labels[solid.node],
        }
        for name, array in found.items():
            if len(at):
                array[at] = values[name]
        paths = tracer.past(paths, points, hits).rows(translucent)
