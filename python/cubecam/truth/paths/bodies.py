"""The bodies of glass: how they bend light and how much of it they absorb."""

from __future__ import annotations

import numpy as np

from ..arrays import Array, Ints
from ..scene.records import GlassRecord, StandardRecord
from ..scene.snapshot import Snapshot
from ..shading.bodies import extinction, spread
from .state import Paths


class Bodies:
    """Tables of all nodes: `ior` (K, 3) for red, green and blue, and `extinction` (K, 3) for each world unit."""

    def __init__(self, snapshot: Snapshot) -> None:
        materials = [snapshot.materials[n.material] for n in snapshot.nodes]
        count = len(materials)
        self.ior, self.extinction = np.ones((count, 3)), np.zeros((count, 3))
        for index, material in enumerate(materials):
            if isinstance(material, GlassRecord):
                self.ior[index] = spread(material.ior, material.dispersion)
                self.extinction[index] = extinction(
                    material.attenuation_color, material.attenuation_distance
                )
            elif isinstance(material, StandardRecord):
                self.ior[index] = spread(material.numbers["ior"], material.numbers["dispersion"])
                self.extinction[index] = extinction(
                    material.attenuation_color, material.numbers["attenuation_distance"]
                )

    def ior_around(self, paths: Paths, level: Ints) -> Array:
        """Give the index of refraction (R,) of the body at a level, 0 for the innermost; 1 outside of all bodies."""
        body = np.take_along_axis(paths.bodies, level[:, None], axis=1)[:, 0]
        channel = np.where(paths.channel < 0, 1, paths.channel)
        return np.where(body >= 0, self.ior[body, channel], 1.0)
