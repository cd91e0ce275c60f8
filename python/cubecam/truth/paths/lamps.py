"""Which lamps shine on points, with the sharp shadows of what stands in between."""

from __future__ import annotations

import numpy as np

from ..arrays import Array
from ..scene.snapshot import Snapshot
from ..shading.lights import way_to
from ..shading.vectors import dot
from ..surfaces.geometry import Geometry
from .groups import Group


class Lamps:
    """The lights of a snapshot except ambient ones, and the nodes that cast shadows."""

    def __init__(self, snapshot: Snapshot, casters: Geometry) -> None:
        self.all = snapshot.lights
        self.ambient = snapshot.ambient
        self._shadows, self._casters = snapshot.shadows, casters
        self._receives = np.array([n.receive_shadow for n in snapshot.nodes], np.bool_)

    def visibility(self, group: Group, index: int) -> Array | None:
        """Give the share (R,) of a lamp's light that arrives at points, None if nothing can stop it."""
        if not self._shadows[index]:
            return None
        points, light = group.points, self.all[index]
        towards, _ = way_to(light, points.position)
        faces = dot(points.normal, towards)[:, 0] > 0
        rows = np.flatnonzero(self._receives[points.node] & faces)
        share = np.ones(len(points))
        if len(rows):
            towards, distance = way_to(light, points.lifted[rows])
            blocked = self._casters.blocked(
                points.lifted[rows], towards, distance[:, 0], start=points.triangle[rows]
            )
            share[rows] = ~blocked
        return share
